#include "app/gui/jobs/ResultFiles.h"

#include "app/gui/project/ProjectFile.h"
#include "app/study/paper/PaperProtocol.h"
#include "io/AtomicFile.h"
#include "io/DecoderFile.h"
#include "io/DesignFile.h"
#include "io/SampleFile.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"

#include <QFile>

#include <algorithm>
#include <set>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr const char* kSamples = "samples.csv";
constexpr const char* kNetwork = "network.json";
constexpr const char* kKept = "networks";
constexpr const char* kDecoder = ".network.json";
constexpr const char* kSettings = ".settings.json";
constexpr const char* kMade = "yyyyMMdd-HHmmss-zzz";
constexpr int kHeldOut = 5; ///< one sample of so many tests, where no set of its own does

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
                  ", but those before it end with " + std::to_string(held) + "; choose all parts, each once");
    append(all, part);
  }
  return all;
}

SampleSet columns(const SampleSet& set, const std::vector<Eigen::Index>& chosen) {
  SampleSet part = set;
  part.area = set.area(chosen);
  part.forces_N = set.forces_N(Eigen::all, chosen);
  part.displacements_mm = set.displacements_mm(Eigen::all, chosen);
  part.resistances_ohm = set.resistances_ohm(Eigen::all, chosen);
  return part;
}

/// Every fifth sample of each area goes to the second set.
std::array<SampleSet, 2> heldOut(const SampleSet& all) {
  std::array<std::vector<Eigen::Index>, 2> chosen;
  std::vector<int> met(static_cast<std::size_t>(all.areaCount), 0);
  for (Eigen::Index s = 0; s < all.size(); ++s) {
    const int before = met[static_cast<std::size_t>(all.area(s))]++;
    chosen[before % kHeldOut == kHeldOut - 1 ? 1 : 0].push_back(s);
  }
  return {columns(all, chosen[0]), columns(all, chosen[1])};
}

/// As in the settings: "4", "1,4,7" or "all".
std::string rowsInWords(const DecoderInput& input) {
  if (static_cast<int>(input.rows.size()) == input.rowWires) return "all";
  std::string words;
  for (const int row : input.rows) words += (words.empty() ? "" : ",") + std::to_string(row);
  return words;
}

void requireOf(const SensorDesign& design, const SampleSet& set, const fs::path& file) {
  const std::string ours = designFingerprint(design);
  if (set.origin.designFingerprint != ours)
    throw Error(file.string() + ": its samples are of the design " + set.origin.designFingerprint +
                "; the design that is open is " + ours + ": open the one they were made of first");
  if (set.together())
    throw Error(file.string() + ": its samples load all areas together; allowed here are samples of one area each");
}

} // namespace

fs::path testFileOf(const fs::path& file) {
  return file.parent_path() / (file.stem().string() + "-test" + file.extension().string());
}

void saveSampleFiles(const fs::path& file, const NetworkSamples& samples) {
  saveSamples(testFileOf(file), samples.test, true);
  saveSamples(file, samples.training, true);
}

NetworkSamples openSampleFiles(const std::vector<fs::path>& files, const SensorDesign& design,
                               const std::stop_token& stop) {
  std::vector<fs::path> all = files;
  if (files.size() == 1 && fs::exists(testFileOf(files[0]))) all.push_back(testFileOf(files[0]));
  std::vector<Shards> requests;
  for (const fs::path& file : all) {
    if (stop.stop_requested()) throw Cancelled();
    SampleSet set = loadSamples(file);
    requireOf(design, set, file);
    const auto same = std::find_if(requests.begin(), requests.end(), [&](const Shards& request) {
      return difference(request.parts[0].origin, set.origin).empty();
    });
    if (same == requests.end())
      requests.push_back({file, {std::move(set)}});
    else
      same->parts.push_back(std::move(set));
  }
  if (requests.size() > 2)
    throw Error(requests[2].file.string() + ": its samples belong to neither of the two sets before it (" +
                difference(requests[0].parts[0].origin, requests[2].parts[0].origin) +
                "); allowed is one set for training and one for testing");
  const auto seed = [&](std::size_t k) { return requests[k].parts[0].origin.seed; };
  if (requests.size() == 2 && seed(0) == testSeed(seed(1))) std::swap(requests[0], requests[1]);
  NetworkSamples samples;
  samples.training = joined(std::move(requests[0]));
  if (requests.size() == 2) {
    samples.test = joined(std::move(requests[1]));
  } else {
    std::array<SampleSet, 2> sets = heldOut(samples.training);
    samples.training = std::move(sets[0]);
    samples.test = std::move(sets[1]);
  }
  if (samples.training.size() == 0 || samples.test.size() == 0)
    throw Error(all[0].string() + ": too few samples to train with and to test with");
  samples.settings = {samples.training.origin.perArea, samples.training.origin.seed};
  return samples;
}

std::shared_ptr<const NetworkFit> triedOn(Decoder decoder, const NetworkSamples& samples) {
  auto fit = std::make_shared<NetworkFit>();
  fit->decoder = std::move(decoder);
  fit->settings.input = fit->decoder.input.kind;
  fit->settings.mode = fit->decoder.mode;
  fit->settings.decoder = fit->decoder.kind;
  fit->settings.spread = fit->decoder.report.spread;
  fit->settings.rows = rowsInWords(fit->decoder.input);
  fit->settings.noise = fit->decoder.noise;
  fit->settings.seed = fit->decoder.seed;
  fit->madeFrom = samples.settings;
  fit->made = QDateTime::currentDateTime();
  fit->prediction = predict(fit->decoder, samples.test);
  fit->error = decoderError(fit->decoder, fit->prediction, samples.test);
  return fit;
}

namespace {

/// The name of a kept network's files, by the moment it was made.
std::string stemOf(const NetworkFit& fit) {
  return fit.made.toString(kMade).toStdString();
}

/// Those that are there stay as they are: a network does not change.
void saveKept(const fs::path& folder, const NetworkResults& results) {
  std::error_code ignored;
  std::set<std::string> stems;
  if (!results.kept.empty()) fs::create_directories(folder, ignored); // else the first file cannot be written
  for (const auto& fit : results.kept) {
    const std::string stem = stemOf(*fit);
    stems.insert(stem);
    if (!fs::exists(folder / (stem + kSettings)))
      writeFile(folder / (stem + kSettings), networkText(fit->settings).toStdString(), true);
    if (!fs::exists(folder / (stem + kDecoder))) writeNetwork(fit->decoder, folder / (stem + kDecoder));
  }
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    const std::string stem = name.substr(0, name.find('.'));
    const bool ours = (name == stem + kSettings || name == stem + kDecoder) &&
                      QDateTime::fromString(QString::fromStdString(stem), kMade).isValid();
    if (ours && !stems.contains(stem)) old.push_back(entry.path()); // what somebody else has put there stays
  }
  for (const fs::path& file : old) fs::remove(file, ignored);
}

void openKept(const fs::path& folder, NetworkResults& results, const std::stop_token& stop) {
  std::vector<std::string> stems;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(kDecoder)) stems.push_back(name.substr(0, name.size() - std::string(kDecoder).size()));
  }
  std::sort(stems.rbegin(), stems.rend()); // the newest first
  for (const std::string& stem : stems) {
    if (stop.stop_requested()) throw Cancelled();
    auto fit = std::make_shared<NetworkFit>(*triedOn(readNetwork(folder / (stem + kDecoder)), *results.samples));
    QFile settings(QString::fromStdString((folder / (stem + kSettings)).string()));
    if (settings.open(QIODevice::ReadOnly)) fit->settings = parseNetwork(settings.readAll(), settings.fileName());
    fit->made = QDateTime::fromString(QString::fromStdString(stem), kMade);
    if (fit->settings.testNoise == 0) fit->triedOn = results.samples; // else with its noise when it is gone back to
    const bool shown = results.fit && results.fit->decoder.trainedWith == fit->decoder.trainedWith &&
                       results.fit->decoder.report.seconds == fit->decoder.report.seconds;
    results.kept.push_back(fit);
    if (shown) results.fit = fit;
  }
}

} // namespace

void saveResults(const fs::path& folder, const NetworkResults& results) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) throw Error(folder.string() + ": cannot be made: " + failed.message());
  if (results.samples) saveSampleFiles(folder / kSamples, *results.samples);
  if (results.fit)
    writeNetwork(results.fit->decoder, folder / kNetwork);
  else
    fs::remove(folder / kNetwork, failed);
  saveKept(folder / kKept, results);
}

NetworkResults openResults(const fs::path& folder, const SensorDesign& design, const std::stop_token& stop) {
  NetworkResults results;
  results.design = design;
  if (!fs::exists(folder / kSamples)) return results;
  results.samples = std::make_shared<const NetworkSamples>(openSampleFiles({folder / kSamples}, design, stop));
  if (fs::exists(folder / kNetwork)) {
    auto fit = std::make_shared<NetworkFit>(*triedOn(readNetwork(folder / kNetwork), *results.samples));
    fit->triedOn = results.samples;
    results.fit = std::move(fit);
  }
  openKept(folder / kKept, results, stop);
  return results;
}

} // namespace palp
