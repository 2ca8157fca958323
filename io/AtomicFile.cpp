#include "io/AtomicFile.h"

#include "model/base/Error.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace palp {

namespace fs = std::filesystem;

namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

std::string reason() {
  return std::strerror(errno); // NOLINT(concurrency-mt-unsafe)
}

bool isSpecial(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

fs::path besidePath(const fs::path& path) {
  fs::path name = "." + path.stem().string() + ".new" + std::to_string(::getpid()) + path.extension().string();
  return path.parent_path() / name;
}

} // namespace

void requireFree(const fs::path& path, bool force) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) throw Error(path.string() + ": is a folder; a file name is needed");
  if (!force && !isSpecial(path) && fs::exists(path, ignored))
    throw Error(path.string() + ": exists already; choose another name, or --force to overwrite it");
}

AtomicFile::AtomicFile(fs::path path, bool force) : path_(std::move(path)), force_(force) {
  requireFree(path_, force_);
  beside_ = isSpecial(path_) ? path_ : besidePath(path_);
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!committed_ && beside_ != path_) fs::remove(beside_, ignored);
}

void AtomicFile::commit() {
  requireFree(path_, force_); // it may have appeared meanwhile
  std::error_code error;
  if (beside_ != path_) fs::rename(beside_, path_, error);
  if (error) throw Error(path_.string() + ": cannot be written: " + error.message());
  committed_ = true;
}

void writeFile(const fs::path& path, std::string_view content, bool force) {
  AtomicFile target(path, force);
  File file(std::fopen(target.beside().c_str(), "wb"));
  if (!file) throw Error(path.string() + ": cannot be written: " + reason());
  const bool written = std::fwrite(content.data(), 1, content.size(), file.get()) == content.size();
  if (!written || std::fclose(file.release()) != 0) throw Error(path.string() + ": cannot be written: " + reason());
  target.commit();
}

std::string readFile(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) throw Error(path.string() + ": is a folder; a file is needed");
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) throw Error(path.string() + ": cannot be read: " + reason());
  std::string content;
  char block[1 << 16];
  while (const std::size_t count = std::fread(block, 1, sizeof block, file.get())) content.append(block, count);
  if (std::ferror(file.get())) throw Error(path.string() + ": cannot be read: " + reason());
  return content;
}

} // namespace palp
