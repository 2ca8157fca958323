#pragma once

// Private to io.

#include "io/measured/FieldNumber.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace palp {

/// What is known of a table's form; what is not given is detected.
struct TableForm {
  std::optional<char> separator; ///< of text: , ; tab, or a blank for any number of blanks and tabs
  std::optional<char> decimal;   ///< . or ,
  std::optional<int> namesLine;  ///< line with the names of the columns, from 1; 0: none
  std::optional<int> firstLine;  ///< line of the first row
  DateOrder dates = DateOrder::Unknown;
};

/// A column that is read, and as what.
struct ChosenColumn {
  enum class As {
    Number,
    Clock, ///< a number, or a date or time of day [s]
    Label, ///< any text: equal texts are one number, counted from 0 in the order of their first appearance
  };
  std::size_t column = 0;
  As as = As::Number;
};

/// An array of numbers with its rows along the first dimension.
struct TableArray {
  std::string name;
  std::uint64_t rows = 0;
  std::size_t firstColumn = 0, columns = 0; ///< among those of the table
};

/// A table of numbers that another program wrote, read row by row.
class MeasuredTable {
public:
  MeasuredTable() = default;
  virtual ~MeasuredTable() = default;
  MeasuredTable(const MeasuredTable&) = delete;
  MeasuredTable& operator=(const MeasuredTable&) = delete;

  /// Names of the columns; empty ones where it has none.
  [[nodiscard]] virtual const std::vector<std::string>& columns() const = 0;
  /// Units of the columns as the table states them, in a row of units or in the names ("Fx [N]", "t_ms"); empty ones
  /// where it states none.
  [[nodiscard]] virtual std::vector<std::string> units() const = 0;
  /// How the table was read: "separator ;, decimal comma, names in line 3". Empty for arrays.
  [[nodiscard]] virtual std::string form() const { return {}; }
  /// Whether a column contains dates or times of day in its first row.
  [[nodiscard]] virtual bool isDate(std::size_t /*column*/) const { return false; }

  /// Lines before the table that are not read, up to 5; none of arrays.
  [[nodiscard]] virtual std::vector<std::string> before() const { return {}; }
  /// Arrays of which the columns are parts; none of text.
  [[nodiscard]] virtual std::vector<TableArray> arrays() const { return {}; }
  /// The first rows as they are written, a text for each column, before any other row is read. Throws Error.
  [[nodiscard]] virtual std::vector<std::vector<std::string>> firstRows(std::size_t count) = 0;

  /// Begins to read these columns. Throws Error where arrays of different numbers of rows are chosen.
  virtual void choose(std::vector<ChosenColumn> chosen) = 0;
  /// The chosen columns of the next row; false at the end. `problems` gets what is wrong with the row, each with its
  /// column; the row is of no use then. Throws Error where no further row can be read.
  virtual bool next(std::span<double> values, std::vector<std::string>& problems) = 0;
  /// Where the last row is: "line 12", "row 3".
  [[nodiscard]] virtual std::string where() const = 0;
  /// Share of the table that has been read, 0 to 1.
  [[nodiscard]] virtual double share() const = 0;
};

/// CSV and other tables of text, or arrays: NPZ, HDF5 (by the paths of its data sets) and MAT, with a column for each
/// number of a row: "t", "F[0]", "R[4,7]". Other kinds of files are named for what they are. Throws Error.
std::unique_ptr<MeasuredTable> openTable(const std::filesystem::path& path, const TableForm& form);

// Private to the folder.
std::unique_ptr<MeasuredTable> openTextTable(const std::filesystem::path& path, const TableForm& form);
std::unique_ptr<MeasuredTable> openNpzTable(const std::filesystem::path& path);
std::unique_ptr<MeasuredTable> openHdf5Table(const std::filesystem::path& path);

} // namespace palp
