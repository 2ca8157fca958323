#include "io/AtomicFile.h"

#include "io/files/SystemError.h"
#include "io/files/TemporaryName.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <memory>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr int kMostLinks = 40; // as the kernel follows
constexpr int kMostNamesLookedAt = 1000;
constexpr int kMostTries = 100'000; // for a free temporary name

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

bool isSpecial(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

/// The errors of file systems that cannot synchronise are ignored.
void syncFile(const fs::path& file, const fs::path& name) {
  const int opened = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (opened < 0) return; // of a mode that forbids reading
  const bool failed = ::fsync(opened) != 0 && errno != EINVAL && errno != ENOSYS && errno != ENOTSUP && errno != EROFS;
  const std::string why = systemMessage();
  ::close(opened);
  if (failed) cannotWrite(name, why);
}

/// So that the new name outlives a power cut. The file already has it: a failure changes nothing any more.
void syncFolderOf(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const int opened = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened < 0) return;
  ::fsync(opened);
  ::close(opened);
}

/// Mode and, where that is allowed, owner of the file that will be replaced, if there is one.
void takeMode(const fs::path& temporary, const fs::path& end, const fs::path& name) {
  struct stat old {
  }, made{};
  if (::stat(end.c_str(), &old) != 0 || ::stat(temporary.c_str(), &made) != 0) return;
  if (::access(end.c_str(), W_OK) != 0) cannotWrite(name);
  if (old.st_uid != made.st_uid || old.st_gid != made.st_gid) {
    [[maybe_unused]] const int mayFail = ::chown(temporary.c_str(), old.st_uid, old.st_gid);
  }
  if ((old.st_mode & 07777) != (made.st_mode & 07777)) ::chmod(temporary.c_str(), old.st_mode & 07777);
}

fs::path makeTemporary(const fs::path& end, const fs::path& name) {
  for (int number = 0; number < kMostTries; ++number) {
    const fs::path temporary = end.parent_path() / temporaryName(end.filename(), number);
    const int made = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (made >= 0) {
      ::close(made);
      return temporary;
    }
    if (errno != EEXIST) cannotWrite(name);
  }
  cannotWrite(name, "every temporary name is taken");
}

void renameInto(const fs::path& from, const fs::path& end, const fs::path& name) {
  std::error_code error;
  fs::rename(from, end, error);
  if (error) cannotWrite(name, error.message());
  syncFolderOf(end);
}

} // namespace

fs::path linkEnd(const fs::path& path) {
  if (isSpecial(path)) return path;
  fs::path end = path;
  std::error_code failed;
  for (int links = 0; fs::is_symlink(fs::symlink_status(end, failed)); ++links) {
    if (links == kMostLinks) cannotWrite(path, "its symbolic links lead in a circle");
    const fs::path next = fs::read_symlink(end, failed);
    if (failed) cannotWrite(path, failed.message());
    end = next.is_absolute() ? next : end.parent_path() / next;
  }
  // An open file that has no name any more (/proc/self/fd/...) is written where it is.
  return fs::exists(path, failed) && !fs::equivalent(path, end, failed) ? path : end;
}

void requireFree(const fs::path& path, bool force) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) throw Error(path.string() + ": is a folder; a file name is needed");
  if (!force && !isSpecial(path) && !isOwnTemporary(path) && fs::exists(path, ignored))
    throw Error(path.string() + ": exists; choose another name, or --force to overwrite it");
}

void requireWritable(const fs::path& path, bool force) {
  const AtomicFile tried(path, force);
  if (isSpecial(path) && ::access(path.c_str(), W_OK) != 0) cannotWrite(path);
}

void removeLeftovers(const fs::path& folder) {
  std::error_code failed;
  fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, failed);
  for (int looked = 0; !failed && entry != fs::directory_iterator() && looked < kMostNamesLookedAt; ++looked) {
    std::error_code ignored;
    if (isOfEndedProcess(entry->path().filename())) fs::remove(entry->path(), ignored);
    entry.increment(failed);
  }
}

void moveIntoPlace(const fs::path& from, const fs::path& path, bool force) {
  requireFree(path, force);
  const fs::path end = linkEnd(path);
  takeMode(from, end, path);
  syncFile(from, path);
  renameInto(from, end, path);
}

AtomicFile::AtomicFile(fs::path path, bool force) : path_(std::move(path)), force_(force) {
  requireFree(path_, force_);
  end_ = linkEnd(path_);
  if (isSpecial(path_) || isOwnTemporary(end_)) {
    temporary_ = end_;
    return;
  }
  if (!end_.has_filename()) throw Error(path_.string() + ": is a folder; a file name is needed");
  removeLeftovers(end_.parent_path());
  temporary_ = makeTemporary(end_, path_);
  try {
    takeMode(temporary_, end_, path_);
  } catch (...) { // the destructor does not run for what was never constructed
    std::error_code ignored;
    fs::remove(temporary_, ignored);
    throw;
  }
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!committed_ && temporary_ != end_) fs::remove(temporary_, ignored);
}

void AtomicFile::fill(const std::function<void(const fs::path&)>& write) {
  try {
    write(temporary_);
  } catch (const Error& error) {
    std::string words = error.what();
    const std::size_t at = words.find(temporary_.string());
    if (at == std::string::npos) throw;
    throw Error(words.replace(at, temporary_.string().size(), path_.string()));
  }
}

void AtomicFile::sync() {
  if (temporary_ != end_ && !synced_) syncFile(temporary_, path_);
  synced_ = true;
}

void AtomicFile::commit() {
  if (temporary_ != end_) {
    requireFree(path_, force_); // it may have appeared meanwhile
    sync();
    renameInto(temporary_, end_, path_);
  }
  committed_ = true;
}

void writeFile(const fs::path& path, std::string_view content, bool force) {
  AtomicFile target(path, force);
  File file(std::fopen(target.temporary().c_str(), "wb"));
  if (!file) cannotWrite(path);
  const bool written = std::fwrite(content.data(), 1, content.size(), file.get()) == content.size();
  if (!written || std::fclose(file.release()) != 0) cannotWrite(path);
  target.commit();
}

std::string readFile(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) throw Error(path.string() + ": is a folder; a file is needed");
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) cannotRead(path);
  std::string content;
  char block[1 << 16];
  while (const std::size_t count = std::fread(block, 1, sizeof block, file.get())) content.append(block, count);
  if (std::ferror(file.get())) cannotRead(path);
  return content;
}

} // namespace palp
