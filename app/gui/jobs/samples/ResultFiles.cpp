#include "app/gui/jobs/samples/ResultFiles.h"

#include "app/gui/jobs/samples/SampleFiles.h"
#include "app/gui/jobs/samples/SweepsFile.h"
#include "app/gui/project/ProjectFile.h"
#include "app/study/paper/PaperProtocol.h"
#include "io/AtomicFile.h"
#include "io/DecoderFile.h"
#include "io/FilesTogether.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "nn/NoisyCopies.h"

#include <QFile>

#include <algorithm>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr const char* kSamples = "samples.csv";
constexpr const char* kTestSamples = "samples-test.csv"; // testFileOf()
constexpr const char* kNetwork = "network.json";
constexpr const char* kSweeps = "sweeps.json";
constexpr const char* kKept = "networks";
constexpr const char* kDecoder = ".network.json";
constexpr const char* kSettings = ".settings.json";
constexpr const char* kName = ".name.txt"; ///< that the user gave it
constexpr const char* kMade = "yyyyMMdd-HHmmss-zzz";

/// As in the settings: "4", "1,4,7" or "all".
std::string rowsInWords(const DecoderInput& input) {
  if (static_cast<int>(input.rows.size()) == input.rowWires) return "all";
  std::string words;
  for (const int row : input.rows) words += (words.empty() ? "" : ",") + std::to_string(row);
  return words;
}

/// What the network's file contains; it is not evaluated yet.
NetworkFit ofDecoder(Decoder decoder, const NetworkSamples& samples) {
  NetworkFit fit;
  fit.decoder = std::move(decoder);
  fit.settings.input = fit.decoder.input.kind;
  fit.settings.mode = fit.decoder.mode;
  fit.settings.decoder = fit.decoder.kind;
  fit.settings.chosenSpread = fit.decoder.report.spread;
  fit.settings.rows = rowsInWords(fit.decoder.input);
  if (fit.decoder.place) fit.settings.target = DecoderTarget::ForceAndPlace;
  fit.settings.noise = fit.decoder.noise;
  fit.settings.seed = fit.decoder.seed;
  fit.madeFrom = samples.settings;
  fit.made = QDateTime::currentDateTime();
  return fit;
}

} // namespace

void tryOn(NetworkFit& fit, const NetworkSamples& samples, const std::stop_token& stop) {
  PredictOptions plain;
  plain.standardDeviation = plain.area = false;
  const Eigen::MatrixXd clean = inputsOf(samples.test, fit.decoder.input);
  // Of another seed than the training's noise: a network must not meet in the test what it was fitted to.
  fit.prediction = predict(fit.decoder, samples.test,
                           noisyCopies(clean, fit.settings.testNoise, 1, testSeed(fit.settings.seed), stop), plain);
  fit.error = decoderError(fit.decoder, fit.prediction, samples.test);
}

std::shared_ptr<const NetworkFit> triedOn(Decoder decoder, const NetworkSamples& samples) {
  auto fit = std::make_shared<NetworkFit>(ofDecoder(std::move(decoder), samples));
  tryOn(*fit, samples, {});
  return fit;
}

namespace {

/// The name of a kept network's files, by the moment it was made.
std::string stemOf(const QDateTime& made) {
  return made.toString(kMade).toStdString();
}

QDateTime madeOf(const std::string& stem) {
  return QDateTime::fromString(QString::fromStdString(stem), kMade);
}

/// One line of text; no file: no name.
QString nameIn(const fs::path& file) {
  constexpr int kLongest = 80;
  QFile in(QString::fromStdString(file.string()));
  return in.open(QIODevice::ReadOnly) ? QString::fromUtf8(in.read(4 * kLongest)).simplified().left(kLongest)
                                      : QString();
}

void saveName(const fs::path& file, const QString& name) {
  std::error_code ignored;
  if (name == nameIn(file)) return;
  if (name.isEmpty())
    fs::remove(file, ignored);
  else
    writeFile(file, name.toStdString() + "\n", true);
}

/// Existing files stay as they are except for their names: a network does not change.
void saveKept(const fs::path& folder, const NetworkResults& results) {
  std::error_code ignored;
  if (!results.kept.empty()) fs::create_directories(folder, ignored); // else the first file cannot be written
  for (const auto& fit : results.kept) {
    const std::string stem = stemOf(fit->made);
    if (!fs::exists(folder / (stem + kSettings)))
      writeFile(folder / (stem + kSettings), networkText(fit->settings).toStdString(), true);
    if (!fs::exists(folder / (stem + kDecoder))) writeNetwork(fit->decoder, folder / (stem + kDecoder));
    saveName(folder / (stem + kName), fit->name);
  }
}

/// Only what the user removed; any other file may be the only copy.
void deleteRemoved(const fs::path& folder, const NetworkResults& results) {
  std::error_code ignored;
  for (const QDateTime& made : results.removed) {
    const auto is = [&](const auto& fit) { return fit->made == made; };
    if (std::any_of(results.kept.begin(), results.kept.end(), is)) continue; // opened again
    for (const char* end : {kSettings, kDecoder, kName}) fs::remove(folder / (stemOf(made) + end), ignored);
  }
}

void openNetwork(const fs::path& file, OpenedResults& opened) {
  if (!fs::exists(file)) return;
  try {
    auto fit = std::make_shared<NetworkFit>(*triedOn(readNetwork(file), *opened.results.samples));
    fit->triedOn = opened.results.samples;
    opened.results.fit = std::move(fit);
    opened.opened.insert(file);
  } catch (const Error& error) {
    opened.problems.emplace_back(error.what());
  }
}

void openOneKept(const fs::path& folder, const std::string& stem, OpenedResults& opened, const std::stop_token& stop) {
  NetworkResults& results = opened.results;
  Decoder decoder = readNetwork(folder / (stem + kDecoder));
  if (decoder.designFingerprint != results.samples->training.origin.designFingerprint) {
    ++opened.ofOtherDesigns;
    return;
  }
  auto fit = std::make_shared<NetworkFit>(ofDecoder(std::move(decoder), *results.samples));
  fit->made = madeOf(stem);
  fit->name = nameIn(folder / (stem + kName));
  try {
    QFile settings(QString::fromStdString((folder / (stem + kSettings)).string()));
    if (settings.open(QIODevice::ReadOnly)) fit->settings = parseNetwork(settings.readAll(), settings.fileName());
  } catch (const Error& error) { // the network's file has most of them
    opened.problems.emplace_back(error.what());
  }
  tryOn(*fit, *results.samples, stop);
  fit->triedOn = results.samples;
  const bool shown = results.fit && results.fit->decoder.trainedWith == fit->decoder.trainedWith &&
                     results.fit->decoder.report.seconds == fit->decoder.report.seconds;
  results.kept.push_back(fit);
  if (shown) results.fit = fit;
}

void openKept(const fs::path& folder, OpenedResults& opened, const std::stop_token& stop,
              const OpeningProgress& progress) {
  std::vector<std::string> stems;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    const std::string name = entry.path().filename().string();
    const std::string stem = name.substr(0, name.find('.'));
    if (name == stem + kDecoder && madeOf(stem).isValid()) stems.push_back(stem); // others are somebody else's
  }
  std::sort(stems.rbegin(), stems.rend()); // the newest first
  std::size_t unnamed = 0;
  for (std::size_t k = 0; k < stems.size(); ++k) {
    const std::string& stem = stems[k];
    throwIfStopped(stop);
    progress(static_cast<double>(k) / static_cast<double>(stems.size()),
             "Network " + std::to_string(k + 1) + " of " + std::to_string(stems.size()));
    // Those that left the list because it was full stay away.
    if (nameIn(folder / (stem + kName)).isEmpty() && unnamed == NetworkSession::kKeptNetworks) continue;
    try {
      openOneKept(folder, stem, opened, stop);
      if (!opened.results.kept.empty() && opened.results.kept.back()->made == madeOf(stem) &&
          opened.results.kept.back()->name.isEmpty())
        ++unnamed;
    } catch (const Error& error) {
      opened.problems.emplace_back(error.what());
    }
  }
}

/// Less the sweep and the comparison where they cannot be opened.
void openSweeps(const fs::path& file, OpenedResults& opened) {
  if (opened.results.samples->split && !opened.problems.empty()) return; // of test samples that could not be opened
  if (!fs::exists(file)) return;
  try {
    parseSweeps(QByteArray::fromStdString(readFile(file)), QString::fromStdString(file.string()), opened.results);
    opened.opened.insert(file);
  } catch (const Error& error) {
    opened.problems.emplace_back(error.what());
  }
}

/// Samples alone where those for testing cannot be opened.
void openSamples(const fs::path& folder, const SensorDesign& design, OpenedResults& opened,
                 const std::stop_token& stop) {
  const fs::path file = folder / kSamples, test = folder / kTestSamples;
  try {
    opened.results.samples = std::make_shared<const NetworkSamples>(openSampleFiles({file}, design, stop));
    opened.opened.insert({file, test});
  } catch (const Error& error) {
    opened.problems.emplace_back(error.what());
  }
  if (opened.results.samples || !fs::exists(test)) return;
  try {
    opened.results.samples = std::make_shared<const NetworkSamples>(openTheseSampleFiles({file}, design, stop));
    opened.problems.back() += "; " + heldOutWords(opened.results.samples->training).toStdString() + " of " +
                              file.filename().string() +
                              " is used for testing, although the earlier networks were trained with it";
  } catch (const Error&) { // reported already: it is read first
  }
}

} // namespace

std::set<fs::path> resultFiles(const fs::path& folder) {
  return {folder / kSamples, folder / kTestSamples, folder / kNetwork, folder / kSweeps};
}

std::vector<std::string> saveResults(const fs::path& folder, const NetworkResults& results,
                                     const std::set<fs::path>& ours) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) throw Error(folder.string() + ": cannot be created: " + failed.message());
  FilesTogether writing;
  if (results.samples) addSamples(writing, folder / kSamples, *results.samples);
  if (results.fit)
    writing.add(folder / kNetwork, [&](const fs::path& beside) { writeNetwork(results.fit->decoder, beside); });
  const bool sweeps = results.samples && !(results.sweep.empty() && results.trials.empty());
  if (sweeps) writing.add(folder / kSweeps, sweepsText(results).toStdString());
  saveKept(folder / kKept, results);
  std::vector<std::string> said;
  const std::string now = stemOf(QDateTime::currentDateTime());
  for (const auto& [name, kept] :
       {std::pair{kSamples, "samples-" + now + ".csv"}, std::pair{kTestSamples, "samples-" + now + "-test.csv"},
        std::pair{kNetwork, "network-" + now + ".json"}, std::pair{kSweeps, "sweeps-" + now + ".json"}}) {
    const fs::path file = folder / name;
    const bool written = name == kNetwork || name == kSweeps || results.samples;
    if (written && !ours.contains(file) && writing.keepAs(file, folder / kept))
      said.push_back(file.string() + " contained something that is not open here; it is kept as " + kept);
  }
  writing.commit();
  if (!results.fit) fs::remove(folder / kNetwork, failed);
  if (!sweeps) fs::remove(folder / kSweeps, failed);
  deleteRemoved(folder / kKept, results);
  return said;
}

OpenedResults openResults(const fs::path& folder, const SensorDesign& design, const std::stop_token& stop,
                          const OpeningProgress& progress) {
  OpenedResults opened;
  opened.results.design = design;
  if (!fs::exists(folder / kSamples)) return opened;
  openSamples(folder, design, opened, stop);
  if (!opened.results.samples) return opened;
  openNetwork(folder / kNetwork, opened);
  openSweeps(folder / kSweeps, opened);
  openKept(folder / kKept, opened, stop, progress);
  return opened;
}

} // namespace palp
