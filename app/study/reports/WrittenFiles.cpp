#include "app/study/reports/WrittenFiles.h"

#include <system_error>
#include <utility>

namespace palp {

WrittenFiles::WrittenFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

WrittenFiles::~WrittenFiles() {
  std::error_code ignored;
  for (const std::filesystem::path& file : files_) std::filesystem::remove(file, ignored);
}

std::filesystem::path WrittenFiles::add(const std::string& name) {
  files_.push_back(folder_ / name);
  return files_.back();
}

} // namespace palp
