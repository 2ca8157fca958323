#pragma once

#include "app/study/decoding/NoiseBound.h"
#include "app/study/decoding/Prediction.h"
#include "app/study/reports/Report.h"
#include "model/SampleSet.h"

#include <optional>

namespace palp {

/// Training samples, and test samples of other forces.
struct TwoSets {
  SampleSet training;
  SampleSet test;
  double measuredError = 0; ///< relative, of the samples against full Newton
};

/// Nonlinear samples of a design, `request.perArea` on each area, of the request's seed and of its test seed. Empty
/// where it was stopped.
std::optional<TwoSets> twoSets(const SensorDesign& design, const ReportRequest& request, StageLog& stages,
                               const ReportProgress& progress, const std::stop_token& stop);

/// How a decoder does on noisy resistances.
struct NoisyError {
  Eigen::Vector3d rmse_percentOfRange; ///< over all test samples and areas
  double seconds = 0;                  ///< of training
  double microsecondsPerSample = 0;    ///< of predicting
  std::string failed;                  ///< why there is no error; empty where there is one
};

/// Trains with `options` and tests on the test samples' resistances with relative noise, several draws a sample.
NoisyError noisyError(const SensorDesign& design, const TwoSets& sets, const TrainOptions& options, double testNoise,
                      std::uint64_t seed, StageLog& stages, const std::stop_token& stop);

/// The same with a decoder for each area, trained and tested on its samples alone: the area is known, as the Cramer-Rao
/// bound takes it to be.
NoisyError noisyErrorAreaKnown(const SensorDesign& design, const TwoSets& sets, const TrainOptions& options,
                               double testNoise, std::uint64_t seed, StageLog& stages, const std::stop_token& stop);

} // namespace palp
