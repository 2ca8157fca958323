#pragma once

#include "nn/RbfTrainer.h"

#include <Eigen/Core>

#include <functional>
#include <stop_token>
#include <vector>

namespace palp {

/// Leave-one-out errors of one spread and ridge; one column a sample.
struct LeaveOneOutResult {
  double spread = 0;
  double ridge = 0;
  bool indefinite = false;   ///< at the ridge asked for, to rounding: it was raised until it was not
  Eigen::MatrixXd residuals; ///< outputs x samples: target minus what a network without the sample predicts
  Eigen::VectorXd rms;       ///< one an output
  double score = 0;          ///< root mean square over the outputs of rms / (targets' standard deviation)
};

/// Leave-one-out errors in closed form, e = w / diag((Phi + ridge I)^-1) (Rippa 1999), of the network with one centre a
/// sample that `options` describe, at each of the spreads; always from a full inverse. A ridge below what double
/// precision can carry is raised to it.
std::vector<LeaveOneOutResult> leaveOneOut(const Eigen::Ref<const Eigen::MatrixXd>& samples,
                                           const Eigen::Ref<const Eigen::MatrixXd>& targets,
                                           const std::vector<double>& spreads, const RbfOptions& options,
                                           const std::stop_token& stop = {});

/// The spread (and ridge and whitening, where the options leave them open) with the smallest leave-one-out score: a
/// logarithmic grid, then a golden-section refinement around its best point; where there is noise, and each spread
/// costs more, the half-steps beside it.
struct SpreadChoice {
  LeaveOneOutResult overall;
  double whitening = 0;                   ///< Scaling::Whiten: the power
  std::vector<LeaveOneOutResult> grid;    ///< the scores the choice was made from
  std::vector<double> spreadOfEachOutput; ///< the best spread were this the only output
};
SpreadChoice chooseSpread(const Eigen::Ref<const Eigen::MatrixXd>& samples,
                          const Eigen::Ref<const Eigen::MatrixXd>& targets, const RbfOptions& options,
                          const std::stop_token& stop = {});

} // namespace palp
