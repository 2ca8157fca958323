#pragma once

#include "nn/RbfNetwork.h"
#include "nn/measured/InputStage.h"
#include "nn/measured/RowDependence.h"

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

namespace palp {

/// Standard deviation of a predicted target, sqrt(a^2 + (b |F|)^2): |F|^2 is the sum over the targets of (F_j /
/// range_j)^2.
struct DeviationLaw {
  Eigen::VectorXd a, b, range;

  /// Targets x samples.
  [[nodiscard]] Eigen::MatrixXd at(const Eigen::Ref<const Eigen::MatrixXd>& predicted) const;
};

/// Inputs far from those that were trained: squared distance in their covariance above `limit`.
struct TrainingEllipse {
  Eigen::VectorXd offset; ///< of the scaled inputs
  Eigen::MatrixXd inverseCovariance;
  double limit = 0;

  [[nodiscard]] double distance(const Eigen::Ref<const Eigen::VectorXd>& scaled) const;
};

/// What is prescribed; what is not is chosen by the validation.
struct MeasuredOptions {
  std::optional<RowOrder> order;
  std::optional<ReadingTransform> transform;
  std::optional<std::vector<double>> memory_s; ///< time constants; empty: no memory
  bool rowsAreClock = false;                   ///< rows are equally spaced in time
  bool lineOnly = false;                       ///< no Gaussians
  std::optional<double> spread;                ///< of the Gaussians, where the mean square length of the inputs is 1
  std::optional<double> ridge;                 ///< lambda of GroupRidge
  std::optional<int> centers;                  ///< at most; none: 500
  Eigen::Index forces = -1; ///< number of first targets that are forces, whose size counts for deviations; -1: all
  std::uint64_t seed = 1;
};

/// How the error was found and what it is; errors without a unit are shares of the targets' deviations.
struct MeasuredValidation {
  RowDependence dependence;
  Eigen::VectorXd stated;               ///< rms error of each target, in its unit
  double score = 0;                     ///< rms over the varying targets of stated / deviation
  double singleRowScore = 0;            ///< what leaving single rows out would have stated
  Eigen::VectorXd singleRow;            ///< the same in units
  std::optional<double> recordingScore; ///< with a complete run left out, where there are 2 to 4 runs
  Eigen::VectorXd recording;            ///< the same in units
  bool noClock = false;                 ///< rows depend on their neighbours, but there is no time: no memory was tried
  double lambda = 0;
  Eigen::Index rows = 0;  ///< that were fitted; of a longer table every k-th
  Eigen::MatrixXd errors; ///< left-out errors, targets x rows fitted
  std::vector<Eigen::Index> fittedRows;
};

/// A network of measured rows, its inputs and its errors.
struct MeasuredFit {
  InputStage stage;
  RbfNetwork network; ///< of the stage's inputs; without centres: a line
  DeviationLaw deviation;
  TrainingEllipse ellipse;
  Eigen::VectorXd low, high; ///< predictions are limited to them: the training range and 10 % on both sides
  MeasuredValidation validation;
};

/// Chooses transform, memory, line or Gaussians, spread and ridge by what errs least on rows that are left out together
/// as their dependence demands; within 2 % of the least error (0.5 % for independent rows) the one with the fewest
/// states, then the plainest (resources/docs/numerics/measured.md). The same seed gives the same bytes. Throws
/// NetworkError for rows from which no network can be made, and Cancelled. `progress` gets a share 0..1.
MeasuredFit fitMeasured(const MeasuredRows& rows, const MeasuredOptions& options, const std::stop_token& stop = {},
                        const std::function<void(double)>& progress = {});

} // namespace palp
