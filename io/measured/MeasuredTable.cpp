#include "io/measured/MeasuredTable.h"

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

/// A zip file: NPZ, or the sheets of a spreadsheet.
std::unique_ptr<MeasuredTable> openZip(const fs::path& path, std::string_view begin) {
  const bool named = begin.size() > 30;
  const std::string_view first = named ? begin.substr(30, 60) : std::string_view{};
  if (first.find("[Content_Types].xml") == 0 || first.find("xl/") == 0 || first.find("_rels/") == 0)
    throw Error(path.string() + ": is an Excel file (xlsx); save the sheet as CSV");
  if (first.starts_with("mimetype"))
    throw Error(path.string() + ": is a spreadsheet (ods) or another document; save the sheet as CSV");
  return openNpzTable(path);
}

} // namespace

std::unique_ptr<MeasuredTable> openTable(const fs::path& path, const TableForm& form) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) throw Error(path.string() + ": is a folder; a file is needed");
  if (!fs::is_regular_file(path, ignored)) return openTextTable(path, form); // a pipe is read only once
  const std::string begin = firstBytes(path);
  if (begin.starts_with("PK\x03\x04")) return openZip(path, begin);
  if (begin.starts_with("\x89HDF\r\n") || begin.starts_with("MATLAB ")) return openHdf5Table(path);
  for (const OtherKind& kind : kOtherKinds)
    if (begin.starts_with(kind.begins)) throw Error(path.string() + ": " + kind.advice);
  return openTextTable(path, form);
}

} // namespace palp
