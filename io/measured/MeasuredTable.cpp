#include "io/measured/MeasuredTable.h"

#include "io/ImportDraft.h"
#include "model/base/Error.h"

#include <array>
#include <fstream>
#include <string_view>

namespace palp {

namespace fs = std::filesystem;

using namespace std::string_view_literals;

namespace {

/// A kind of file other than a table, by its first bytes, and the way out.
struct OtherKind {
  std::string_view begins;
  const char* advice;
};

constexpr std::array kOtherKinds{
    OtherKind{"\x1f\x8b"sv, "is compressed by gzip; unpack it first: gunzip FILE"},
    OtherKind{"BZh"sv, "is compressed by bzip2; unpack it first: bunzip2 FILE"},
    OtherKind{"\xfd"
              "7zXZ"sv,
              "is compressed by xz; unpack it first: unxz FILE"},
    OtherKind{"\x28\xb5\x2f\xfd"sv, "is compressed by zstd; unpack it first: unzstd FILE"},
    OtherKind{"7z\xbc\xaf"sv, "is a 7-Zip archive; unpack it first"},
    OtherKind{"Rar!"sv, "is a RAR archive; unpack it first"},
    OtherKind{"\xd0\xcf\x11\xe0"sv, "is an old Excel file (xls); save the sheet as CSV"},
    OtherKind{"%PDF"sv, "is a PDF; a table of numbers is needed"},
    OtherKind{"PAR1"sv, "is a Parquet file; write CSV, NPZ or HDF5, for instance by pandas: to_csv"},
    OtherKind{"ARROW1"sv, "is a Feather file; write CSV, NPZ or HDF5, for instance by pandas: to_csv"},
    OtherKind{"SQLite format 3"sv, "is an SQLite database; write the table as CSV"},
    OtherKind{"\x93NUMPY"sv, "is one NumPy array; save it with its names by numpy.savez: NPZ"},
    OtherKind{"TDSm"sv, "is a LabVIEW TDMS file; write the channels as CSV"},
    OtherKind{"HDF_"sv, "is an HDF4 file; convert it to HDF5 or CSV"},
};

std::string firstBytes(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string begin(4096, '\0');
  stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(stream.gcount()));
  return begin;
}

bool isZip(std::string_view begin) {
  return begin.starts_with("PK\x03\x04");
}

bool isHdf5(std::string_view begin) {
  return begin.starts_with("\x89HDF\r\n") || begin.starts_with("MATLAB ");
}

/// Empty for tables and arrays. A zip file may be NPZ, or the sheets of a spreadsheet.
std::string adviceFor(std::string_view begin) {
  const std::string_view first = begin.size() > 30 ? begin.substr(30, 60) : std::string_view{};
  if (isZip(begin) &&
      (first.starts_with("[Content_Types].xml") || first.starts_with("xl/") || first.starts_with("_rels/")))
    return "is an Excel file (xlsx); save the sheet as CSV";
  if (isZip(begin) && first.starts_with("mimetype"))
    return "is a spreadsheet (ods) or another document; save the sheet as CSV";
  for (const OtherKind& kind : kOtherKinds)
    if (begin.starts_with(kind.begins)) return kind.advice;
  return {};
}

} // namespace

std::unique_ptr<MeasuredTable> openTable(const fs::path& path, const TableForm& form) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) throw Error(path.string() + ": is a folder; a file is needed");
  if (!fs::is_regular_file(path, ignored)) return openTextTable(path, form); // a pipe is read only once
  const std::string begin = firstBytes(path);
  if (const std::string advice = adviceFor(begin); !advice.empty()) throw Error(path.string() + ": " + advice);
  if (isZip(begin)) return openNpzTable(path);
  return isHdf5(begin) ? openHdf5Table(path) : openTextTable(path, form);
}

std::string whyNoTable(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) ? adviceFor(firstBytes(file)) : std::string();
}

} // namespace palp
