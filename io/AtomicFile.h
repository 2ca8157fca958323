#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace palp {

/// The file to which symbolic links lead, which need not exist yet; a name that is not a link is its own end. Anything
/// but a regular file (a pipe, /dev/null) keeps its name. Throws Error if the links lead in a circle.
std::filesystem::path linkEnd(const std::filesystem::path& path);

/// Throws Error if the file exists and `force` is not given, so that long work can be refused before it starts.
void requireFree(const std::filesystem::path& path, bool force);

/// The same, and Error if the file cannot be written there: tried with a temporary file, removed again.
void requireWritable(const std::filesystem::path& path, bool force);

/// Removes the temporary files of AtomicFile that processes of this machine have left in the folder when they were
/// killed. Looks at the first thousand names at most.
void removeLeftovers(const std::filesystem::path& folder);

/// Renames a complete file to its final name, link followed, mode kept, both synchronised with the disk. Throws Error.
void moveIntoPlace(const std::filesystem::path& from, const std::filesystem::path& path, bool force);

/// A file that is written under a temporary name in the same folder and renamed when complete; removed if it never is.
/// A symbolic link is followed: the file at its end is replaced. The mode of a replaced file is kept. Anything that is
/// not a regular file (a terminal, a pipe, /dev/null) and the temporary file of another AtomicFile are written
/// directly.
class AtomicFile {
public:
  /// Makes the temporary file. Throws Error if it cannot, or if the file exists and `force` is not given.
  AtomicFile(std::filesystem::path path, bool force);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where to write; has the extension of the final name.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
  /// Lets `write` write the temporary file. Throws its Error, with the final name in place of the temporary one.
  void fill(const std::function<void(const std::filesystem::path&)>& write);
  /// Hands what was written to the disk: this is what can fail on a full one. Throws Error.
  void sync();
  /// Renames the written file, synchronised, to its final name. Throws Error.
  void commit();

private:
  std::filesystem::path path_; ///< as it was given, for refusals
  std::filesystem::path end_;  ///< of its links
  std::filesystem::path temporary_;
  bool force_;
  bool synced_ = false;
  bool committed_ = false;
};

/// Writes a complete file as AtomicFile does. Throws Error.
void writeFile(const std::filesystem::path& path, std::string_view content, bool force);

/// The content of a file. Throws Error.
std::string readFile(const std::filesystem::path& path);

} // namespace palp
