#include "model/base/Text.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

namespace palp {
namespace {

TEST(Text, IsTheShortestThatReadsBackAsTheSameNumber) {
  EXPECT_EQ(text(0.499), "0.499");
  EXPECT_EQ(text(30), "30");
  EXPECT_EQ(text(-0.1), "-0.1");
  for (const double value : {1.0 / 3, 1e-9, 5e-324, 1.7976931348623157e308, 0.1 + 0.2})
    EXPECT_EQ(std::strtod(text(value).c_str(), nullptr), value);
}

TEST(Text, ShowsWhatIsNoNumber) {
  EXPECT_EQ(text(std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(text(-std::numeric_limits<double>::infinity()), "-inf");
}

} // namespace
} // namespace palp
