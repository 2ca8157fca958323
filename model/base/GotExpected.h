#pragma once

#include <string>

namespace palp {

// The form of a message about a value: "<where>: got <value>, expected <range or choices>".

/// "got 'blue', expected red or green".
std::string gotExpected(const std::string& got, const std::string& expected);

/// "got -1 mm, expected above 0 up to 10000 mm"; the unit begins with its blank (" mm") and belongs to the number
/// alone.
std::string gotExpected(double got, const std::string& unit, const std::string& expected);

/// The text in single quotes, as typed on a command line or found in a file.
std::string quotedText(const std::string& text);

/// A number for a message: at most six significant digits, and never "-0".
std::string shortText(double value);

/// "(1, 0, -6)": numbers for a message.
template <class Vector> std::string shortTexts(const Vector& values) {
  std::string all;
  for (const double value : values) all += (all.empty() ? "(" : ", ") + shortText(value);
  return all + ")";
}

} // namespace palp
