#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace palp {

/// Throws Error where the file exists and `force` is not given, so that long work can refuse before it starts.
void requireFree(const std::filesystem::path& path, bool force);

/// A file that is written beside its place and renamed into it when it is whole; dropped where it never is. A place
/// that is no regular file (a terminal, a pipe, /dev/null) is written directly.
class AtomicFile {
public:
  /// Throws Error where the file exists and `force` is not given.
  AtomicFile(std::filesystem::path path, bool force);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where to write; has the extension of the final name.
  [[nodiscard]] const std::filesystem::path& beside() const { return beside_; }
  /// Moves the written file into its place. Throws Error.
  void commit();

private:
  std::filesystem::path path_;
  std::filesystem::path beside_;
  bool force_;
  bool committed_ = false;
};

/// Writes the whole file beside its place and renames it. Throws Error.
void writeFile(const std::filesystem::path& path, std::string_view content, bool force);

/// The whole file. Throws Error.
std::string readFile(const std::filesystem::path& path);

} // namespace palp
