#include "app/gui/jobs/NetworkSession.h"

#include "app/gui/jobs/ResultFiles.h"
#include "app/study/decoding/DecoderTraining.h"
#include "app/study/paper/PaperProtocol.h"
#include "app/study/touch/SampleGenerator.h"
#include "io/DecoderFile.h"
#include "model/base/Error.h"
#include "nn/SpreadSweep.h"

#include <QElapsedTimer>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr std::size_t kPastDesigns = 4; ///< whose results are kept: an edit and some undoing

/// An empty set made wide enough for all that is asked.
SampleSet allocated(SampleSet set, std::size_t total) {
  const auto columns = static_cast<Eigen::Index>(total);
  set.area.resize(columns);
  set.forces_N.resize(3, columns);
  set.displacements_mm.resize(3 * set.rowWires * set.electrodesPerRowWire, columns);
  set.resistances_ohm.resize(set.rowWires * set.columnWires, columns);
  return set;
}

void put(SampleSet& set, const SampleSet& block, std::size_t at) {
  const auto first = static_cast<Eigen::Index>(at);
  set.area.segment(first, block.size()) = block.area;
  set.forces_N.middleCols(first, block.size()) = block.forces_N;
  set.displacements_mm.middleCols(first, block.size()) = block.displacements_mm;
  set.resistances_ohm.middleCols(first, block.size()) = block.resistances_ohm;
}

std::string timeLeft(double share, double elapsed_s) {
  if (share < 0.02) return "";
  const auto left_s = static_cast<long>(std::ceil(elapsed_s * (1 - share) / share));
  return ", about " + std::to_string(left_s) + " s left";
}

/// Time since a generation went on, and where it stood then.
struct GenerationClock {
  std::size_t before = 0; ///< samples that were there already
  QElapsedTimer elapsed;

  void report(std::size_t done, std::size_t all, JobProgress& progress) const {
    const double fresh = static_cast<double>(done - before) / static_cast<double>(all - before);
    progress.set(static_cast<double>(done) / static_cast<double>(all),
                 "Sample " + std::to_string(done) + " of " + std::to_string(all) +
                     timeLeft(fresh, 1e-3 * static_cast<double>(elapsed.elapsed())));
  }
};

NetworkFit fitOn(const NetworkSamples& samples, const SensorDesign& design, const NetworkSettings& settings,
                 const TrainOptions& options, const std::stop_token& stop, JobProgress& progress) {
  NetworkFit fit;
  fit.settings = settings;
  fit.decoder = trainDecoder(samples.training, &design, options, stop,
                             [&](double share, const std::string& what) { progress.set(share, what); });
  PredictOptions plain;
  plain.standardDeviation = false;
  plain.area = false;
  fit.prediction = predict(fit.decoder, inputsOf(samples.test, fit.decoder.input), plain);
  fit.error = decoderError(fit.decoder, fit.prediction, samples.test);
  return fit;
}

} // namespace

/// Training samples first, then those for testing; sample i depends on the request and i alone, so that what was
/// stopped goes on to the same bytes.
struct NetworkSession::Generation {
  SampleSettings settings;
  MeshOptions mesh;
  SensorDesign design;
  std::array<SampleSet, 2> sets;
  std::array<std::size_t, 2> made{};
  std::array<std::size_t, 2> total{};
  double batchError = 0;

  /// Makes what is missing of the training samples (0) or those for testing (1); false where it was stopped.
  bool makeSet(std::size_t set, const GenerationClock& clock, StageLog& stages, const std::stop_token& stop,
               JobProgress& progress);
  /// Hands all of them over.
  std::shared_ptr<const NetworkSamples> samples();
};

bool NetworkSession::Generation::makeSet(std::size_t set, const GenerationClock& clock, StageLog& stages,
                                         const std::stop_token& stop, JobProgress& progress) {
  SampleRequest request;
  request.perArea = settings.perArea;
  request.seed = set == 1 ? testSeed(settings.seed) : settings.seed;
  request.mesh = mesh;
  SampleGenerator generator(design, request);
  total[set] = generator.total();
  const std::size_t kept = made[set];
  if (kept == total[set] && kept > 0) return true;
  if (kept == 0) sets[set] = allocated(generator.emptySet(stop), total[set]);
  if (stop.stop_requested()) return false;
  const std::size_t others = set == 1 ? total[0] : 0;
  generator.generate(
      {kept, total[set]},
      [&](const SampleSet& block) {
        put(sets[set], block, made[set]);
        made[set] += static_cast<std::size_t>(block.size());
      },
      [&](std::size_t done) { clock.report(others + kept + done, 2 * total[set], progress); }, stop);
  batchError = std::max(batchError, generator.measuredError());
  stages.add(generator.stages());
  return made[set] == total[set];
}

std::shared_ptr<const NetworkSamples> NetworkSession::Generation::samples() {
  auto all = std::make_shared<NetworkSamples>();
  all->training = std::move(sets[0]);
  all->test = std::move(sets[1]);
  all->batchError = batchError;
  all->settings = settings;
  return all;
}

NetworkSession::NetworkSession(QObject* parent) : QObject(parent) {
  connect(&runner_, &JobRunner::progressed, this, &NetworkSession::drain);
  connect(&runner_, &JobRunner::finished, this, [this](bool cancelled) {
    if (cancelled) emit samplesChanged();
  });
}

NetworkSession::~NetworkSession() = default;

std::array<std::size_t, 2> NetworkSession::stoppedAt() const {
  if (!generation_ || runner_.running() || generation_->made[0] == 0) return {0, 0};
  return {generation_->made[0] + generation_->made[1], 2 * generation_->total[0]};
}

void NetworkSession::show(NetworkResults results) {
  if (shown_.samples) past_.push_front(std::move(shown_));
  std::erase_if(past_, [&](const NetworkResults& past) { return past.design == results.design; });
  while (past_.size() > kPastDesigns) past_.pop_back();
  shown_ = std::move(results);
  emit samplesChanged();
  emit fitChanged();
  emit sweepChanged();
  emit trialsChanged();
}

void NetworkSession::setDesign(const SensorDesign& design) {
  if (design == design_) return;
  design_ = design;
  generation_.reset();
  runner_.cancel();
  const auto past = std::find_if(past_.begin(), past_.end(), [&](const auto& one) { return one.design == design; });
  if (past != past_.end())
    show(NetworkResults(*past));
  else
    emit samplesChanged(); // they are of another design now, or of this one again
}

void NetworkSession::clear() {
  runner_.cancel();
  generation_.reset();
  past_.clear();
  shown_ = {};
  show({});
}

void NetworkSession::generate(const SampleSettings& settings, const MeshOptions& mesh) {
  if (!generation_ || !(generation_->settings == settings && generation_->mesh == mesh))
    generation_ = std::make_shared<Generation>(Generation{settings, mesh, design_, {}, {}, {}, 0});
  const auto work = [this, generation = generation_](const std::stop_token& stop,
                                                     JobProgress& progress) -> JobRunner::Taking {
    progress.set(-1, "Meshing and preparing the solver");
    GenerationClock clock{generation->made[0] + generation->made[1], {}};
    clock.elapsed.start();
    StageLog stages;
    for (const std::size_t set : {0, 1})
      if (!generation->makeSet(set, clock, stages, stop, progress)) return {};
    return [this, generation, stages] {
      NetworkResults results;
      results.design = generation->design;
      results.samples = generation->samples();
      if (generation_ == generation) generation_.reset();
      stages_.add(stages);
      show(std::move(results));
    };
  };
  runner_.start(tr("Generating samples"), work);
}

void NetworkSession::train(const NetworkSettings& settings) {
  if (!upToDate()) return;
  const auto work = [this, settings, design = design_, samples = shown_.samples](
                        const std::stop_token& stop, JobProgress& progress) -> JobRunner::Taking {
    StageLog stages;
    const auto fit = stages.measure("train", [&] {
      return std::make_shared<const NetworkFit>(
          fitOn(*samples, design, settings, settings.trainOptions(), stop, progress));
    });
    return [this, fit, samples, stages] {
      if (samples != shown_.samples) return;
      shown_.fit = fit;
      stages_.add(stages);
      emit fitChanged();
    };
  };
  runner_.start(tr("Training"), work);
}

void NetworkSession::sweep(const NetworkSettings& settings) {
  if (!upToDate()) return;
  shown_.sweep.clear();
  shown_.sweepSettings = settings;
  rows_ = std::make_shared<Rows>();
  emit sweepChanged();
  const auto work = [this, settings, design = design_, samples = shown_.samples,
                     rows = rows_](const std::stop_token& stop, JobProgress& progress) -> JobRunner::Taking {
    std::vector<double> spreads = logarithmicRange(settings.sweepFrom, settings.sweepTo, settings.sweepCount);
    for (std::size_t k = 0; k < spreads.size() && !stop.stop_requested(); ++k) {
      progress.set(static_cast<double>(k) / static_cast<double>(spreads.size()),
                   "Spread " + std::to_string(k + 1) + " of " + std::to_string(spreads.size()));
      TrainOptions options = settings.trainOptions();
      options.spread = spreads[k];
      JobProgress unseen;
      const NetworkFit fit = fitOn(*samples, design, settings, options, stop, unseen);
      const std::lock_guard lock(rows->mutex);
      rows->points.push_back({spreads[k], fit.error.error, fit.decoder.report});
    }
    return [this] { drain(); };
  };
  runner_.start(tr("Sweeping the spread"), work);
}

void NetworkSession::compare(const NetworkSettings& settings) {
  if (!upToDate()) return;
  shown_.trials.clear();
  shown_.trialsInput = settings.input;
  rows_ = std::make_shared<Rows>();
  emit trialsChanged();
  const auto work = [this, settings, design = design_, samples = shown_.samples,
                     rows = rows_](const std::stop_token& stop, JobProgress& progress) -> JobRunner::Taking {
    const std::vector<DecoderKind> kinds = allDecoderKinds();
    for (std::size_t k = 0; k < kinds.size() && !stop.stop_requested(); ++k) {
      progress.set(static_cast<double>(k) / static_cast<double>(kinds.size()), "Training " + name(kinds[k]));
      TrainOptions options = settings.trainOptions();
      options.decoder = kinds[k];
      JobProgress unseen;
      DecoderTrial trial;
      trial.kind = kinds[k];
      try {
        const NetworkFit fit = fitOn(*samples, design, settings, options, stop, unseen);
        trial.error = fit.error.error;
        trial.seconds = fit.decoder.report.seconds;
        trial.microsecondsPerSample = fit.prediction.microsecondsPerSample;
      } catch (const std::exception& refusal) {
        trial.refusal = QString::fromStdString(refusal.what());
      }
      if (stop.stop_requested()) break;
      const std::lock_guard lock(rows->mutex);
      rows->trials.push_back(std::move(trial));
    }
    return [this] { drain(); };
  };
  runner_.start(tr("Comparing decoders"), work);
}

void NetworkSession::drain() {
  if (!rows_) return;
  std::vector<SweepPoint> points;
  std::vector<DecoderTrial> trials;
  {
    const std::lock_guard lock(rows_->mutex);
    points.swap(rows_->points);
    trials.swap(rows_->trials);
  }
  if (!points.empty()) {
    shown_.sweep.insert(shown_.sweep.end(), points.begin(), points.end());
    emit sweepChanged();
  }
  if (!trials.empty()) {
    shown_.trials.insert(shown_.trials.end(), trials.begin(), trials.end());
    emit trialsChanged();
  }
}

void NetworkSession::open(const std::filesystem::path& file) {
  if (!upToDate()) throw Error("the network cannot be tried: there are no samples yet; generate samples first");
  const auto work = [this, file, samples = shown_.samples](const std::stop_token&, JobProgress&) -> JobRunner::Taking {
    const auto fit = triedOn(readNetwork(file), *samples);
    return [this, fit, samples] {
      if (samples != shown_.samples) return;
      shown_.fit = fit;
      emit fitChanged();
    };
  };
  runner_.start(tr("Trying the network"), work);
}

void NetworkSession::openSamples(const std::vector<std::filesystem::path>& files) {
  const auto work = [this, files, design = design_](const std::stop_token& stop, JobProgress&) -> JobRunner::Taking {
    NetworkResults results;
    results.design = design;
    results.samples = std::make_shared<const NetworkSamples>(openSampleFiles(files, design, stop));
    return [this, results] {
      if (results.design == design_) show(results);
    };
  };
  runner_.start(tr("Opening samples"), work);
}

void NetworkSession::openResults(const std::filesystem::path& folder, const std::function<void()>& opened) {
  const auto work = [this, folder, opened, design = design_](const std::stop_token& stop,
                                                             JobProgress&) -> JobRunner::Taking {
    const NetworkResults results = palp::openResults(folder, design, stop);
    return [this, results, opened] {
      if (results.design != design_) return;
      if (results.samples) show(results);
      opened();
    };
  };
  runner_.start(tr("Opening samples"), work);
}

void NetworkSession::saveSamples(const std::filesystem::path& file) {
  writer_.start(tr("Saving samples"), [file, samples = shown_.samples](const auto&, JobProgress&) {
    saveSampleFiles(file, *samples);
    return JobRunner::Taking();
  });
}

void NetworkSession::saveResults(const std::filesystem::path& folder,
                                 const std::function<void(const NetworkResults&)>& saved) {
  writer_.start(tr("Saving samples and network"), [folder, saved, results = shown_](const auto&, JobProgress&) {
    palp::saveResults(folder, results);
    return [saved, results] { saved(results); };
  });
}

} // namespace palp
