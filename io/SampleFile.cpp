#include "io/SampleFile.h"

#include "io/AtomicFile.h"
#include "io/SampleHead.h"
#include "model/base/Error.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr Eigen::Index kSamplesAtOnce = 256; ///< about 4 MB of text for the paper's design
constexpr std::size_t kStreamBuffer = 1 << 20;

/// A file opened for reading with a large buffer of its own.
class Reader {
public:
  explicit Reader(const fs::path& path) : buffer_(kStreamBuffer, '\0'), lines_(stream_, path.string()) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) throw Error(path.string() + ": is a folder; a file is needed");
    stream_.rdbuf()->pubsetbuf(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    stream_.open(path, std::ios::binary);
    if (!stream_) throw Error(path.string() + ": cannot be read: " + std::strerror(errno));
  }
  SampleLines& lines() { return lines_; }
  std::ifstream& stream() { return stream_; }

private:
  std::string buffer_;
  std::ifstream stream_;
  SampleLines lines_;
};

void resizeColumns(SampleSet& set, Eigen::Index columns) {
  set.area.conservativeResize(columns);
  for (Eigen::MatrixXd* part : {&set.forces_N, &set.displacements_mm, &set.resistances_ohm})
    part->conservativeResize(Eigen::NoChange, columns);
}

std::string sizes(const SampleSet& set) {
  return std::to_string(set.rowWires) + " row-wires x " + std::to_string(set.electrodesPerRowWire) + " electrodes, " +
         std::to_string(set.columnWires) + " column-wires, " + std::to_string(set.areaCount) + " areas";
}

std::string differenceOfHeads(const SampleSet& a, const SampleSet& b) {
  std::string differs = difference(a.origin, b.origin);
  if (differs.empty() && sizes(a) != sizes(b)) differs = "size differs: " + sizes(a) + " and " + sizes(b);
  if (differs.empty() && sampleColumns(a) != sampleColumns(b)) differs = "the columns differ";
  return differs;
}

/// Samples of the whole request that the origin describes.
std::size_t wholeRequest(const SampleSet& head) {
  const auto perArea = static_cast<std::size_t>(head.origin.perArea);
  return head.origin.areas == "each" ? perArea * static_cast<std::size_t>(head.areaCount) : perArea;
}

struct Part {
  fs::path path;
  SampleSet head;
};

std::vector<Part> readHeads(const std::vector<fs::path>& paths) {
  std::vector<Part> parts;
  for (const fs::path& path : paths) {
    Reader reader(path);
    parts.push_back({path, readSampleHead(reader.lines())});
    const std::string differs = differenceOfHeads(parts[0].head, parts.back().head);
    if (!differs.empty()) throw Error(path.string() + ": does not belong to " + paths[0].string() + ": " + differs);
  }
  std::sort(parts.begin(), parts.end(),
            [](const Part& a, const Part& b) { return a.head.origin.firstSample < b.head.origin.firstSample; });
  return parts;
}

/// Copies the sample lines, checked; returns their number.
std::size_t copyLines(const fs::path& from, std::ofstream& to) {
  Reader reader(from);
  SampleSet scratch = readSampleHead(reader.lines());
  resizeColumns(scratch, 1);
  std::size_t count = 0;
  for (std::string line; reader.lines().next(line); ++count) {
    readSampleLine(reader.lines(), line, scratch, 0);
    to << line << '\n';
  }
  return count;
}

std::string systemReason() {
  return std::strerror(errno); // NOLINT(concurrency-mt-unsafe)
}

} // namespace

void saveSamples(const fs::path& path, const SampleSet& set, bool force) {
  AtomicFile target(path, force);
  std::ofstream stream(target.beside(), std::ios::binary);
  stream << sampleFileHead(set);
  std::string lines;
  for (Eigen::Index first = 0; first < set.size() && stream; first += kSamplesAtOnce) {
    lines.clear();
    appendSampleLines(lines, set, first, std::min(kSamplesAtOnce, set.size() - first));
    stream << lines;
  }
  stream.close();
  if (!stream) throw Error(path.string() + ": cannot be written: " + systemReason());
  target.commit();
}

SampleSet loadSamples(const fs::path& path) {
  Reader reader(path);
  SampleSet set = readSampleHead(reader.lines());
  Eigen::Index count = 0;
  for (std::string line; reader.lines().next(line); ++count) {
    if (count == set.area.size()) resizeColumns(set, std::max<Eigen::Index>(kSamplesAtOnce, 2 * count));
    readSampleLine(reader.lines(), line, set, count);
  }
  resizeColumns(set, count);
  return set;
}

std::size_t mergeSampleFiles(const std::vector<fs::path>& paths, const fs::path& path, bool force) {
  if (paths.empty()) throw Error(path.string() + ": no shards to join; name at least one file");
  AtomicFile target(path, force);
  const std::vector<Part> parts = readHeads(paths);
  std::ofstream stream(target.beside(), std::ios::binary);
  SampleSet head = parts[0].head;
  head.origin.firstSample = 0;
  stream << sampleFileHead(head);
  std::size_t done = 0;
  for (const Part& part : parts) {
    const std::size_t first = part.head.origin.firstSample;
    if (first != done)
      throw Error(part.path.string() + ": begins at sample " + std::to_string(first) +
                  "; the shards before it end at sample " + std::to_string(done) +
                  (first < done ? ", so that some stand twice" : ", so that some are missing"));
    done += copyLines(part.path, stream);
  }
  if (done != wholeRequest(head))
    throw Error(path.string() + ": the shards hold " + std::to_string(done) + " samples; the whole request has " +
                std::to_string(wholeRequest(head)));
  stream.close();
  if (!stream) throw Error(path.string() + ": cannot be written: " + systemReason());
  target.commit();
  return done;
}

SamplePartWriter::SamplePartWriter(fs::path path, const SampleSet& head, bool force)
    : path_(std::move(path)), part_(path_.string() + ".part"), force_(force) {
  requireFree(path_, force_);
  file_ = ::open(part_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) throw Error(part_.string() + ": cannot be written: " + systemReason());
  try {
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0)
      throw Error(part_.string() + ": another process is writing it; wait for it, or choose another name");
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
  Reader reader(part_);
  const std::string text = sampleFileHead(head);
  std::string there(text.size(), '\0');
  reader.stream().read(there.data(), static_cast<std::streamsize>(there.size()));
  there.resize(static_cast<std::size_t>(reader.stream().gcount()));
  if (text.compare(0, there.size(), there) == 0 && there.size() < text.size()) { // new, or cut off within the head
    if (::ftruncate(file_, 0) != 0) throw Error(part_.string() + ": cannot be written: " + systemReason());
    write(text);
    return;
  }
  if (there != text) {
    Reader again(part_);
    const SampleSet old = readSampleHead(again.lines());
    std::string differs = differenceOfHeads(old, head);
    if (differs.empty()) differs = "the head differs (shard, or error of the surrogate)";
    throw Error(part_.string() + ": is of other work: " + differs + "; repeat that work, or delete the file");
  }
  std::size_t whole = text.size();
  const std::size_t fields = sampleFields(head);
  for (std::string line; reader.lines().next(line, true); ++samplesKept_) {
    if (static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1 != fields) break;
    whole += line.size() + 1;
  }
  if (::ftruncate(file_, static_cast<off_t>(whole)) != 0 || ::lseek(file_, 0, SEEK_END) < 0)
    throw Error(part_.string() + ": cannot be written: " + systemReason());
}

void SamplePartWriter::append(const SampleSet& block) {
  std::string lines;
  for (Eigen::Index first = 0; first < block.size(); first += kSamplesAtOnce) {
    lines.clear();
    const Eigen::Index count = std::min(kSamplesAtOnce, block.size() - first);
    appendSampleLines(lines, block, first, count);
    write(lines);
  }
}

void SamplePartWriter::write(const std::string& lines) {
  for (std::size_t done = 0; done < lines.size();) {
    const ssize_t count = ::write(file_, lines.data() + done, lines.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw Error(part_.string() + ": cannot be written: " + systemReason());
    done += static_cast<std::size_t>(count);
  }
}

void SamplePartWriter::finish() {
  requireFree(path_, force_);
  std::error_code error;
  fs::rename(part_, path_, error);
  if (error) throw Error(path_.string() + ": cannot be written: " + error.message());
}

} // namespace palp
