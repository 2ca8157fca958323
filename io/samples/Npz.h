#pragma once

// Private to io: arrays of NumPy in a zip file (numpy.lib.format, version 1.0 to 3.0; zip by minizip).

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace palp {

/// The head of a .npy.
struct NpyHead {
  std::string type; ///< "<f8", "<i4", "<U12"
  std::vector<std::uint64_t> shape;
  /// Bytes of one number or text.
  [[nodiscard]] std::size_t itemBytes() const;
  /// Product of the shape; the largest number where it is larger than that.
  [[nodiscard]] std::uint64_t items() const;
  [[nodiscard]] bool isText() const { return type.size() > 2 && (type[1] == 'U' || type[1] == 'S'); }
};

/// Writes arrays one after the other, not compressed, as numpy.savez does. Throws Error with the file's name.
class NpzWriter {
public:
  explicit NpzWriter(std::filesystem::path path);
  ~NpzWriter();
  NpzWriter(const NpzWriter&) = delete;
  NpzWriter& operator=(const NpzWriter&) = delete;

  /// Begins an array; its bytes follow by write(), the last index fastest.
  void begin(const std::string& name, const std::string& type, const std::vector<std::uint64_t>& shape);
  void write(std::span<const unsigned char> bytes);
  void end();
  /// One text, whole number or number without dimensions.
  void scalar(const std::string& name, const std::variant<std::string, std::uint64_t, double>& value);
  void texts(const std::string& name, const std::vector<std::string>& texts);
  /// Without it the file is of no use.
  void close();

private:
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  void* zip_ = nullptr;
};

/// One array of a file, read from its beginning to its end; compressed ones (numpy.savez_compressed) too. Throws Error
/// with the names of file and array.
class NpzArray {
public:
  NpzArray(const std::filesystem::path& path, const std::string& name);
  ~NpzArray();
  NpzArray(const NpzArray&) = delete;
  NpzArray& operator=(const NpzArray&) = delete;

  [[nodiscard]] const NpyHead& head() const { return head_; }
  /// The next numbers of any type that NumPy has for real ones, as doubles.
  void read(std::span<double> values);
  void read(std::span<std::int32_t> values);
  /// All texts of an array of texts; all numbers as shortest text.
  [[nodiscard]] std::vector<std::string> texts();
  [[noreturn]] void refuse(const std::string& sentence) const;

private:
  void readBytes(std::span<unsigned char> bytes);
  void readHead(std::uint64_t size);
  template <class Number> void readAs(std::span<Number> values);

  std::string where_;
  void* zip_ = nullptr;
  NpyHead head_;
};

/// Names of the arrays in a file, without ".npy", with their heads. Throws Error where it is not a zip file of
/// arrays.
std::map<std::string, NpyHead> npzArrays(const std::filesystem::path& path);

} // namespace palp
