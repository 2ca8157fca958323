#include "io/SamplePartWriter.h"

#include "io/SampleFile.h"
#include "io/SampleHead.h"
#include "io/samples/FillBeside.h"
#include "io/samples/RowFile.h"
#include "io/samples/SampleReader.h"
#include "model/base/Error.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr Eigen::Index kLinesAtOnce = 256;
constexpr std::size_t kPartBuffer = 1 << 20;

std::string differenceOfMakers(const std::string& before, const std::string& now) {
  if (before == now) return {};
  return "its samples were made by " + (before.empty() ? "an older palp" : before) + ", this is " + now;
}

[[noreturn]] void failToWrite(const fs::path& path) {
  throw Error(path.string() + ": cannot be written: " + std::strerror(errno)); // NOLINT(concurrency-mt-unsafe)
}

} // namespace

SamplePartWriter::SamplePartWriter(fs::path path, const SampleSet& head, bool force)
    : path_(std::move(path)), part_(linkEnd(path_).string() + ".part"), force_(force) {
  requireWritable(path_, force_);
  file_ = ::open(part_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) failToWrite(part_);
  try {
    // File systems without locks (NFS) fail in other ways: the work goes on, unlocked.
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
  if (!stream) throw Error(part_.string() + ": cannot be read: " + std::strerror(errno));
  const std::string text = sampleFileHead(head);
  std::string there(text.size(), '\0');
  stream.read(there.data(), static_cast<std::streamsize>(there.size()));
  there.resize(static_cast<std::size_t>(stream.gcount()));
  const bool begun = there.size() == text.size();
  if (text.compare(0, there.size(), there) == 0 && !begun) { // new, or cut off within the head
    if (::ftruncate(file_, 0) != 0) failToWrite(part_);
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
  if (::ftruncate(file_, static_cast<off_t>(whole)) != 0 || ::lseek(file_, 0, SEEK_END) < 0) failToWrite(part_);
}

void SamplePartWriter::append(const SampleSet& block) {
  if (rows_) {
    rows_->append(block);
    return;
  }
  std::string lines;
  for (Eigen::Index first = 0; first < block.size(); first += kLinesAtOnce) {
    lines.clear();
    appendSampleLines(lines, block, first, std::min(kLinesAtOnce, block.size() - first));
    writeAllBytes(file_, part_, lines.data(), lines.size());
  }
}

void SamplePartWriter::finish(const std::stop_token& stop) {
  std::error_code ignored;
  if (rows_) {
    AtomicFile target(path_, force_);
    fillBeside(target, path_,
               [&](const fs::path& beside) { writeSampleArrays(beside, formatToWrite(path_), rows_->rows(), stop); });
    target.commit();
    fs::remove(part_, ignored);
  } else {
    moveIntoPlace(part_, path_, force_);
  }
}

} // namespace palp
