#pragma once

#include "app/study/StageLog.h"
#include "app/study/decoding/Prediction.h"
#include "app/study/paper/PublishedNumbers.h"
#include "app/study/reports/Report.h"
#include "model/SampleSet.h"
#include "model/SensorDesign.h"
#include "solver/SensorMesh.h"

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// The paper's experiment: 100 training forces on each area, 100 other forces on each for testing.
struct ProtocolOptions {
  int perArea = 100;
  int seeds = 1; ///< repetitions with other forces; tables give the median
  std::uint64_t firstSeed = 1;
  MeshOptions mesh;
  int threads = 0;
};

/// Training and test samples of one repetition.
struct ProtocolSamples {
  SampleSet training;
  SampleSet test;
};

/// Test errors of one fit; 3 forces x areas.
struct ProtocolErrors {
  Eigen::Matrix3Xd eq13_percent;
  Eigen::Matrix3Xd eq13Floored_percent; ///< with |F| >= 0.05 N in the denominator
  Eigen::Matrix3Xd meanAbsolute_N;
  Eigen::Matrix3Xd rmse_percentOfRange;
};

/// One spread of one curve; over the repetitions.
struct ProtocolRow {
  std::optional<double> spread;                     ///< none: linear least squares
  std::optional<Eigen::Vector3d> published_percent; ///< what the paper prints there
  std::vector<ProtocolErrors> errors;               ///< one a repetition
  std::vector<double> condition;
  std::vector<std::string> warnings; ///< of the first repetition's fit

  /// Median over the repetitions of the mean (the worst) over the areas, and of the root mean square over all areas.
  [[nodiscard]] Eigen::Vector3d eq13Mean_percent() const;
  [[nodiscard]] Eigen::Vector3d eq13Worst_percent() const;
  [[nodiscard]] Eigen::Vector3d eq13FlooredMean_percent() const;
  [[nodiscard]] Eigen::Vector3d meanAbsolute_N() const;
  [[nodiscard]] Eigen::Vector3d rmse_percentOfRange() const;
};

/// One way to train, at all its spreads.
struct ProtocolCurve {
  std::string figure; ///< table1 or fig12
  std::string mode;   ///< default, paper, linear, paper-minmax (Fig. 12 with each input scaled alone)
  std::string what;   ///< as text: scaler, centres, basis, solver
  std::vector<ProtocolRow> rows;
};

/// Decoupled against true forces of one area at one spread, for Figs. 8-11 and 13-16.
struct ProtocolTrace {
  std::string figure;
  std::string mode;
  double spread = 0;
  int area = 0;
  Eigen::Matrix3Xd true_N, decoupled_N;
};

struct ProtocolResult {
  std::vector<ProtocolCurve> curves;
  std::vector<ProtocolTrace> traces;
  std::string mesh;      ///< as text
  double batchError = 0; ///< relative, of the samples against full Newton
  std::size_t samples = 0;
  std::size_t solves = 0;
  StageLog stages;
};

/// The parts of its run; training and testing the networks of its figures takes so long [s].
std::vector<RunPart> protocolParts(double networks_s);

/// Seed of the test samples that go with a training seed: never among the training seeds.
std::uint64_t testSeed(std::uint64_t trainingSeed);

/// Runs the experiment for the figures (table1, fig12). `progress` gets a share 0..1 and what is being done. Empty
/// where it was stopped, within a training too.
std::optional<ProtocolResult> runPaperProtocol(const SensorDesign& design, const std::vector<std::string>& figures,
                                               const ProtocolOptions& options,
                                               const std::function<void(double, const std::string&)>& progress = {},
                                               const std::stop_token& stop = {});

} // namespace palp
