#include "io/measured/MeasuredTable.h"

#include "io/files/SystemError.h"
#include "io/samples/Npz.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLongestLine = 4 << 20;
constexpr std::size_t kMostColumns = 200'000;

/// Without blanks and one pair of quotes around it.
std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  if (text.size() > 1 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return text;
}

std::string quoted(std::string_view text) {
  return "\"" + std::string(text.substr(0, 40)) + (text.size() > 40 ? "..." : "") + "\"";
}

class CsvTable : public MeasuredTable {
public:
  CsvTable(const fs::path& path, char separator)
      : path_(path), separator_(separator), stream_(path, std::ios::binary), buffer_(kLongestLine, '\0') {
    if (!stream_) cannotRead(path);
    std::error_code ignored;
    if (fs::is_regular_file(path, ignored)) size_ = static_cast<double>(fs::file_size(path, ignored));
    do {
      if (!nextLine()) refuse("no line with the names of the columns");
    } while (text_.empty() || text_.front() == '#');
    split();
    for (const std::string_view name : fields_) columns_.emplace_back(trimmed(name));
  }

  [[nodiscard]] const std::vector<std::string>& columns() const override { return columns_; }

  bool next(const std::vector<std::size_t>& chosen, std::vector<double>& values) override {
    if (!nextLine()) return false;
    split();
    if (fields_.size() != columns_.size())
      refuse(std::to_string(fields_.size()) + " fields; expected, by the names of the columns, " +
             std::to_string(columns_.size()));
    values.resize(chosen.size());
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      std::string_view field = trimmed(fields_[chosen[i]]);
      if (!field.empty() && field.front() == '+') field.remove_prefix(1);
      const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), values[i]);
      if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(values[i]))
        refuse("column " + columns_[chosen[i]] + ": " + gotExpected(quoted(field), "a finite number"));
    }
    return true;
  }

  [[nodiscard]] double share() const override { return size_ > 0 ? std::min(1.0, read_ / size_) : 1; }

  [[noreturn]] void refuse(const std::string& sentence) const override {
    throw Error(path_.string() + ", line " + std::to_string(line_) + ": " + sentence);
  }

private:
  bool nextLine() {
    ++line_;
    stream_.getline(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    const auto count = static_cast<std::size_t>(stream_.gcount());
    read_ += static_cast<double>(count);
    if (stream_.fail() && count + 1 >= buffer_.size())
      refuse("longer than " + std::to_string(kLongestLine >> 20U) + " MB; this is not a table");
    if (stream_.fail()) return false;
    text_ = std::string_view(buffer_.data(), stream_.eof() ? count : count - 1);
    if (text_.find('\0') != std::string_view::npos) refuse("contains a zero byte; this is not a text table");
    if (!text_.empty() && text_.back() == '\r') text_.remove_suffix(1);
    return true;
  }

  void split() {
    fields_.clear();
    for (std::string_view rest = text_;;) {
      const std::size_t at = rest.find(separator_);
      fields_.push_back(rest.substr(0, at));
      if (at == std::string_view::npos) return;
      rest.remove_prefix(at + 1);
    }
  }

  fs::path path_;
  char separator_;
  std::ifstream stream_;
  std::string buffer_;
  std::size_t line_ = 0;
  double size_ = 0, read_ = 0; ///< bytes
  std::string_view text_;
  std::vector<std::string_view> fields_;
  std::vector<std::string> columns_;
};

class NpzTable : public MeasuredTable {
public:
  explicit NpzTable(const fs::path& path) : path_(path) {
    const std::map<std::string, NpyHead> heads = npzArrays(path);
    for (const auto& [name, head] : heads) {
      if (head.shape.empty() || head.isText()) continue; // a value for all rows
      if (!arrays_.empty() && head.shape[0] != rows_)
        throw Error(path.string() + ": array " + name + ": " +
                    gotExpected(std::to_string(head.shape[0]) + " rows",
                                std::to_string(rows_) + ", as in array " + firstName_));
      if (arrays_.empty()) firstName_ = name;
      rows_ = head.shape[0];
      Array& array = arrays_.emplace_back();
      array.source = std::make_unique<NpzArray>(path, name);
      array.row.resize(head.shape[0] == 0 ? 0 : head.items() / head.shape[0]);
      if (columns_.size() + array.row.size() > kMostColumns)
        throw Error(path.string() + ": array " + name + ": " +
                    gotExpected(std::to_string(array.row.size()) + " numbers per row",
                                "at most " + std::to_string(kMostColumns) + " in all arrays"));
      for (std::size_t i = 0; i < array.row.size(); ++i) columns_.push_back(name + index(head, i));
    }
    if (arrays_.empty()) throw Error(path.string() + ": has no arrays of numbers with a row per sample");
  }

  [[nodiscard]] const std::vector<std::string>& columns() const override { return columns_; }

  bool next(const std::vector<std::size_t>& chosen, std::vector<double>& values) override {
    if (row_ == rows_) return false;
    ++row_;
    all_.clear();
    for (Array& array : arrays_) {
      array.source->read(std::span<double>(array.row));
      all_.insert(all_.end(), array.row.begin(), array.row.end());
    }
    values.resize(chosen.size());
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      values[i] = all_[chosen[i]];
      if (!std::isfinite(values[i])) refuse(columns_[chosen[i]] + ": " + gotExpected(values[i], "", "a finite number"));
    }
    return true;
  }

  [[nodiscard]] double share() const override {
    return rows_ > 0 ? static_cast<double>(row_) / static_cast<double>(rows_) : 1;
  }

  [[noreturn]] void refuse(const std::string& sentence) const override {
    throw Error(path_.string() + ", row " + std::to_string(row_ - 1) + ": " + sentence);
  }

private:
  struct Array {
    std::unique_ptr<NpzArray> source;
    std::vector<double> row;
  };

  /// "[4,7]"; nothing for one number a row.
  static std::string index(const NpyHead& head, std::size_t item) {
    std::string text;
    for (std::size_t d = head.shape.size(); d-- > 1; item /= head.shape[d])
      text = std::to_string(item % head.shape[d]) + (text.empty() ? "" : ",") + text;
    return text.empty() ? text : "[" + text + "]";
  }

  fs::path path_;
  std::string firstName_;
  std::uint64_t rows_ = 0, row_ = 0;
  std::vector<Array> arrays_;
  std::vector<std::string> columns_;
  std::vector<double> all_;
};

} // namespace

std::unique_ptr<MeasuredTable> openTable(const fs::path& path, char separator) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) throw Error(path.string() + ": is a folder; a file is needed");
  if (fs::is_regular_file(path, ignored)) {
    std::ifstream stream(path, std::ios::binary);
    char begin[2] = {};
    stream.read(begin, 2);
    if (begin[0] == 'P' && begin[1] == 'K') return std::make_unique<NpzTable>(path);
  }
  return std::make_unique<CsvTable>(path, separator);
}

} // namespace palp
