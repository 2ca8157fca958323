#pragma once

#include "nn/RbfTrainer.h"
#include "nn/RelativeError.h"

#include <functional>
#include <vector>

namespace palp {

/// One spread of a sweep.
struct SweepRow {
  double spread = 0;
  PredictionError error; ///< on the test samples
  FitReport report;
  Eigen::MatrixXd predicted; ///< outputs x test samples
};

struct SweepInput {
  Eigen::MatrixXd samples, targets;         ///< training
  Eigen::MatrixXd testSamples, testTargets; ///< what the error is measured on
  Eigen::VectorXd range;                    ///< of the targets, for the % of range
};

/// Trains at each spread and measures the error; rows in the order of `spreads`. `progress` gets the rows done. On
/// a stop request the unfinished row is dropped and the others are returned.
std::vector<SweepRow> sweepSpreads(const SweepInput& input, const std::vector<double>& spreads,
                                   const RbfOptions& options, const std::function<void(std::size_t)>& progress = {},
                                   const std::stop_token& stop = {});

/// `count` spreads from `low` to `high`, evenly on a logarithmic scale. Throws NetworkError unless 0 < low <= high.
std::vector<double> logarithmicRange(double low, double high, int count);

} // namespace palp
