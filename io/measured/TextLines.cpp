#include "io/measured/TextLines.h"

#include "io/files/SystemError.h"
#include "model/base/Error.h"

#include <algorithm>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kBuffer_bytes = 1 << 16;
constexpr std::size_t kLongestLine = 4 << 20;

void appendUtf8(std::string& text, std::uint32_t point) {
  const auto add = [&text](std::uint32_t byte) { text.push_back(static_cast<char>(byte)); };
  if (point < 0x80) return add(point);
  if (point < 0x800) {
    add(0xC0 | point >> 6);
  } else if (point < 0x10000) {
    add(0xE0 | point >> 12);
    add(0x80 | (point >> 6 & 0x3F));
  } else {
    add(0xF0 | point >> 18);
    add(0x80 | (point >> 12 & 0x3F));
    add(0x80 | (point >> 6 & 0x3F));
  }
  add(0x80 | (point & 0x3F));
}

/// Whether the bytes are UTF-8 in form: each leading byte has its continuation bytes.
bool isUtf8(const std::string& text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i++]);
    int more = byte < 0x80                   ? 0
               : byte >= 0xC2 && byte < 0xE0 ? 1
               : byte >= 0xE0 && byte < 0xF0 ? 2
               : byte >= 0xF0 && byte < 0xF5 ? 3
                                             : -1;
    for (; more > 0 && i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0) == 0x80; ++i) --more;
    if (more != 0) return false;
  }
  return true;
}

std::string fromLatin1(const std::string& text) {
  std::string utf8;
  for (const char letter : text) appendUtf8(utf8, static_cast<unsigned char>(letter));
  return utf8;
}

} // namespace

TextLines::TextLines(const fs::path& path) : path_(path), stream_(path, std::ios::binary), buffer_(kBuffer_bytes) {
  if (!stream_) cannotRead(path);
  std::error_code ignored;
  if (fs::is_regular_file(path, ignored)) size_ = static_cast<double>(fs::file_size(path, ignored));
  detectEncoding();
}

void TextLines::detectEncoding() {
  stream_.read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  filled_ = static_cast<std::size_t>(stream_.gcount());
  const auto begins = [this](std::initializer_list<int> bytes) {
    std::size_t i = 0;
    for (const int byte : bytes)
      if (i == filled_ || static_cast<unsigned char>(buffer_[i++]) != byte) return false;
    at_ = bytes.size();
    return true;
  };
  if (begins({0xEF, 0xBB, 0xBF})) return;
  if (begins({0xFF, 0xFE}))
    encoding_ = Encoding::LittleEndian;
  else if (begins({0xFE, 0xFF}))
    encoding_ = Encoding::BigEndian;
  else { // UTF-16 of Latin letters has a zero in every second byte
    const std::size_t looked = std::min<std::size_t>(filled_ / 2 * 2, 64);
    std::size_t zeros[2] = {};
    for (std::size_t i = 0; i < looked; ++i) zeros[i % 2] += buffer_[i] == 0 ? 1 : 0;
    if (looked >= 4 && zeros[1] == looked / 2 && zeros[0] == 0) encoding_ = Encoding::LittleEndian;
    if (looked >= 4 && zeros[0] == looked / 2 && zeros[1] == 0) encoding_ = Encoding::BigEndian;
  }
}

bool TextLines::nextByte(unsigned char& byte) {
  if (at_ == filled_) {
    if (!stream_) return false;
    stream_.read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    filled_ = static_cast<std::size_t>(stream_.gcount());
    at_ = 0;
    if (filled_ == 0) return false;
  }
  byte = static_cast<unsigned char>(buffer_[at_++]);
  ++read_;
  return true;
}

bool TextLines::nextUnit(std::uint32_t& unit) {
  unsigned char first = 0, second = 0;
  if (!nextByte(first)) return false;
  unit = first;
  if (encoding_ == Encoding::Bytes) return true;
  if (!nextByte(second)) refuse("the file ends in the middle of a letter of UTF-16");
  unit = encoding_ == Encoding::LittleEndian ? second << 8U | first : first << 8U | second;
  return true;
}

void TextLines::append(std::string& line, std::uint32_t unit) {
  if (encoding_ == Encoding::Bytes) {
    line.push_back(static_cast<char>(unit));
  } else if (unit >= 0xD800 && unit < 0xDC00) {
    highSurrogate_ = unit;
  } else if (unit >= 0xDC00 && unit < 0xE000) {
    appendUtf8(line, 0x10000 + ((highSurrogate_ & 0x3FF) << 10) + (unit & 0x3FF));
  } else {
    appendUtf8(line, unit);
  }
}

bool TextLines::next(std::string& line) {
  line.clear();
  std::uint32_t unit = 0;
  bool any = false;
  ++number_;
  withoutEnd_ = false;
  while (nextUnit(unit)) {
    if (unit == '\n' && afterCarriageReturn_ && !any) { // the second half of the line end before
      afterCarriageReturn_ = false;
      continue;
    }
    afterCarriageReturn_ = unit == '\r';
    any = true;
    if (unit == '\n' || unit == '\r') break;
    if (unit == 0) refuse("contains a zero byte; this is not a text table");
    append(line, unit);
    if (line.size() > kLongestLine)
      refuse("longer than " + std::to_string(kLongestLine >> 20U) + " MB; this is not a table");
  }
  if (!any) return false;
  withoutEnd_ = unit != '\n' && unit != '\r';
  if (encoding_ == Encoding::Bytes && !isUtf8(line)) line = fromLatin1(line);
  return true;
}

double TextLines::share() const {
  return size_ > 0 ? std::min(1.0, read_ / size_) : 1;
}

void TextLines::refuse(const std::string& sentence) const {
  throw Error(path_.string() + ", line " + std::to_string(number_) + ": " + sentence);
}

} // namespace palp
