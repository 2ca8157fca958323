#include "io/FilesTogether.h"

#include "model/base/Error.h"

#include <algorithm>

namespace palp {

namespace fs = std::filesystem;

namespace {

/// What cannot be read is the same as nothing.
bool sameBytes(const fs::path& a, const fs::path& b) {
  std::error_code failed;
  if (fs::file_size(a, failed) != fs::file_size(b, failed) || failed) return false;
  try {
    return readFile(a) == readFile(b);
  } catch (const Error&) {
    return false;
  }
}

} // namespace

FilesTogether::FilesTogether(fs::path folder) : folder_(std::move(folder)) {
  std::error_code failed;
  made_ = fs::create_directories(folder_, failed);
  if (failed) throw Error(folder_.string() + ": the folder cannot be created: " + failed.message());
}

FilesTogether::~FilesTogether() {
  files_.clear();
  std::error_code notEmpty;
  if (made_) fs::remove(folder_, notEmpty);
}

fs::path FilesTogether::add(const fs::path& file, const std::function<void(const fs::path&)>& write) {
  const fs::path path = folder_ / file;
  auto target = std::make_unique<AtomicFile>(path, true);
  target->fill(write);
  target->sync();
  files_.emplace_back(path, std::move(target));
  return files_.back().second->temporary();
}

fs::path FilesTogether::add(const fs::path& file, std::string_view content) {
  return add(file, [&](const fs::path& temporary) { writeFile(temporary, content, true); });
}

bool FilesTogether::keepAs(const fs::path& file, const fs::path& other) {
  std::error_code failed;
  if (!fs::exists(file, failed)) return false;
  const auto written = std::find_if(files_.begin(), files_.end(), [&](const auto& one) { return one.first == file; });
  if (written != files_.end() && sameBytes(file, written->second->temporary())) return false;
  requireFree(other, false);
  fs::rename(file, other, failed);
  if (failed) throw Error(file.string() + ": cannot be kept as " + other.string() + ": " + failed.message());
  return true;
}

void FilesTogether::commit() {
  for (const auto& [path, file] : files_) file->commit();
}

} // namespace palp
