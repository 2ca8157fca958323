#pragma once

// Private to io: the lines of a text file that any program wrote.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace palp {

/// Reads a text file line by line as UTF-8, whatever ends its lines (LF, CR LF or CR) and whether it is UTF-8, with or
/// without a byte order mark, UTF-16, or Latin-1 (lines that are not valid UTF-8). Memory does not grow with the file.
class TextLines {
public:
  /// Throws Error if the file cannot be read.
  explicit TextLines(const std::filesystem::path& path);

  /// The next line without its end; false at the end of the file. Throws Error with the number of the line where it
  /// has a zero byte or is longer than any line of a table.
  bool next(std::string& line);
  /// Number of the line that next() returned last, from 1.
  [[nodiscard]] std::size_t number() const { return number_; }
  /// Whether that line was the file's last and had no line end, as in a file that was cut off.
  [[nodiscard]] bool withoutEnd() const { return withoutEnd_; }
  /// Share of the file that has been read, 0 to 1.
  [[nodiscard]] double share() const;

private:
  enum class Encoding { Bytes, LittleEndian, BigEndian };

  bool nextUnit(std::uint32_t& unit); ///< a byte, or 16 bits
  bool nextByte(unsigned char& byte);
  void detectEncoding();
  void append(std::string& line, std::uint32_t unit);
  [[noreturn]] void refuse(const std::string& sentence) const;

  std::filesystem::path path_;
  std::ifstream stream_;
  std::vector<char> buffer_;
  std::size_t at_ = 0, filled_ = 0;
  double size_ = 0, read_ = 0; ///< bytes
  Encoding encoding_ = Encoding::Bytes;
  std::uint32_t highSurrogate_ = 0;
  std::size_t number_ = 0;
  bool afterCarriageReturn_ = false;
  bool withoutEnd_ = false;
};

} // namespace palp
