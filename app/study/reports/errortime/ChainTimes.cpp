#include "app/study/reports/errortime/ChainTimes.h"

#include "app/study/paper/PaperProtocol.h"
#include "app/study/reports/MeshShare.h"
#include "app/study/reports/Timing.h"
#include "app/study/touch/SampleGenerator.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "model/base/Text.h"
#include "nn/LeaveOneOut.h"
#include "nn/SpreadSweep.h"

#include <cmath>

namespace palp {

namespace {

constexpr double kNoise = 1e-4;
constexpr int kReferencePerArea = 25;
constexpr int kRepeats = 3;
constexpr double kOnceAbove_s = 4;

double errorRootMeanSquare(const Eigen::Vector3d& values) {
  return values.norm() / std::sqrt(3.0);
}

struct Way {
  std::string what;
  TrainOptions options;
};

std::vector<Way> ways(const TrainOptions& base, Eigen::Index samples) {
  std::vector<Way> result;
  for (const DecoderKind kind : decodersWith(&DecoderTraits::ofAreas)) {
    TrainOptions options = base;
    options.decoder = kind;
    if (!traits(kind).needsResistances || base.input == InputKind::Resistance) result.push_back({name(kind), options});
  }
  for (const int centers : {50, 100, 200, 400}) {
    if (centers >= samples) break;
    TrainOptions options = base;
    options.centers = centers;
    options.centerChoice = CenterChoice::KMeans;
    result.push_back({"rbf, " + std::to_string(centers) + " centres", options});
  }
  if (base.noise > 0) return result;
  for (const LeastSquaresMethod method :
       {LeastSquaresMethod::Cholesky, LeastSquaresMethod::TruncatedSvd, LeastSquaresMethod::Recursive}) {
    TrainOptions options = base;
    options.solver = method;
    options.spread = 10;
    result.push_back({"rbf, " + name(method) + ", spread 10", options});
  }
  return result;
}

DecoderTimes measure(const SensorDesign& design, const TwoSets& sets, const Way& way, StageLog& stages,
                     const std::stop_token& stop) {
  DecoderTimes result;
  result.input = way.options.input == InputKind::Displacement ? "clean displacements" : "resistances, noise 1e-4";
  result.what = way.what;
  do {
    const NoisyError error = noisyError(design, sets, way.options, way.options.noise, 1, stages, stop);
    result.failed = error.failed;
    if (!error.failed.empty()) break;
    result.training.seconds.push_back(error.seconds);
    result.prediction.seconds.push_back(error.microsecondsPerSample);
    result.error_percentOfRange = errorRootMeanSquare(error.rmse_percentOfRange);
  } while (static_cast<int>(result.training.seconds.size()) < kRepeats && result.training.median() < kOnceAbove_s);
  return result;
}

/// Samples of one request with their seconds.
struct Made {
  SampleSet set;
  double prepare_s = 0, sample_s = 0, measuredError = 0;
};

std::optional<Made> make(const SensorDesign& design, const SampleRequest& request, StageLog& stages,
                         const std::stop_token& stop) {
  Made made;
  SampleGenerator generator(design, request);
  made.prepare_s = secondsOf([&] { (void)generator.origin(); });
  std::size_t count = 0;
  made.sample_s = secondsOf([&] {
    count = generator.generate(
        {0, generator.total()}, [&](const SampleSet& block) { append(made.set, block); }, {}, stop);
  });
  stages.add(generator.stages());
  made.measuredError = generator.measuredError();
  if (count < generator.total()) return {};
  return made;
}

SampleRequest sampleRequest(const ReportRequest& request) {
  SampleRequest wanted;
  wanted.perArea = request.perArea;
  wanted.seed = request.seed;
  wanted.mesh = request.mesh;
  wanted.threads = request.threads;
  return wanted;
}

/// A mesh that samples are made on.
struct MeshChoice {
  std::string name;
  MeshOptions mesh;
};

std::vector<MeshChoice> meshChoices(const SensorDesign& design, const MeshOptions& requested) {
  std::vector<MeshChoice> choices(4);
  choices[0].name = "--mapped 10x10x5";
  choices[0].mesh.mapped = {10, 10, 5};
  choices[1].name = "--mapped 20x20x10";
  choices[1].mesh.mapped = {20, 20, 10};
  choices[2].mesh.meshSize_mm = 12 * meshShare(design);
  choices[2].name = "--mesh-size " + text(*choices[2].mesh.meshSize_mm);
  choices[3].name = "default";
  choices[3].mesh = requested;
  if (requested.mapped) choices.erase(choices.begin() + 1, choices.begin() + 3); // a quick look
  return choices;
}

} // namespace

std::vector<DecoderTimes> decoderTimes(const ReportRequest& request, const TwoSets& sets, StageLog& stages,
                                       const ReportProgress& progress, const std::stop_token& stop) {
  std::vector<DecoderTimes> result;
  for (const InputKind input : {InputKind::Displacement, InputKind::Resistance}) {
    TrainOptions base;
    base.input = input;
    base.rows = input == InputKind::Resistance ? "all" : std::to_string(centreRowWire(request.design.rowWires()));
    base.noise = input == InputKind::Resistance ? kNoise : 0;
    base.seed = request.seed;
    base.threads = request.threads;
    const std::vector<Way> all = ways(base, sets.training.size());
    const double begun = input == InputKind::Displacement ? 0 : 0.5;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Way& way = all[k];
      if (stop.stop_requested()) return result;
      if (progress)
        progress(begun + 0.5 * static_cast<double>(k) / static_cast<double>(all.size()), "decoder " + way.what);
      result.push_back(measure(request.design, sets, way, stages, stop));
    }
  }
  return result;
}

Timing leaveOneOutTimes(const ReportRequest& request, const TwoSets& sets, const std::stop_token& stop) {
  DecoderInput centre;
  centre.rows = {centreRowWire(request.design.rowWires())};
  centre.rowWires = request.design.rowWires();
  centre.valuesPerRow = 3 * sets.training.electrodesPerRowWire;
  const Eigen::MatrixXd inputs = inputsOf(sets.training, centre);
  const std::vector<double> spreads = logarithmicRange(0.3, 30, kLeaveOneOutSpreads); // as palp sweep
  return timed(kRepeats, [&] {
    try {
      (void)leaveOneOut(inputs, sets.training.forces_N, spreads, {}, stop);
    } catch (const Cancelled&) { // the report ends
    }
  });
}

std::vector<ChainTimes> chainTimes(const ReportRequest& request, StageLog& stages, const ReportProgress& progress,
                                   const std::stop_token& stop) {
  std::vector<ChainTimes> result;
  if (progress) progress(0, "chain, samples of the reference mesh");
  SampleRequest fine = sampleRequest(request);
  fine.perArea = std::min(request.perArea, kReferencePerArea);
  fine.seed = testSeed(request.seed);
  if (!request.mesh.mapped) fine.mesh.meshSize_mm = kReferenceSize_mm * meshShare(request.design);
  const auto reference = make(request.design, fine, stages, stop);
  if (!reference) return result;
  const std::vector<MeshChoice> choices = meshChoices(request.design, request.mesh);
  const auto steps = static_cast<double>(2 * choices.size() + 1); // the reference is one as well
  for (const MeshChoice& choice : choices)
    for (const int divisor : {4, 1}) {
      if (stop.stop_requested()) return result;
      ReportRequest changed = request;
      changed.mesh = choice.mesh;
      changed.perArea = std::max(5, request.perArea / divisor);
      if (progress)
        progress(static_cast<double>(result.size() + 1) / steps,
                 "chain, " + choice.name + ", " + std::to_string(changed.perArea) + " an area");
      std::optional<Made> made;
      try {
        made = make(request.design, sampleRequest(changed), stages, stop);
      } catch (const Error& refused) { // of this mesh; the others go on
        result.push_back({choice.name, changed.perArea, 0, 0, 0, 0, refused.what()});
        continue;
      }
      if (!made) return result;
      ChainTimes chain{choice.name, changed.perArea, made->prepare_s, made->sample_s, 0, 0, {}};
      TrainOptions options;
      options.input = InputKind::Resistance;
      options.rows = "all";
      options.noise = kNoise;
      options.threads = request.threads;
      const TwoSets sets{std::move(made->set), reference->set, 0};
      const NoisyError error = noisyError(request.design, sets, options, kNoise, request.seed, stages, stop);
      chain.failed = error.failed;
      chain.train_s = error.seconds;
      if (error.failed.empty()) chain.error_percentOfRange = errorRootMeanSquare(error.rmse_percentOfRange);
      result.push_back(std::move(chain));
    }
  return result;
}

std::vector<SampleTimes> sampleTimes(const ReportRequest& request, StageLog& stages, const ReportProgress& progress,
                                     const std::stop_token& stop) {
  std::vector<SampleTimes> result;
  for (const bool surrogate : {false, true})
    for (const int factor : {1, 16}) {
      if (stop.stop_requested()) return result;
      if (!surrogate && factor > 1) continue; // minutes
      SampleRequest wanted = sampleRequest(request);
      wanted.perArea *= factor;
      wanted.surrogate = surrogate;
      if (progress) progress(static_cast<double>(result.size()) / 3, surrogate ? "surrogate samples" : "full samples");
      const auto made = make(request.design, wanted, stages, stop);
      if (!made) return result;
      result.push_back({surrogate ? "surrogate" : "full solves", static_cast<int>(made->set.size()),
                        made->prepare_s + made->sample_s, made->measuredError});
    }
  return result;
}

} // namespace palp
