#pragma once

#include "model/base/Text.h"

#include <optional>
#include <string>
#include <string_view>

namespace palp {

// Numbers as text and back, with a decimal point whatever the locale of the process is. Everything that prints or reads
// a number uses these and text(): printf, strtod and their kin follow the locale (tests/check_numbers.py refuses them).

/// At most `digits` significant digits, as "%.<digits>g" of printf: 1234.56 to four is "1235", 1e-7 is "1e-07".
std::string withDigits(double value, int digits);

/// Exactly `decimals` digits after the point, as "%.<decimals>f" of printf.
std::string withDecimals(double value, int decimals);

/// With an exponent and `decimals` digits after the point, as "%.<decimals>e" of printf.
std::string withExponent(double value, int decimals);

/// A number as text, with "+" in front where it has no sign.
std::string withSign(std::string number);

/// The number that the complete text is, blanks around it apart. Returns nullopt where the text is not a number, has
/// anything after it, or is beyond the range of a double.
std::optional<double> numberIn(std::string_view text);

} // namespace palp
