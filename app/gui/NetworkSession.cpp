#include "app/gui/NetworkSession.h"

#include "app/study/PaperProtocol.h"
#include "app/study/SampleGenerator.h"
#include "model/Error.h"
#include "nn/SpreadSweep.h"

#include <QElapsedTimer>

#include <cmath>

namespace palp {

namespace {

/// Appends a block of samples to a set that is as wide as its request.
class Collector {
public:
  Collector(SampleSet empty, std::size_t total) : set_(std::move(empty)) {
    const auto columns = static_cast<Eigen::Index>(total);
    set_.area.resize(columns);
    set_.forces_N.resize(3, columns);
    set_.displacements_mm.resize(3 * set_.rowWires * set_.electrodesPerRowWire, columns);
    set_.resistances_ohm.resize(set_.rowWires * set_.columnWires, columns);
  }
  void take(const SampleSet& block) {
    set_.area.segment(at_, block.size()) = block.area;
    set_.forces_N.middleCols(at_, block.size()) = block.forces_N;
    set_.displacements_mm.middleCols(at_, block.size()) = block.displacements_mm;
    set_.resistances_ohm.middleCols(at_, block.size()) = block.resistances_ohm;
    at_ += block.size();
  }
  [[nodiscard]] SampleSet done() { return std::move(set_); }

private:
  SampleSet set_;
  Eigen::Index at_ = 0;
};

std::string timeLeft(double share, double elapsed_s) {
  if (share < 0.02) return "";
  const auto left_s = static_cast<long>(std::ceil(elapsed_s * (1 - share) / share));
  return ", about " + std::to_string(left_s) + " s left";
}

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

NetworkSession::NetworkSession(QObject* parent) : QObject(parent) {
  connect(&runner_, &JobRunner::progressed, this, &NetworkSession::drainSweep);
}

void NetworkSession::setDesign(const SensorDesign& design) {
  if (design == design_) return;
  design_ = design;
  runner_.cancel();
  if (!samples_) return;
  samples_.reset();
  fit_.reset();
  sweep_.clear();
  emit samplesChanged();
  emit fitChanged();
  emit sweepChanged();
}

void NetworkSession::generate(const SampleSettings& settings, const MeshOptions& mesh) {
  const auto work = [this, settings, mesh, design = design_](const std::stop_token& stop,
                                                             JobProgress& progress) -> JobRunner::Taking {
    QElapsedTimer clock;
    clock.start();
    auto samples = std::make_shared<NetworkSamples>();
    StageLog stages;
    std::size_t before = 0;
    progress.set(-1, "Meshing and preparing the solver");
    for (const bool test : {false, true}) {
      SampleRequest request;
      request.perArea = settings.perArea;
      request.seed = test ? testSeed(settings.seed) : settings.seed;
      request.mesh = mesh;
      SampleGenerator generator(design, request);
      const std::size_t total = generator.total();
      Collector collector(generator.emptySet(), total);
      const std::size_t made = generator.generate(
          {0, total}, [&](const SampleSet& block) { collector.take(block); },
          [&](std::size_t done) {
            const double share = static_cast<double>(before + done) / static_cast<double>(2 * total);
            progress.set(share, "Sample " + std::to_string(before + done) + " of " + std::to_string(2 * total) +
                                    timeLeft(share, 1e-3 * static_cast<double>(clock.elapsed())));
          },
          stop);
      if (made < total) return {};
      before = total;
      (test ? samples->test : samples->training) = collector.done();
      samples->batchError = std::max(samples->batchError, generator.measuredError());
      stages.add(generator.stages());
    }
    return [this, samples, stages, design] {
      if (!(design == design_)) return;
      samples_ = samples;
      stages_.add(stages);
      fit_.reset();
      sweep_.clear();
      emit samplesChanged();
      emit fitChanged();
      emit sweepChanged();
    };
  };
  runner_.start(tr("Generating samples"), work);
}

void NetworkSession::train(const NetworkSettings& settings) {
  if (!samples_) return;
  const auto work = [this, settings, design = design_, samples = samples_](const std::stop_token& stop,
                                                                           JobProgress& progress) -> JobRunner::Taking {
    StageLog stages;
    const auto fit = stages.measure("train", [&] {
      return std::make_shared<const NetworkFit>(
          fitOn(*samples, design, settings, settings.trainOptions(), stop, progress));
    });
    return [this, fit, samples, stages] {
      if (samples != samples_) return;
      fit_ = fit;
      stages_.add(stages);
      emit fitChanged();
    };
  };
  runner_.start(tr("Training"), work);
}

void NetworkSession::sweep(const NetworkSettings& settings) {
  if (!samples_) return;
  sweep_.clear();
  sweepSettings_ = settings;
  rows_ = std::make_shared<Rows>();
  emit sweepChanged();
  const auto work = [this, settings, design = design_, samples = samples_,
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
    return [this] { drainSweep(); };
  };
  runner_.start(tr("Sweeping the spread"), work);
}

void NetworkSession::drainSweep() {
  if (!rows_) return;
  std::vector<SweepPoint> fresh;
  {
    const std::lock_guard lock(rows_->mutex);
    fresh.swap(rows_->points);
  }
  if (fresh.empty()) return;
  sweep_.insert(sweep_.end(), fresh.begin(), fresh.end());
  emit sweepChanged();
}

void NetworkSession::use(Decoder decoder) {
  if (!samples_) throw Error("the network cannot be tried: there are no samples yet; generate samples first");
  NetworkFit fit;
  fit.decoder = std::move(decoder);
  fit.settings.input = fit.decoder.input.kind;
  fit.settings.mode = fit.decoder.mode;
  fit.settings.decoder = fit.decoder.kind;
  fit.settings.spread = fit.decoder.report.spread;
  fit.prediction = predict(fit.decoder, samples_->test);
  fit.error = decoderError(fit.decoder, fit.prediction, samples_->test);
  fit_ = std::make_shared<const NetworkFit>(std::move(fit));
  emit fitChanged();
}

} // namespace palp
