#include "model/base/GotExpected.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace palp {

TEST(GotExpected, SaysTheValueThenWhatIsExpected) {
  EXPECT_EQ(gotExpected("'blue'", "red or green"), "got 'blue', expected red or green");
  EXPECT_EQ(gotExpected(-1, " mm", "above 0 up to 10000 mm"), "got -1 mm, expected above 0 up to 10000 mm");
}

TEST(GotExpected, NumbersHaveAtMostSixDigitsAndNoNegativeZero) {
  EXPECT_EQ(shortText(0.1 + 0.2), "0.3");
  EXPECT_EQ(shortText(1.0 / 3), "0.333333");
  EXPECT_EQ(shortText(-0.0), "0");
  EXPECT_EQ(shortText(std::nan("")), "nan");
  EXPECT_EQ(shortTexts(std::array{1.0, -0.0, -6.0}), "(1, 0, -6)");
}

} // namespace palp
