#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace palp {

/// The files of a report in the making: gone again where it is never finished (cancelled, disk full).
class WrittenFiles {
public:
  explicit WrittenFiles(std::filesystem::path folder);
  ~WrittenFiles();
  WrittenFiles(const WrittenFiles&) = delete;
  WrittenFiles& operator=(const WrittenFiles&) = delete;

  /// Where to write the file of this name.
  std::filesystem::path add(const std::string& name);
  /// The report is finished: its files stay.
  void keep() { files_.clear(); }

private:
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> files_;
};

} // namespace palp
