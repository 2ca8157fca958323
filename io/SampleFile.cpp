#include "io/SampleFile.h"

#include "io/SampleHead.h"
#include "io/samples/Hdf5Child.h"
#include "io/samples/Npz.h"
#include "io/samples/SampleArrays.h"
#include "io/samples/SampleReader.h"
#include "io/samples/SampleWriter.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr Eigen::Index kSamplesAtOnce = 256;

std::string sizes(const SampleSet& set) {
  return std::to_string(set.rowWires) + " row-wires x " + std::to_string(set.electrodesPerRowWire) + " electrodes, " +
         std::to_string(set.columnWires) + " column-wires, " + std::to_string(set.areaCount) + " areas";
}

/// Samples of the complete request that the origin describes.
std::size_t wholeRequest(const SampleSet& head) {
  const auto perArea = static_cast<std::size_t>(head.origin.perArea);
  return head.origin.areas == "each" ? perArea * static_cast<std::size_t>(head.areaCount) : perArea;
}

struct Part {
  fs::path path;
  SampleSet head;
};

std::vector<Part> readHeads(const std::vector<fs::path>& paths, const std::stop_token& stop) {
  std::vector<Part> parts;
  for (const fs::path& path : paths) {
    parts.push_back({path, openSamples(path, stop)->head()});
    const std::string differs = differenceOfHeads(parts[0].head, parts.back().head);
    if (!differs.empty()) throw Error(path.string() + ": does not belong to " + paths[0].string() + ": " + differs);
  }
  std::sort(parts.begin(), parts.end(),
            [](const Part& a, const Part& b) { return a.head.origin.firstSample < b.head.origin.firstSample; });
  return parts;
}

std::string makersOf(const std::vector<Part>& parts) {
  std::string all = parts[0].head.origin.madeBy;
  for (const Part& part : parts) all = joinedMakers(all, part.head.origin.madeBy);
  return all;
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
                  (first < done ? ", so that some appear twice" : ", so that some are missing"));
    const auto reader = openSamples(part.path, stop);
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

} // namespace

std::string differenceOfHeads(const SampleSet& a, const SampleSet& b) {
  std::string differs = difference(a.origin, b.origin);
  if (differs.empty() && sizes(a) != sizes(b)) differs = "size differs: " + sizes(a) + " and " + sizes(b);
  if (differs.empty() && sampleColumns(a) != sampleColumns(b)) differs = "the columns differ";
  return differs;
}

void saveSamples(const fs::path& path, const SampleSet& set, bool force, const std::stop_token& stop) {
  const SampleFormat format = formatToWrite(path);
  const auto block = [&set](Eigen::Index first, Eigen::Index count) { return samplesBetween(set, first, count); };
  if (format != SampleFormat::Csv) { // the set is requested again and again
    AtomicFile target(path, force);
    target.fill([&](const fs::path& temporary) {
      writeSampleArrays(temporary, format, {block(0, 0), set.size(), block}, stop);
    });
    target.commit();
    return;
  }
  SampleWriter writer(path, set, force);
  for (Eigen::Index first = 0; first < set.size(); first += kSamplesAtOnce) {
    throwIfStopped(stop);
    writer.append(block(first, std::min(kSamplesAtOnce, set.size() - first)));
  }
  writer.finish(stop);
}

bool hasSampleArrays(const fs::path& path) {
  constexpr const char* key = "palp_samples";
  try {
    std::ifstream stream(path, std::ios::binary);
    std::string begin(2, '\0');
    stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
    return begin == "PK" ? npzArrays(path).contains(key) : Hdf5Child(path).attributes().contains(key);
  } catch (const Error&) {
    return true;
  }
}

SampleSet loadSamples(const fs::path& path, const std::stop_token& stop, bool alsoTwoAtOnce) {
  const auto reader = openSamples(path, stop);
  SampleSet set = reader->head();
  if (set.secondTouch.rows() > 0 && !alsoTwoAtOnce)
    throw Error(path.string() + ": touches in each sample: " +
                gotExpected("2 together", "1 (palp predict takes two, and counts those distinguished from one)"));
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

namespace {

/// Sessions of one rig: each is a run, or as many as it has, after those before.
MergedSamples mergeMeasured(const std::vector<fs::path>& paths, const fs::path& path, bool force,
                            const std::stop_token& stop) {
  SampleSet all;
  for (const fs::path& part : paths) {
    SampleSet session = loadSamples(part, stop);
    if (session.runs.rows() == 0) session.runs = Eigen::MatrixXd::Zero(1, session.size());
    if (all.size() > 0) {
      session.runs.array() += all.runs.maxCoeff() + 1;
      if (session.origin.mesh != all.origin.mesh)
        all.origin.mesh += "; " + session.origin.mesh.substr(std::string(kImportedFrom).size());
      session.origin.mesh = all.origin.mesh;
      if (const std::string differs = differenceOfHeads(all, session); !differs.empty())
        throw Error(part.string() + ": cannot be joined with " + paths.front().string() + ": " + differs);
    }
    append(all, session);
  }
  saveSamples(path, all, force, stop);
  return {static_cast<std::size_t>(all.size()), {}};
}

} // namespace

MergedSamples mergeSampleFiles(const std::vector<fs::path>& paths, const fs::path& path, bool force,
                               const std::stop_token& stop) {
  if (paths.empty()) throw Error(path.string() + ": no shards to join; name at least one file");
  requireFree(path, force);
  if (paths.size() > 1 && openSamples(paths.front(), stop)->head().origin.imported())
    return mergeMeasured(paths, path, force, stop);
  const std::vector<Part> parts = readHeads(paths, stop);
  SampleSet head = parts[0].head;
  head.origin.firstSample = 0;
  head.origin.madeBy = makersOf(parts);
  SampleWriter writer(path, head, force);
  const std::size_t done = readParts(parts, stop, [&](const SampleSet& block) { writer.append(block); });
  if (head.origin.perArea > 0 && done != wholeRequest(head)) // measured samples are of no request
    throw Error(path.string() + ": the shards contain " + std::to_string(done) + " samples; the complete request has " +
                std::to_string(wholeRequest(head)));
  writer.finish(stop);
  const bool mixed = head.origin.madeBy != parts[0].head.origin.madeBy;
  return {done, mixed ? "the shards were made by several programs, whose results may differ in their last digits: " +
                            head.origin.madeBy
                      : ""};
}

std::string samplesText(const SampleSet& set) {
  std::string text = sampleFileHead(set);
  writeSampleLines(set, [&](const std::string& lines) { text += lines; });
  return text;
}

SampleSet parseSamples(const std::string& text, const std::string& name) {
  std::istringstream stream(text);
  SampleLines lines(stream, name);
  SampleSet set = readSampleHead(lines);
  resizeSamples(set, std::count(text.begin(), text.end(), '\n')); // more than there are: the head has lines, too
  std::string line;
  Eigen::Index count = 0;
  for (; lines.next(line); ++count) readSampleLine(lines, line, set, count);
  resizeSamples(set, count);
  return set;
}

} // namespace palp
