#include "io/SampleFile.h"

#include "io/AtomicFile.h"
#include "io/SampleHead.h"
#include "io/samples/Hdf5Samples.h"
#include "io/samples/NpzSamples.h"
#include "io/samples/RowFile.h"
#include "io/samples/SampleReader.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr Eigen::Index kSamplesAtOnce = 256; ///< about 4 MB of text for the paper's design

std::string sizes(const SampleSet& set) {
  return std::to_string(set.rowWires) + " row-wires x " + std::to_string(set.electrodesPerRowWire) + " electrodes, " +
         std::to_string(set.columnWires) + " column-wires, " + std::to_string(set.areaCount) + " areas";
}

/// Samples of the whole request that the origin describes.
std::size_t wholeRequest(const SampleSet& head) {
  const auto perArea = static_cast<std::size_t>(head.origin.perArea);
  return head.origin.areas == "each" ? perArea * static_cast<std::size_t>(head.areaCount) : perArea;
}

std::string systemReason() {
  return std::strerror(errno); // NOLINT(concurrency-mt-unsafe)
}

struct Part {
  fs::path path;
  SampleSet head;
};

std::vector<Part> readHeads(const std::vector<fs::path>& paths) {
  std::vector<Part> parts;
  for (const fs::path& path : paths) {
    parts.push_back({path, openSamples(path)->head()});
    const std::string differs = differenceOfHeads(parts[0].head, parts.back().head);
    if (!differs.empty()) throw Error(path.string() + ": does not belong to " + paths[0].string() + ": " + differs);
  }
  std::sort(parts.begin(), parts.end(),
            [](const Part& a, const Part& b) { return a.head.origin.firstSample < b.head.origin.firstSample; });
  return parts;
}

/// Hands the samples of all parts to `take`, block by block; returns their number.
template <class Take>
std::size_t readParts(const std::vector<Part>& parts, const std::stop_token& stop, const Take& take) {
  std::size_t done = 0;
  for (const Part& part : parts) {
    const std::size_t first = part.head.origin.firstSample;
    if (first != done)
      throw Error(part.path.string() + ": begins at sample " + std::to_string(first) +
                  "; the shards before it end at sample " + std::to_string(done) +
                  (first < done ? ", so that some stand twice" : ", so that some are missing"));
    const auto reader = openSamples(part.path);
    const Eigen::Index atOnce = samplesAtOnce(reader->head());
    SampleSet block = reader->head();
    for (Eigen::Index count = atOnce; count == atOnce;) {
      resizeSamples(block, atOnce);
      count = reader->read(block, 0, atOnce, stop);
      if (count < atOnce) resizeSamples(block, count);
      take(block);
      done += static_cast<std::size_t>(count);
    }
  }
  return done;
}

/// A file without a name that is gone with this object.
class NamelessFile {
public:
  explicit NamelessFile(const fs::path& beside) {
    std::string name = beside.string() + ".XXXXXX";
    id_ = ::mkstemp(name.data());
    if (id_ < 0) throw Error(beside.string() + ": cannot be written: " + systemReason());
    ::unlink(name.c_str());
  }
  ~NamelessFile() { ::close(id_); }
  NamelessFile(const NamelessFile&) = delete;
  NamelessFile& operator=(const NamelessFile&) = delete;
  [[nodiscard]] int id() const { return id_; }

private:
  int id_;
};

} // namespace

std::string differenceOfHeads(const SampleSet& a, const SampleSet& b) {
  std::string differs = difference(a.origin, b.origin);
  if (differs.empty() && sizes(a) != sizes(b)) differs = "size differs: " + sizes(a) + " and " + sizes(b);
  if (differs.empty() && sampleColumns(a) != sampleColumns(b)) differs = "the columns differ";
  return differs;
}

void saveSamples(const fs::path& path, const SampleSet& set, bool force, const std::stop_token& stop) {
  AtomicFile target(path, force);
  const SampleFormat format = formatToWrite(path);
  if (format != SampleFormat::Csv) {
    writeSampleArrays(target.beside(), format,
                      {samplesBetween(set, 0, 0), set.size(),
                       [&set](Eigen::Index first, Eigen::Index count) { return samplesBetween(set, first, count); }},
                      stop);
    target.commit();
    return;
  }
  std::ofstream stream(target.beside(), std::ios::binary);
  stream << sampleFileHead(set);
  std::string lines;
  for (Eigen::Index first = 0; first < set.size() && stream; first += kSamplesAtOnce) {
    stopIfAsked(stop);
    lines.clear();
    appendSampleLines(lines, set, first, std::min(kSamplesAtOnce, set.size() - first));
    stream << lines;
  }
  stream.close();
  if (!stream) throw Error(path.string() + ": cannot be written: " + systemReason());
  target.commit();
}

SampleSet loadSamples(const fs::path& path, const std::stop_token& stop) {
  const auto reader = openSamples(path);
  SampleSet set = reader->head();
  if (const auto size = reader->size()) {
    resizeSamples(set, *size);
    reader->read(set, 0, *size, stop);
    return set;
  }
  Eigen::Index count = 0;
  for (Eigen::Index room = kSamplesAtOnce;; room *= 2) {
    resizeSamples(set, room);
    count += reader->read(set, count, room - count, stop);
    if (count < room) break;
  }
  resizeSamples(set, count);
  return set;
}

std::size_t mergeSampleFiles(const std::vector<fs::path>& paths, const fs::path& path, bool force,
                             const std::stop_token& stop) {
  if (paths.empty()) throw Error(path.string() + ": no shards to join; name at least one file");
  AtomicFile target(path, force);
  const std::vector<Part> parts = readHeads(paths);
  SampleSet head = parts[0].head;
  head.origin.firstSample = 0;
  const auto requireWhole = [&](std::size_t done) {
    if (done != wholeRequest(head))
      throw Error(path.string() + ": the shards hold " + std::to_string(done) + " samples; the whole request has " +
                  std::to_string(wholeRequest(head)));
    return done;
  };
  std::size_t done = 0;
  if (formatToWrite(path) == SampleFormat::Csv) {
    std::ofstream stream(target.beside(), std::ios::binary);
    stream << sampleFileHead(head);
    std::string lines;
    done = requireWhole(readParts(parts, stop, [&](const SampleSet& block) {
      lines.clear();
      appendSampleLines(lines, block, 0, block.size());
      stream << lines;
    }));
    stream.close();
    if (!stream) throw Error(path.string() + ": cannot be written: " + systemReason());
  } else {
    const NamelessFile between(target.beside());
    RowFile rows(between.id(), path, 0, head);
    done = requireWhole(readParts(parts, stop, [&](const SampleSet& block) { rows.append(block); }));
    writeSampleArrays(target.beside(), formatToWrite(path), rows.rows(), stop);
  }
  target.commit();
  return done;
}

} // namespace palp
