#include "model/base/NumberText.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

namespace palp {
namespace {

std::string printed(const char* format, int precision, double value) {
  std::array<char, 512> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, precision, value);
  return buffer.data();
}

TEST(NumberText, WithDigitsDecimalsOrAnExponentIsWhatPrintfWritesInTheCLocale) {
  const std::array<double, 12> values{0,     -0.0,    0.5,    -1234.5678,    1e-7,   123456789.125,
                                      1e100, -2.5e-9, 0.0005, 0.99999999999, 5e-324, 1.7976931348623157e308};
  for (const double value : values)
    for (const int precision : {0, 1, 2, 3, 4, 6, 13}) {
      EXPECT_EQ(withDigits(value, precision), printed("%.*g", precision, value));
      EXPECT_EQ(withDecimals(value, precision), printed("%.*f", precision, value));
      EXPECT_EQ(withExponent(value, precision), printed("%.*e", precision, value));
      EXPECT_EQ(withSign(withDecimals(value, precision)), printed("%+.*f", precision, value));
    }
}

TEST(NumberText, IsANumberAsAWholeOrNotAtAll) {
  EXPECT_EQ(numberIn("3.5"), 3.5);
  EXPECT_EQ(numberIn(" -1e-3\n"), -1e-3);
  EXPECT_EQ(numberIn("+2."), 2);
  for (const char* none : {"", " ", "3,5", "1,234.5", "3.5 mm", "+-2", "++2", "1e999", "0x10", "3.5.1"})
    EXPECT_FALSE(numberIn(none)) << none;
}

} // namespace
} // namespace palp
