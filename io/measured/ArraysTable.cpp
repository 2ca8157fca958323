#include "io/measured/ArraysTable.h"

#include "io/samples/Hdf5Child.h"
#include "io/samples/Npz.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kMostColumns = 200'000;
constexpr std::size_t kColumnsShown = 2000; ///< of which the first rows are read to be shown
constexpr std::uint64_t kMostRows = std::uint64_t{1} << 40;
constexpr std::uint64_t kBlock_numbers = 1 << 16; ///< of an HDF5 file, read together

/// "[4,7]"; nothing for one number a row.
std::string indexText(const std::vector<std::uint64_t>& shape, std::uint64_t item) {
  std::string text;
  for (std::size_t d = shape.size(); d-- > 1; item /= shape[d])
    text = std::to_string(item % shape[d]) + (text.empty() ? "" : ",") + text;
  return text.empty() ? text : "[" + text + "]";
}

class NpzTable : public ArraysTable {
public:
  explicit NpzTable(const fs::path& path) : ArraysTable(path) {
    for (const auto& [name, head] : npzArrays(path))
      if (!head.shape.empty() && !head.isText()) add(name, head.shape); // the others are of all rows together
    requireArrays();
  }

private:
  void open(const std::string& name) override { sources_[name] = std::make_unique<NpzArray>(path(), name); }
  void readRow(const std::string& name, std::span<double> row) override { sources_.at(name)->read(row); }

  std::map<std::string, std::unique_ptr<NpzArray>> sources_;
};

/// Data sets of an HDF5 file, by their paths, or variables of a MAT file.
class Hdf5Table : public ArraysTable {
public:
  explicit Hdf5Table(const fs::path& path) : ArraysTable(path), file_(path) {
    for (const auto& [name, shape] : file_.datasets())
      if (!shape.empty()) add(name, shape);
    requireArrays();
  }

private:
  struct Block {
    std::vector<double> numbers;
    std::uint64_t next = 0; ///< row that is read next from the file
    std::size_t at = 0;     ///< number within the block
  };

  void open(const std::string& name) override { blocks_[name] = {}; }

  void readRow(const std::string& name, std::span<double> row) override {
    Block& block = blocks_.at(name);
    if (block.at == block.numbers.size()) {
      const std::uint64_t rows = file_.datasets().at(name)[0];
      const std::uint64_t count = std::min(
          rows - block.next, std::max<std::uint64_t>(1, kBlock_numbers / std::max<std::uint64_t>(1, row.size())));
      block.numbers.resize(count * row.size());
      file_.readRows(name, block.next, count, std::span<double>(block.numbers));
      block.next += count;
      block.at = 0;
    }
    std::copy_n(block.numbers.begin() + static_cast<std::ptrdiff_t>(block.at), row.size(), row.begin());
    block.at += row.size();
  }

  Hdf5Child file_;
  std::map<std::string, Block> blocks_;
};

} // namespace

void ArraysTable::add(const std::string& name, const std::vector<std::uint64_t>& shape) {
  std::uint64_t width = 1;
  for (std::size_t d = 1; d < shape.size(); ++d)
    width = std::min(kMostColumns + 1, width * std::min(shape[d], kMostColumns + 1));
  if (columns_.size() + width > kMostColumns || shape[0] > kMostRows)
    throw Error(path_.string() + ": array " + name + ": " +
                gotExpected(std::to_string(width) + " numbers per row",
                            "at most " + std::to_string(kMostColumns) + " in all arrays"));
  if (shape[0] == 0) width = 0;
  arrays_.push_back({name, shape[0], columns_.size(), std::vector<double>(width)});
  for (std::uint64_t i = 0; i < width; ++i) columns_.push_back(name + indexText(shape, i));
}

void ArraysTable::requireArrays() const {
  if (arrays_.empty()) throw Error(path_.string() + ": has no arrays of numbers with a row per sample");
}

std::vector<TableArray> ArraysTable::arrays() const {
  std::vector<TableArray> all;
  for (const Array& array : arrays_) all.push_back({array.name, array.rows, array.firstColumn, array.row.size()});
  return all;
}

/// Array by array, because they may have different numbers of rows.
std::vector<std::vector<std::string>> ArraysTable::firstRows(std::size_t count) {
  std::vector<std::vector<std::string>> rows;
  std::vector<double> values;
  for (const TableArray& array : arrays()) {
    if (array.columns == 0 || array.firstColumn + array.columns > kColumnsShown) continue;
    std::vector<ChosenColumn> all;
    for (std::size_t i = 0; i < array.columns; ++i) all.push_back({array.firstColumn + i});
    choose(std::move(all));
    values.resize(array.columns);
    std::vector<std::string> ignored;
    for (std::size_t r = 0; r < count && next(values, ignored); ++r) {
      if (rows.size() == r) rows.emplace_back(columns_.size());
      for (std::size_t i = 0; i < array.columns; ++i) rows[r][array.firstColumn + i] = shortText(values[i]);
    }
  }
  return rows;
}

void ArraysTable::choose(std::vector<ChosenColumn> chosen) {
  chosen_ = std::move(chosen);
  row_ = 0;
  const Array* first = nullptr;
  for (Array& array : arrays_) {
    array.chosen = std::any_of(chosen_.begin(), chosen_.end(), [&array](const ChosenColumn& one) {
      return one.column >= array.firstColumn && one.column < array.firstColumn + array.row.size();
    });
    if (!array.chosen) continue;
    if (first != nullptr && array.rows != first->rows)
      throw Error(path_.string() + ": array " + array.name + ": " +
                  gotExpected(std::to_string(array.rows) + " rows",
                              std::to_string(first->rows) + ", as in array " + first->name));
    first = &array;
    rows_ = array.rows;
    open(array.name);
  }
}

bool ArraysTable::next(std::span<double> values, std::vector<std::string>& problems) {
  if (row_ == rows_) return false;
  ++row_;
  for (Array& array : arrays_)
    if (array.chosen) readRow(array.name, array.row);
  for (std::size_t i = 0; i < chosen_.size(); ++i) {
    const std::size_t column = chosen_[i].column;
    const auto after =
        std::upper_bound(arrays_.begin(), arrays_.end(), column,
                         [](std::size_t wanted, const Array& array) { return wanted < array.firstColumn; });
    const Array& array = *std::prev(after);
    values[i] = array.row[column - array.firstColumn];
    if (!std::isfinite(values[i]))
      problems.push_back(columns_[column] + ": " + gotExpected(values[i], "", "a finite number"));
  }
  return true;
}

std::string ArraysTable::where() const {
  return "row " + std::to_string(row_ - 1);
}

double ArraysTable::share() const {
  return rows_ > 0 ? static_cast<double>(row_) / static_cast<double>(rows_) : 1;
}

std::unique_ptr<MeasuredTable> openNpzTable(const fs::path& path) {
  return std::make_unique<NpzTable>(path);
}

std::unique_ptr<MeasuredTable> openHdf5Table(const fs::path& path) {
  return std::make_unique<Hdf5Table>(path);
}

} // namespace palp
