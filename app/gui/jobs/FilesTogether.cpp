#include "app/gui/jobs/FilesTogether.h"

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

void FilesTogether::add(const fs::path& file, const std::function<void(const fs::path&)>& write) {
  auto target = std::make_unique<AtomicFile>(file, true);
  const std::string beside = target->beside().string();
  try {
    write(target->beside());
  } catch (const Error& error) {
    std::string words = error.what(); // of the file that was asked for
    const std::size_t at = words.find(beside);
    if (at != std::string::npos) words.replace(at, beside.size(), file.string());
    throw Error(words);
  }
  files_.emplace_back(file, std::move(target));
}

bool FilesTogether::keepAs(const fs::path& file, const fs::path& other) {
  std::error_code failed;
  if (!fs::exists(file, failed)) return false;
  const auto written = std::find_if(files_.begin(), files_.end(), [&](const auto& one) { return one.first == file; });
  if (written != files_.end() && sameBytes(file, written->second->beside())) return false;
  requireFree(other, false);
  fs::rename(file, other, failed);
  if (failed) throw Error(file.string() + ": cannot be kept as " + other.string() + ": " + failed.message());
  return true;
}

void FilesTogether::commit() {
  for (const auto& [path, file] : files_) file->commit();
}

} // namespace palp
