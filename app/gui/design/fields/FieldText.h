#pragma once

#include "app/gui/design/DesignFields.h"

namespace palp {

// Values of a design's parameters as text to edit, and back. The setters return what is wrong with the words, and set
// the target only where nothing is.

/// The shortest text that reads back as the same number.
QString fieldText(double value);
QString setNumber(double& target, const QString& words);
QString setCount(int& target, const QString& words);

/// Numbers separated by commas; evenly spaced ones in short ("1.5, 4.5, ..., 28.5"), where that gives the very same
/// numbers back.
QString listText(const std::vector<double>& values);
QString setList(std::vector<double>& target, const QString& words);

/// Lists wire by wire are separated by semicolons.
QString listsText(const std::vector<std::vector<double>>& lists);
QString setLists(std::vector<std::vector<double>>& target, const QString& words);

/// Sets the index of the choice that the words name.
QString setChoice(std::size_t& target, const std::vector<DesignChoice>& choices, const QString& words);

} // namespace palp
