#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace palp {

/// Throws Error if the file exists and `force` is not given, so that long work can be refused before it starts.
void requireFree(const std::filesystem::path& path, bool force);

/// A file that is written under another name in the same folder and renamed when complete; removed if it never is.
/// Anything that is not a regular file (a terminal, a pipe, /dev/null) is written directly.
class AtomicFile {
public:
  /// Throws Error if the file exists and `force` is not given.
  AtomicFile(std::filesystem::path path, bool force);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where to write; has the extension of the final name.
  [[nodiscard]] const std::filesystem::path& beside() const { return beside_; }
  /// Renames the written file to its final name. Throws Error.
  void commit();

private:
  std::filesystem::path path_;
  std::filesystem::path beside_;
  bool force_;
  bool committed_ = false;
};

/// Writes the whole file as AtomicFile does. Throws Error.
void writeFile(const std::filesystem::path& path, std::string_view content, bool force);

/// The whole file. Throws Error.
std::string readFile(const std::filesystem::path& path);

} // namespace palp
