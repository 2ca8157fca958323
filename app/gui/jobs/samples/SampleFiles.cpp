#include "app/gui/jobs/samples/SampleFiles.h"

#include "app/gui/jobs/NetworkSession.h"
#include "app/gui/project/FileKind.h"
#include "app/study/decoding/measured/SampleSplit.h"
#include "app/study/paper/PaperProtocol.h"
#include "io/DesignFile.h"
#include "io/FilesTogether.h"
#include "io/SampleFile.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"

#include <QFile>
#include <QMimeDatabase>
#include <QObject>

#include <algorithm>
#include <array>
#include <optional>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr int kHeldOut = 5; ///< one sample in this many is for testing, where there is no test set

/// Shards of one request, and the file that is named where they do not fit.
struct Shards {
  fs::path file;
  std::vector<SampleSet> parts;
};

SampleSet joined(Shards shards) {
  std::sort(shards.parts.begin(), shards.parts.end(),
            [](const SampleSet& a, const SampleSet& b) { return a.origin.firstSample < b.origin.firstSample; });
  SampleSet all;
  for (const SampleSet& part : shards.parts) {
    const std::size_t next = part.origin.firstSample, held = static_cast<std::size_t>(all.size());
    if (next != held)
      throw Error(shards.file.string() + ": its samples begin with number " + std::to_string(next) +
                  ", but the samples before it end with " + std::to_string(held) +
                  "; open all parts together, each once");
    append(all, part);
  }
  return all;
}

/// Every fifth sample of each area goes to the second set; of measured ones, whose neighbours are alike, the last.
std::array<SampleSet, 2> heldOut(const SampleSet& all) {
  if (all.origin.imported()) {
    SplitSamples parts = split(all, laterRows(all));
    return {std::move(parts.training), std::move(parts.test)};
  }
  std::array<std::vector<Eigen::Index>, 2> chosen;
  std::vector<int> met(static_cast<std::size_t>(all.areaCount), 0);
  for (Eigen::Index s = 0; s < all.size(); ++s) {
    const int before = met[static_cast<std::size_t>(all.area(s))]++;
    chosen[before % kHeldOut == kHeldOut - 1 ? 1 : 0].push_back(s);
  }
  return {samplesAt(all, chosen[0]), samplesAt(all, chosen[1])};
}

void requireOf(const SensorDesign& design, const SampleSet& set, const fs::path& file) {
  const std::string ours = designFingerprint(design);
  if (set.origin.designFingerprint != ours && !set.origin.imported())
    throw Error(file.string() + ": its samples belong to the design " + set.origin.designFingerprint +
                "; the open design is " + ours + ": open the design of the samples first");
  if (set.together())
    throw Error(file.string() + ": its samples load all areas together; expected samples of one loaded area each");
}

} // namespace

QString heldOutWords(const SampleSet& training) {
  return training.origin.imported() ? QObject::tr("the last fifth of the samples") : QObject::tr("every fifth sample");
}

fs::path testFileOf(const fs::path& file) {
  return file.parent_path() / (file.stem().string() + "-test" + file.extension().string());
}

void addSamples(FilesTogether& writing, const fs::path& file, const NetworkSamples& samples) {
  writing.add(testFileOf(file), [&](const fs::path& beside) { saveSamples(beside, samples.test, true); });
  writing.add(file, [&](const fs::path& beside) { saveSamples(beside, samples.training, true); });
}

void saveSampleFiles(const fs::path& file, const NetworkSamples& samples) {
  FilesTogether writing;
  addSamples(writing, file, samples);
  writing.commit();
}

/// A table of somebody else is named by what it begins with.
void requireSamples(const fs::path& file) {
  const QString name = QString::fromStdString(file.string());
  const FileKind kind = fileKind(name);
  if (kind != FileKind::Foreign && kind != FileKind::Project) return requireKind(name, FileKind::Samples);
  constexpr qsizetype kShown = 60;
  QFile source(name);
  const bool text = QMimeDatabase().mimeTypeForFile(name).inherits("text/plain") && source.size() > 0 &&
                    source.open(QIODevice::ReadOnly);
  if (!text) throw Error(foreignWords(name).toStdString());
  QByteArray line = source.readLine();
  if (kind == FileKind::Project) { // or JSON that is none of ours
    if (!(line + source.readAll()).contains("\"palp_project\"")) return;
    throw Error(QObject::tr("%1: this is a project, not samples; use File > Open").arg(name).toStdString());
  }
  while (line.startsWith('#') && !source.atEnd()) line = source.readLine(); // the head of a table of Palp
  throw Error(QObject::tr("%1: not a Palp sample file (it starts with \"%2\", expected \"# palp_samples\"). Use palp "
                          "import to convert your own measurements.")
                  .arg(name, QString::fromUtf8(line).trimmed().left(kShown))
                  .toStdString());
}

namespace {

/// Samples of one request, shard by shard, and of another one where there is one. `test`: this file's are for testing,
/// whatever request it contains.
std::vector<Shards> requestsOf(const std::vector<fs::path>& files, const fs::path& test, const SensorDesign& design,
                               const std::stop_token& stop) {
  std::vector<Shards> requests;
  std::optional<Shards> testing;
  for (const fs::path& file : files) {
    if (stop.stop_requested()) throw Cancelled();
    requireSamples(file);
    SampleSet set = loadSamples(file, stop);
    requireOf(design, set, file);
    const auto same = std::find_if(requests.begin(), requests.end(), [&](const Shards& request) {
      return differenceOfHeads(request.parts[0], set).empty();
    });
    if (file == test)
      testing = Shards{file, {std::move(set)}};
    else if (same == requests.end())
      requests.push_back({file, {std::move(set)}});
    else
      same->parts.push_back(std::move(set));
  }
  if (testing) requests.push_back(std::move(*testing));
  return requests;
}

/// Whether a file that nobody named holds samples that go with those of another one.
bool goesWith(const fs::path& file, const fs::path& other, const SensorDesign& design, const std::stop_token& stop) {
  try {
    const SampleSet samples = loadSamples(file, stop);
    requireOf(design, samples, file);
    return samples.origin.designFingerprint == loadSamples(other, stop).origin.designFingerprint;
  } catch (const Error&) {
    return false;
  }
}

/// "test" in place of "train" in the name; the file itself where it has none.
fs::path testForTrain(const fs::path& file) {
  std::string name = file.filename().string();
  if (const std::size_t at = name.rfind("train"); at != std::string::npos) name.replace(at, 5, "test");
  return file.parent_path() / name;
}

/// The one of two files that is for testing by its name.
fs::path testAmong(const std::vector<fs::path>& files) {
  if (files.size() != 2) return {};
  if (files[1] == testFileOf(files[0])) return files[1];
  return files[0] == testFileOf(files[1]) ? files[0] : fs::path();
}

} // namespace

NetworkSamples openTheseSampleFiles(const std::vector<fs::path>& files, const SensorDesign& design,
                                    const std::stop_token& stop) {
  const fs::path test = testAmong(files);
  std::vector<Shards> requests = requestsOf(files, test, design, stop);
  if (requests.size() > 2)
    throw Error(requests[2].file.string() + ": its samples belong to neither of the two sets before it (" +
                differenceOfHeads(requests[0].parts[0], requests[2].parts[0]) +
                "); expected one set for training and one for testing");
  for (const Shards& request : requests)
    if (const std::string& rig = request.parts[0].origin.designFingerprint;
        rig != requests[0].parts[0].origin.designFingerprint)
      throw Error(request.file.string() + ": its samples belong to another design or rig (" + rig + ") than those of " +
                  requests[0].file.string() + " (" + requests[0].parts[0].origin.designFingerprint + ")");
  const auto seed = [&](std::size_t k) { return requests[k].parts[0].origin.seed; };
  if (test.empty() && requests.size() == 2 && seed(0) == testSeed(seed(1))) std::swap(requests[0], requests[1]);
  NetworkSamples samples;
  samples.training = joined(std::move(requests[0]));
  if (requests.size() == 2) {
    samples.test = joined(std::move(requests[1]));
  } else {
    std::array<SampleSet, 2> sets = heldOut(samples.training);
    samples.training = std::move(sets[0]);
    samples.test = std::move(sets[1]);
    samples.split = true;
  }
  if (samples.training.size() == 0 || samples.test.size() == 0)
    throw Error(files[0].string() + ": too few samples for training and testing");
  samples.file = QString::fromStdString(files[0].string());
  samples.settings = {samples.training.origin.perArea, samples.training.origin.seed};
  if (samples.training.hasTouches()) samples.settings.touches.emplace().count = samples.training.origin.perArea;
  samples.ofNoDesign = samples.training.origin.designFingerprint != designFingerprint(design);
  return samples;
}

NetworkSamples openSampleFiles(const std::vector<fs::path>& files, const SensorDesign& design,
                               const std::stop_token& stop) {
  std::vector<fs::path> all = files;
  if (files.size() == 1) {
    const fs::path ours = testFileOf(files[0]), guessed = testForTrain(files[0]);
    if (fs::exists(ours))
      all.push_back(ours);
    else if (guessed != files[0] && fs::exists(guessed) && goesWith(guessed, files[0], design, stop))
      all.push_back(guessed);
  }
  return openTheseSampleFiles(all, design, stop);
}

} // namespace palp
