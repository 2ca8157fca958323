#include "app/study/reports/networks/NetworkCheck.h"

#include "app/study/decoding/DecoderTraining.h"
#include "app/study/paper/PaperProtocol.h"
#include "app/study/touch/SampleGenerator.h"
#include "model/base/Error.h"
#include "nn/NoisyCopies.h"

#include <chrono>

namespace palp {

namespace {

constexpr int kNoiseDraws = 5;

/// Root mean square error in % of the design's force range.
Eigen::Vector3d percentOfRange(const SensorDesign& design, const Eigen::MatrixXd& forces_N,
                               const Eigen::MatrixXd& truth_N) {
  const Eigen::Vector3d range_N = design.forceRange.high_N - design.forceRange.low_N;
  const Eigen::Vector3d rms_N = (forces_N - truth_N).cwiseAbs2().rowwise().mean().cwiseSqrt();
  return 100 * rms_N.cwiseQuotient(range_N);
}

} // namespace

std::optional<TwoSets> twoSets(const SensorDesign& design, const ReportRequest& request, StageLog& stages,
                               const ReportProgress& progress, const std::stop_token& stop) {
  TwoSets sets;
  for (const bool training : {true, false}) {
    SampleRequest wanted;
    wanted.perArea = request.perArea;
    wanted.seed = training ? request.seed : testSeed(request.seed);
    wanted.mesh = request.mesh;
    wanted.threads = request.threads;
    SampleGenerator generator(design, wanted);
    const auto total = static_cast<double>(generator.total());
    SampleSet& set = training ? sets.training : sets.test;
    const std::size_t made = generator.generate(
        {0, generator.total()}, [&](const SampleSet& block) { append(set, block); },
        [&](std::size_t done) {
          if (progress) progress((static_cast<double>(done) / total + (training ? 0 : 1)) / 2, "samples");
        },
        stop);
    stages.add(generator.stages());
    if (made < generator.total()) return {};
    sets.measuredError = std::max(sets.measuredError, generator.measuredError());
  }
  return sets;
}

NoisyError noisyError(const SensorDesign& design, const TwoSets& sets, const TrainOptions& options, double testNoise,
                      std::uint64_t seed, StageLog& stages, const std::stop_token& stop) {
  NoisyError result;
  const auto start = std::chrono::steady_clock::now();
  try {
    const Decoder decoder =
        stages.measure("train", [&] { return trainDecoder(sets.training, &design, options, stop); });
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const Eigen::MatrixXd clean = inputsOf(sets.test, decoder.input);
    const int draws = testNoise > 0 ? kNoiseDraws : 1;
    // Another seed than the training's noise: a network must not meet in the test what it was fitted to.
    const Eigen::MatrixXd noisy = noisyCopies(clean, testNoise, draws, testSeed(seed));
    Eigen::MatrixXd truth_N(3, noisy.cols());
    for (Eigen::Index i = 0; i < noisy.cols(); ++i) truth_N.col(i) = sets.test.forces_N.col(i / draws);
    PredictOptions bare;
    bare.standardDeviation = false;
    bare.area = false;
    const Prediction prediction = stages.measure("predict", [&] { return predict(decoder, noisy, bare); });
    result.microsecondsPerSample = prediction.microsecondsPerSample;
    result.rmse_percentOfRange = percentOfRange(design, prediction.forces_N, truth_N);
  } catch (const Error& refused) {
    result.failed = refused.what();
  }
  return result;
}

NoisyError noisyErrorAreaKnown(const SensorDesign& design, const TwoSets& sets, const TrainOptions& options,
                               double testNoise, std::uint64_t seed, StageLog& stages, const std::stop_token& stop) {
  NoisyError result;
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  const int areas = design.areas.count();
  for (int area = 0; area < areas; ++area) {
    TwoSets one{areaPart(sets.training, area), areaPart(sets.test, area), sets.measuredError};
    const NoisyError error = noisyError(design, one, options, testNoise, seed, stages, stop);
    if (!error.failed.empty()) return error;
    squares += error.rmse_percentOfRange.cwiseAbs2() / areas;
    result.seconds += error.seconds;
  }
  result.rmse_percentOfRange = squares.cwiseSqrt();
  return result;
}

} // namespace palp
