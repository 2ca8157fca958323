#pragma once

// Private to io: the form of a table of text, found from its first lines.

#include "io/measured/MeasuredTable.h"

#include <string>
#include <string_view>
#include <vector>

namespace palp {

/// A line of a table and its number in the file, from 1.
struct NumberedLine {
  std::size_t number = 0;
  std::string text;
};

/// How a table of text is read.
struct TableLayout {
  char separator = ',', decimal = '.';
  DateOrder dates = DateOrder::Unknown;
  std::size_t columns = 0;
  std::size_t usualFields = 0;           ///< of a row, those at its end without content apart
  std::size_t fieldsOfNames = 0;         ///< fields of the line with the names, those at its end without a name too
  std::vector<std::string> names, units; ///< one for each column, empty where there are none
  std::size_t namesLine = 0, unitsLine = 0, firstLine = 0; ///< numbers in the file; 0: the table has none
  std::vector<bool> date;                                  ///< whether the first row has a date or time there
};

/// Finds the form of a table from its first lines: the separator and decimal sign by which most fields are numbers, the
/// first row, and above it the names of the columns and their units. What `form` prescribes is not sought. Throws
/// Error, beginning with `file`, where no line has numbers.
TableLayout findLayout(const std::vector<NumberedLine>& lines, const TableForm& form, const std::string& file);

/// The fields of a line, without blanks and quotes around them. Separators within quotes do not separate; a blank as
/// separator means any number of blanks and tabs.
void splitFields(std::string_view line, char separator, std::vector<std::string_view>& fields);

/// Blank, or nothing but separators.
bool isEmptyLine(std::string_view line, char separator);
/// A line that begins with #, % or //.
bool isComment(std::string_view line);

} // namespace palp
