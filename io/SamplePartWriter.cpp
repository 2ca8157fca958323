#include "io/SamplePartWriter.h"

#include "io/SampleFile.h"
#include "io/SampleHead.h"
#include "io/files/SystemError.h"
#include "io/samples/RowFile.h"
#include "io/samples/SampleReader.h"
#include "model/base/Error.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <sstream>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kPartBuffer = 1 << 20;

std::string differenceOfMakers(const std::string& before, const std::string& now) {
  if (before == now) return {};
  return "its samples were made by " + (before.empty() ? "an older palp" : before) + ", this is " + now;
}

} // namespace

SamplePartWriter::SamplePartWriter(fs::path path, const SampleSet& head, bool force)
    : path_(std::move(path)), part_(linkEnd(path_).string() + ".part"), force_(force) {
  requireWritable(path_, force_);
  file_ = ::open(part_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) cannotWrite(part_);
  try {
    // File systems without locks (NFS) fail in other ways: the work continues, unlocked.
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      throw Error(part_.string() +
                  ": another process is writing it; wait until it has finished, or choose another name");
    resume(head);
  } catch (...) { // the destructor does not run for what was never constructed
    ::close(file_);
    throw;
  }
}

SamplePartWriter::~SamplePartWriter() {
  ::close(file_);
}

void SamplePartWriter::resume(const SampleSet& head) {
  std::string buffer(kPartBuffer, '\0');
  std::ifstream stream;
  stream.rdbuf()->pubsetbuf(buffer.data(), static_cast<std::streamsize>(buffer.size()));
  stream.open(part_, std::ios::binary);
  if (!stream) cannotRead(part_);
  const std::string text = sampleFileHead(head);
  std::string there(text.size(), '\0');
  stream.read(there.data(), static_cast<std::streamsize>(there.size()));
  there.resize(static_cast<std::size_t>(stream.gcount()));
  const bool begun = there.size() == text.size();
  if (text.compare(0, there.size(), there) == 0 && !begun) { // new, or cut off within the head
    if (::ftruncate(file_, 0) != 0) cannotWrite(part_);
    writeAllBytes(file_, part_, text.data(), text.size());
  } else if (there != text) {
    std::ifstream again(part_, std::ios::binary);
    SampleLines lines(again, part_.string());
    const SampleSet before = readSampleHead(lines);
    std::string differs = differenceOfHeads(before, head);
    if (differs.empty()) differs = differenceOfMakers(before.origin.madeBy, head.origin.madeBy);
    if (differs.empty()) differs = "the head differs (shard, or error of the surrogate)";
    throw Error(part_.string() + ": belongs to another request: " + differs +
                "; repeat that request, or delete the file");
  }
  if (formatToWrite(path_) == SampleFormat::Csv) {
    if (begun) keepWholeLines(stream, head, text.size());
    return;
  }
  rows_ = std::make_unique<RowFile>(file_, part_, static_cast<off_t>(text.size()), samplesBetween(head, 0, 0));
  samplesKept_ = static_cast<std::size_t>(rows_->count());
}

void SamplePartWriter::keepWholeLines(std::istream& stream, const SampleSet& head, std::size_t headBytes) {
  SampleLines lines(stream, part_.string());
  std::size_t whole = headBytes;
  const std::size_t fields = sampleFields(head);
  for (std::string line; lines.next(line, true); ++samplesKept_) {
    if (static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1 != fields) break;
    whole += line.size() + 1;
  }
  if (::ftruncate(file_, static_cast<off_t>(whole)) != 0 || ::lseek(file_, 0, SEEK_END) < 0) cannotWrite(part_);
}

void SamplePartWriter::append(const SampleSet& block) {
  if (rows_) {
    rows_->append(block);
    return;
  }
  writeSampleLines(block, [&](const std::string& lines) { writeAllBytes(file_, part_, lines.data(), lines.size()); });
}

void SamplePartWriter::finish(const std::stop_token& stop) {
  std::error_code ignored;
  if (rows_) {
    AtomicFile target(path_, force_);
    target.fill(
        [&](const fs::path& temporary) { writeSampleArrays(temporary, formatToWrite(path_), rows_->rows(), stop); });
    target.commit();
    fs::remove(part_, ignored);
  } else {
    moveIntoPlace(part_, path_, force_);
  }
}

} // namespace palp
