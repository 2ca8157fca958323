#pragma once

#include "io/AtomicFile.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace palp {

/// Files that change together: all are written beside their places first, which is what can fail (a full disk); until
/// commit() those that are there stay as they are.
class FilesTogether {
public:
  /// `write` gets the place beside this file. Throws Error.
  void add(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write);
  /// A file that is there leaves its name for another one, unless what is written in its place is the same. False where
  /// nothing was to be done. Throws Error.
  bool keepAs(const std::filesystem::path& file, const std::filesystem::path& other);
  /// Throws Error.
  void commit();

private:
  std::vector<std::pair<std::filesystem::path, std::unique_ptr<AtomicFile>>> files_;
};

} // namespace palp
