#pragma once

#include <QString>

namespace palp {

/// What is wrong with a list of numbers between commas: "1,5" may be 1.5 or 1 and 5. Empty where each comma
/// has a blank after it, or one of its two numbers has a decimal point.
QString unclearComma(const QString& list);

} // namespace palp
