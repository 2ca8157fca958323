#pragma once

#include "io/AtomicFile.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

namespace palp {

/// Files that change together: all are written under temporary names first, which is what can fail (a full disk); until
/// commit() existing files stay as they are, and without it nothing new stays.
class FilesTogether {
public:
  FilesTogether() = default;
  /// Makes the folder if it is missing, and removes it again if it stays empty. Throws Error.
  explicit FilesTogether(std::filesystem::path folder);
  ~FilesTogether();
  FilesTogether(const FilesTogether&) = delete;
  FilesTogether& operator=(const FilesTogether&) = delete;

  /// `write` gets the temporary name, which is returned; `file` is relative to the folder, if there is one. Throws
  /// Error, in which the file has its final name.
  std::filesystem::path add(const std::filesystem::path& file,
                            const std::function<void(const std::filesystem::path&)>& write);
  std::filesystem::path add(const std::filesystem::path& file, std::string_view content);
  /// Renames an existing file, unless the file written in its place has the same bytes. Returns false where
  /// nothing was to be done. Throws Error.
  bool keepAs(const std::filesystem::path& file, const std::filesystem::path& other);
  /// Throws Error.
  void commit();

private:
  std::filesystem::path folder_; ///< of the files; empty: each is named with its own
  bool made_ = false;            ///< the folder is ours
  std::vector<std::pair<std::filesystem::path, std::unique_ptr<AtomicFile>>> files_;
};

} // namespace palp
