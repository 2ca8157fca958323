#pragma once

#include "nn/RbfNetwork.h"
#include "nn/measured/InputStage.h"
#include "nn/measured/MeasuredErrors.h"
#include "nn/measured/RowDependence.h"

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

namespace palp {

/// Prescribed settings; empty ones are chosen by cross-validation.
struct MeasuredOptions {
  std::optional<RowOrder> order;
  std::optional<ReadingTransform> transform;
  std::optional<std::vector<double>> memory_s; ///< time constants; empty: no memory
  bool rowsAreClock = false;                   ///< times are the rows' numbers: they are equally spaced in time
  std::optional<double> spread;                ///< of the Gaussians, where the mean square length of the inputs is 1
  std::optional<double> ridge;                 ///< lambda of GroupRidge
  std::optional<int> centers;                  ///< largest number of centres; nullopt: 500
  Eigen::Index forces = -1; ///< the first targets, this many, are forces, whose size enters the deviations; -1: all
  std::uint64_t seed = 1;
};

/// Estimated errors and how they were found; errors without a unit are shares of the targets' standard deviations.
struct MeasuredValidation {
  RowDependence dependence;
  Eigen::VectorXd stated;               ///< rms error of each target on rows left out, in its unit
  double score = 0;                     ///< rms of stated / standard deviation over the targets that vary
  double singleRowScore = 0;            ///< the same with single rows left out
  Eigen::VectorXd singleRow;            ///< `stated` with single rows left out
  std::optional<double> recordingScore; ///< the score with a complete run left out, if there are 2 to 4 runs
  Eigen::VectorXd recording;            ///< `stated` with a complete run left out
  double lambda = 0;
  Eigen::MatrixXd errors;               ///< left-out errors, targets x rows fitted
  std::vector<Eigen::Index> fittedRows; ///< of a longer table every k-th row or run
};

/// A network trained on measured rows, with its inputs and its errors.
struct MeasuredFit {
  InputStage stage;
  RbfNetwork network; ///< its inputs are those of the stage; without centres it is a linear model
  DeviationLaw deviation;
  TrainingEllipse ellipse;
  MeasuredValidation validation;
};

/// Chooses transform, memory, line or Gaussians, spread and ridge by grouped cross-validation, and fits the network.
/// Rows that depend on each other are left out together. Among the candidates within 2 % of the smallest error (0.5 %
/// for independent rows), the one with the fewest time constants is chosen, then the one with the plainest features
/// (resources/docs/numerics/measured.md). The same seed gives the same bytes. Throws NetworkError if no network can be
/// fitted to the rows, and Cancelled if stopped. `progress` receives the share of the work that is done, 0 to 1.
MeasuredFit fitMeasured(const MeasuredRows& rows, const MeasuredOptions& options, const std::stop_token& stop = {},
                        const std::function<void(double)>& progress = {});

} // namespace palp
