#pragma once

// Private to io.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace palp {

/// A table of numbers that somebody else wrote, read row by row.
class MeasuredTable {
public:
  MeasuredTable() = default;
  virtual ~MeasuredTable() = default;
  MeasuredTable(const MeasuredTable&) = delete;
  MeasuredTable& operator=(const MeasuredTable&) = delete;

  [[nodiscard]] virtual const std::vector<std::string>& columns() const = 0;
  /// The chosen columns of the next row; false at the end. Throws Error with file and line (of arrays: row), where a
  /// row has another number of fields than the head, or a chosen one is not a finite number.
  virtual bool next(const std::vector<std::size_t>& chosen, std::vector<double>& values) = 0;
  /// Of the table that has been read, 0 to 1.
  [[nodiscard]] virtual double share() const = 0;
  /// Throws Error: file, place of the last row, sentence.
  [[noreturn]] virtual void refuse(const std::string& sentence) const = 0;
};

/// CSV with one line of names (lines that begin with # before it are left out); or NPZ, whose arrays have a column for
/// each number of a row: "t", "F[0]", "R[4,7]". Throws Error.
std::unique_ptr<MeasuredTable> openTable(const std::filesystem::path& path, char separator);

} // namespace palp
