#include "io/samples/Npz.h"

#include "io/files/SystemError.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"

#include <minizip/unzip.h>
#include <minizip/zip.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <utility>

namespace palp {

namespace {

static_assert(std::endian::native == std::endian::little, "the arrays are little-endian");

constexpr char kNpyMagic[] = "\x93NUMPY";
constexpr std::size_t kMagicLength = 6;
constexpr std::size_t kHeadStep = 64; ///< the numbers begin at a multiple of it
constexpr std::size_t kLongestNpyHead = 1 << 16;
constexpr std::size_t kLongestText_bytes = 1 << 14;
constexpr std::uint64_t kMostTextBytes = 1 << 28;
constexpr std::size_t kReadAtOnce = 1 << 20;

std::string npyHeadText(const std::string& type, const std::vector<std::uint64_t>& shape) {
  std::string text = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (";
  for (const std::uint64_t size : shape) text += std::to_string(size) + ", ";
  if (shape.size() > 1) text.resize(text.size() - 2); // (3, 4), but (3, )
  text += "), }";
  const std::size_t before = kMagicLength + 4;
  while ((before + text.size() + 1) % kHeadStep != 0) text += ' ';
  return text + '\n';
}

/// NumPy's texts have four bytes a character; ours are ASCII.
std::string wide(const std::string& text, std::size_t length) {
  std::string bytes(4 * length, '\0');
  for (std::size_t i = 0; i < text.size(); ++i) bytes[4 * i] = text[i];
  return bytes;
}

/// What follows 'key': in the head, a dictionary of Python's; empty if it is missing.
std::string valueAfter(const std::string& head, const std::string& key) {
  const std::size_t at = head.find("'" + key + "':");
  if (at == std::string::npos) return {};
  const std::size_t first = head.find_first_not_of(' ', at + key.size() + 3);
  if (first == std::string::npos) return {};
  const char ends = head[first] == '\'' ? '\'' : head[first] == '(' ? ')' : ',';
  const std::size_t last = head.find(ends, first + 1);
  return last == std::string::npos ? std::string() : head.substr(first, last - first + (ends == ',' ? 0 : 1));
}

/// "(3, 4)".
bool readShape(const std::string& text, std::vector<std::uint64_t>& shape) {
  const char* next = text.data() + 1;
  const char* const end = text.data() + text.size() - 1;
  while (next < end) {
    if (*next == ' ' || *next == ',') {
      ++next;
      continue;
    }
    std::uint64_t size = 0;
    const auto [stop, error] = std::from_chars(next, end, size);
    if (error != std::errc() || size > (std::uint64_t{1} << 40U)) return false;
    shape.push_back(size);
    next = stop;
  }
  return shape.size() <= 4;
}

std::string systemWords() {
  return errno != 0 ? systemMessage() : "the zip file cannot grow";
}

/// Numbers of one of NumPy's types, converted; what cannot be converted (NaN to an integer) gives its smallest.
template <class From, class To> void convert(std::span<const unsigned char> bytes, std::span<To> values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    From value;
    std::memcpy(&value, bytes.data() + i * sizeof(From), sizeof(From));
    const auto real = static_cast<double>(value);
    if constexpr (std::is_same_v<To, double>)
      values[i] = real;
    else
      values[i] =
          std::abs(real) < 2e9 && real == std::floor(real) ? static_cast<To>(real) : std::numeric_limits<To>::lowest();
  }
}

} // namespace

std::size_t NpyHead::itemBytes() const {
  std::size_t size = 0;
  if (type.size() > 2) std::from_chars(type.data() + 2, type.data() + type.size(), size);
  return type.size() > 1 && type[1] == 'U' ? 4 * size : size;
}

std::uint64_t NpyHead::items() const {
  std::uint64_t count = 1;
  constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
  for (const std::uint64_t size : shape) count = size > 0 && count > most / size ? most : count * size;
  return count;
}

NpzWriter::NpzWriter(std::filesystem::path path) : path_(std::move(path)) {
  errno = 0;
  zip_ = zipOpen64(path_.c_str(), APPEND_STATUS_CREATE);
  if (zip_ == nullptr) fail();
}

NpzWriter::~NpzWriter() {
  if (zip_ != nullptr) zipClose(zip_, nullptr);
}

void NpzWriter::fail() const {
  throw Error(path_.string() + ": cannot be written: " + systemWords());
}

void NpzWriter::begin(const std::string& name, const std::string& type, const std::vector<std::uint64_t>& shape) {
  const std::string head = npyHeadText(type, shape);
  const NpyHead what{type, shape};
  zip_fileinfo about{};
  about.tmz_date.tm_mday = 1;
  about.tmz_date.tm_year = 1980; // the first of zip's days: the same bytes at any time
  errno = 0;
  const int large = what.items() * what.itemBytes() + head.size() + kHeadStep >= 0xFFFFFFFFU ? 1 : 0;
  if (zipOpenNewFileInZip64(zip_, (name + ".npy").c_str(), &about, nullptr, 0, nullptr, 0, nullptr, 0, 0, large) !=
      ZIP_OK)
    fail();
  std::string bytes(kNpyMagic, kMagicLength);
  bytes += std::string("\x01\x00", 2);
  bytes += static_cast<char>(head.size() % 256);
  bytes += static_cast<char>(head.size() / 256);
  bytes += head;
  write({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
}

void NpzWriter::write(std::span<const unsigned char> bytes) {
  errno = 0;
  for (std::size_t done = 0; done < bytes.size();) {
    const std::size_t count = std::min<std::size_t>(bytes.size() - done, 1U << 30U);
    if (zipWriteInFileInZip(zip_, bytes.data() + done, static_cast<unsigned>(count)) != ZIP_OK) fail();
    done += count;
  }
}

void NpzWriter::end() {
  errno = 0;
  if (zipCloseFileInZip(zip_) != ZIP_OK) fail();
}

void NpzWriter::scalar(const std::string& name, const std::variant<std::string, std::uint64_t, double>& value) {
  if (const auto* text = std::get_if<std::string>(&value)) {
    const std::size_t length = std::max<std::size_t>(1, text->size());
    const std::string bytes = wide(*text, length);
    begin(name, "<U" + std::to_string(length), {});
    write({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
  } else if (const auto* whole = std::get_if<std::uint64_t>(&value)) {
    begin(name, "<u8", {});
    write({reinterpret_cast<const unsigned char*>(whole), sizeof *whole});
  } else {
    begin(name, "<f8", {});
    write({reinterpret_cast<const unsigned char*>(&std::get<double>(value)), sizeof(double)});
  }
  end();
}

void NpzWriter::texts(const std::string& name, const std::vector<std::string>& texts) {
  std::size_t length = 1;
  for (const std::string& one : texts) length = std::max(length, one.size());
  begin(name, "<U" + std::to_string(length), {texts.size()});
  for (const std::string& one : texts) {
    const std::string bytes = wide(one, length);
    write({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
  }
  end();
}

void NpzWriter::close() {
  errno = 0;
  if (zipClose(std::exchange(zip_, nullptr), nullptr) != ZIP_OK) fail();
}

NpzArray::NpzArray(const std::filesystem::path& path, const std::string& name)
    : where_(path.string() + ": array " + name) {
  zip_ = unzOpen64(path.c_str());
  if (zip_ == nullptr) throw Error(path.string() + ": not a complete zip file (cut off or damaged)");
  try {
    if (unzLocateFile(zip_, (name + ".npy").c_str(), 1) != UNZ_OK) refuse("is missing");
    unz_file_info64 about;
    if (unzGetCurrentFileInfo64(zip_, &about, nullptr, 0, nullptr, 0, nullptr, 0) != UNZ_OK ||
        unzOpenCurrentFile(zip_) != UNZ_OK)
      refuse("cannot be read; the file is damaged");
    readHead(about.uncompressed_size);
  } catch (...) { // the destructor does not run for what was never constructed
    unzClose(zip_);
    throw;
  }
}

NpzArray::~NpzArray() {
  unzCloseCurrentFile(zip_);
  unzClose(zip_);
}

void NpzArray::refuse(const std::string& sentence) const {
  throw Error(where_ + " " + sentence);
}

void NpzArray::readBytes(std::span<unsigned char> bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const std::size_t most = std::min<std::size_t>(bytes.size() - done, 1U << 30U);
    const int count = unzReadCurrentFile(zip_, bytes.data() + done, static_cast<unsigned>(most));
    if (count <= 0) refuse("cannot be read to its end; the file is damaged");
    done += static_cast<std::size_t>(count);
  }
  // At the end of the array minizip compares the check sum.
  if (unzeof(zip_) == 1 && unzCloseCurrentFile(zip_) == UNZ_CRCERROR)
    refuse("has a wrong checksum; the file is damaged");
}

void NpzArray::readHead(std::uint64_t size) {
  unsigned char begin[12];
  readBytes(std::span(begin, 8));
  if (std::memcmp(begin, kNpyMagic, kMagicLength) != 0 || begin[6] < 1 || begin[6] > 3)
    refuse("is not an array of NumPy, version 1 to 3");
  const std::size_t sizeBytes = begin[6] == 1 ? 2 : 4;
  readBytes(std::span(begin + 8, sizeBytes));
  std::size_t length = 0;
  for (std::size_t i = sizeBytes; i-- > 0;) length = 256 * length + begin[8 + i];
  if (length > kLongestNpyHead) refuse("has a head that is too long");
  std::string text(length, '\0');
  readBytes({reinterpret_cast<unsigned char*>(text.data()), length});
  const std::string type = valueAfter(text, "descr"), shape = valueAfter(text, "shape");
  if (type.size() < 4 || shape.size() < 2 || shape[0] != '(' || !readShape(shape, head_.shape))
    refuse(gotExpected(type + " of shape " + shape, "numbers or texts of up to four dimensions"));
  head_.type = type.substr(1, type.size() - 2);
  if (head_.type[0] == '>') refuse(gotExpected("big-endian numbers", "little-endian"));
  if (head_.shape.size() > 1 && valueAfter(text, "fortran_order") != "False")
    refuse(gotExpected("Fortran order", "C order (numpy.ascontiguousarray)"));
  const std::size_t item = head_.itemBytes();
  if (item == 0 || item > kLongestText_bytes || head_.items() > size ||
      head_.items() * item != size - 8 - sizeBytes - length)
    refuse("has another number of bytes than given in its head");
}

template <class Number> void NpzArray::readAs(std::span<Number> values) {
  const std::size_t item = head_.itemBytes(), atOnce = kReadAtOnce / item;
  std::vector<unsigned char> bytes;
  const char kind = head_.type[1];
  for (std::size_t done = 0; done < values.size();) {
    const std::size_t count = std::min(atOnce, values.size() - done);
    bytes.resize(count * item);
    readBytes(bytes);
    const std::span<Number> part = values.subspan(done, count);
    if (kind == 'f' && item == 8)
      convert<double>(bytes, part);
    else if (kind == 'f' && item == 4)
      convert<float>(bytes, part);
    else if (kind == 'i' && item == 8)
      convert<std::int64_t>(bytes, part);
    else if (kind == 'i' && item == 4)
      convert<std::int32_t>(bytes, part);
    else if (kind == 'i' && item == 2)
      convert<std::int16_t>(bytes, part);
    else if (kind == 'i' && item == 1)
      convert<std::int8_t>(bytes, part);
    else if (kind == 'u' && item == 8)
      convert<std::uint64_t>(bytes, part);
    else if (kind == 'u' && item == 4)
      convert<std::uint32_t>(bytes, part);
    else if (kind == 'u' && item == 2)
      convert<std::uint16_t>(bytes, part);
    else if ((kind == 'u' || kind == 'b') && item == 1)
      convert<std::uint8_t>(bytes, part);
    else
      refuse(gotExpected("type " + head_.type, "real numbers of 1 to 8 bytes"));
    done += count;
  }
}

void NpzArray::read(std::span<double> values) {
  readAs(values);
}

void NpzArray::read(std::span<std::int32_t> values) {
  readAs(values);
}

std::vector<std::string> NpzArray::texts() {
  const std::uint64_t count = head_.items();
  const std::size_t item = head_.itemBytes();
  if (count * item > kMostTextBytes) refuse("is too large for texts");
  std::vector<std::string> texts;
  if (!head_.isText()) {
    std::vector<double> numbers(count);
    const bool whole = head_.type[1] != 'f';
    if (whole && item == 8) { // more digits than a double has
      std::vector<unsigned char> bytes(count * item);
      readBytes(bytes);
      for (std::uint64_t i = 0; i < count; ++i) {
        std::uint64_t value = 0;
        std::memcpy(&value, bytes.data() + i * item, item);
        texts.push_back(head_.type[1] == 'i' ? std::to_string(static_cast<std::int64_t>(value))
                                             : std::to_string(value));
      }
      return texts;
    }
    read(numbers);
    for (const double value : numbers) texts.push_back(whole ? std::to_string(std::llround(value)) : text(value));
    return texts;
  }
  std::vector<unsigned char> bytes(count * item);
  readBytes(bytes);
  const std::size_t step = head_.type[1] == 'U' ? 4 : 1;
  for (std::uint64_t i = 0; i < count; ++i) {
    std::string& one = texts.emplace_back();
    for (std::size_t at = 0; at < item && bytes[i * item + at] != 0; at += step) {
      const unsigned char* const letter = &bytes[i * item + at];
      if (*letter > 127 || std::any_of(letter + 1, letter + step, [](unsigned char b) { return b != 0; }))
        refuse("contains a character that is not ASCII");
      one += static_cast<char>(bytes[i * item + at]);
    }
  }
  return texts;
}

std::map<std::string, NpyHead> npzArrays(const std::filesystem::path& path) {
  const unzFile zip = unzOpen64(path.c_str());
  if (zip == nullptr) throw Error(path.string() + ": not a complete zip file (cut off or damaged)");
  std::set<std::string> names;
  int result = unzGoToFirstFile(zip);
  for (; result == UNZ_OK; result = unzGoToNextFile(zip)) {
    char name[1024] = {};
    if (unzGetCurrentFileInfo64(zip, nullptr, name, sizeof name - 1, nullptr, 0, nullptr, 0) != UNZ_OK) break;
    names.insert(name);
  }
  unzClose(zip);
  std::map<std::string, NpyHead> arrays;
  if (result != UNZ_END_OF_LIST_OF_FILE) throw Error(path.string() + ": not a complete zip file (cut off or damaged)");
  for (const std::string& name : names)
    if (name.ends_with(".npy")) {
      const std::string array = name.substr(0, name.size() - 4);
      arrays.emplace(array, NpzArray(path, array).head());
    }
  if (arrays.empty()) throw Error(path.string() + ": contains no arrays of NumPy (.npy)");
  return arrays;
}

} // namespace palp
