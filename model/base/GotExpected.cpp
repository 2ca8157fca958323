#include "model/base/GotExpected.h"

#include "model/base/NumberText.h"

namespace palp {

std::string gotExpected(const std::string& got, const std::string& expected) {
  return "got " + got + ", expected " + expected;
}

std::string gotExpected(double got, const std::string& unit, const std::string& expected) {
  return gotExpected(shortText(got) + unit, expected);
}

std::string quotedText(const std::string& text) {
  return "'" + text + "'";
}

std::string shortText(double value) {
  return withDigits(value == 0 ? 0 : value, 6);
}

} // namespace palp
