#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>

/// A temporary file that holds the fuzzer's bytes, for readers that take a path. A real one: the HDF5 library does not
/// open files that are in memory only.
class FuzzedFile {
public:
  FuzzedFile()
      : path_((std::filesystem::temp_directory_path() / "palp-fuzz-XXXXXX").string()),
        descriptor_(mkstemp(path_.data())) {
    if (descriptor_ < 0) std::abort();
  }
  ~FuzzedFile() {
    ::close(descriptor_);
    ::unlink(path_.c_str());
  }
  FuzzedFile(const FuzzedFile&) = delete;
  FuzzedFile& operator=(const FuzzedFile&) = delete;

  void hold(std::span<const std::uint8_t> bytes) const {
    if (ftruncate(descriptor_, 0) != 0) std::abort();
    if (pwrite(descriptor_, bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) std::abort();
  }
  [[nodiscard]] const std::string& path() const { return path_; }

private:
  std::string path_;
  int descriptor_;
};
