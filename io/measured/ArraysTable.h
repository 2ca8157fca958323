#pragma once

// Private to io.

#include "io/measured/MeasuredTable.h"

#include <map>

namespace palp {

/// Arrays of numbers whose first dimension counts the rows: each number of a row is a column: "t", "F[0]", "R[4,7]".
/// Arrays of which no column is chosen may have any number of rows.
class ArraysTable : public MeasuredTable {
public:
  [[nodiscard]] const std::vector<std::string>& columns() const override { return columns_; }
  [[nodiscard]] std::vector<std::string> units() const override { return std::vector<std::string>(columns_.size()); }
  [[nodiscard]] std::vector<TableArray> arrays() const override;
  [[nodiscard]] std::vector<std::vector<std::string>> firstRows(std::size_t count) override;
  void choose(std::vector<ChosenColumn> chosen) override;
  bool next(std::span<double> values, std::vector<std::string>& problems) override;
  [[nodiscard]] std::string where() const override;
  [[nodiscard]] double share() const override;

protected:
  explicit ArraysTable(std::filesystem::path path) : path_(std::move(path)) {}

  /// Adds an array of that shape. Throws Error where there are too many columns.
  void add(const std::string& name, const std::vector<std::uint64_t>& shape);
  /// Throws Error if no array was added.
  void requireArrays() const;
  /// Begins to read the array from its first row.
  virtual void open(const std::string& name) = 0;
  /// The next row of an array that is open.
  virtual void readRow(const std::string& name, std::span<double> row) = 0;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
  struct Array {
    std::string name;
    std::uint64_t rows = 0;
    std::size_t firstColumn = 0;
    std::vector<double> row;
    bool chosen = false;
  };

  std::filesystem::path path_;
  std::uint64_t rows_ = 0, row_ = 0;
  std::vector<Array> arrays_;
  std::vector<std::string> columns_;
  std::vector<ChosenColumn> chosen_;
};

} // namespace palp
