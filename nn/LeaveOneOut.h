#pragma once

#include "nn/RbfTrainer.h"

#include <Eigen/Core>

#include <functional>
#include <stop_token>
#include <vector>

namespace palp {

/// Leave-one-out errors at one spread and ridge; one column per sample.
struct LeaveOneOutResult {
  double spread = 0;
  double ridge = 0;          ///< that was used: one too small for double precision is raised
  bool indefinite = false;   ///< to rounding at the requested ridge, which was therefore raised
  Eigen::MatrixXd residuals; ///< outputs x samples: target minus what a network without the sample predicts
  Eigen::VectorXd rms;       ///< one per output
  double score = 0;          ///< root mean square over the outputs of rms / (targets' standard deviation)
};

/// Leave-one-out errors in closed form, e = w / diag((Phi + ridge I)^-1) (Rippa 1999;
/// resources/docs/numerics/networks.md), of the network that `options` describe, at each of the spreads; always from a
/// full inverse. A ridge too small for double precision is raised.
std::vector<LeaveOneOutResult> leaveOneOut(const Eigen::Ref<const Eigen::MatrixXd>& samples,
                                           const Eigen::Ref<const Eigen::MatrixXd>& targets,
                                           const std::vector<double>& spreads, const RbfOptions& options,
                                           const std::stop_token& stop = {});

/// The spread (and the ridge and whitening that the options leave open) with the smallest leave-one-out score: a
/// logarithmic grid, then golden-section refinement around its best point; with noise, when each spread costs more,
/// only the half-steps on either side.
struct SpreadChoice {
  LeaveOneOutResult overall;
  double whitening = 0;                   ///< Scaling::Whiten: the power
  std::vector<LeaveOneOutResult> grid;    ///< the scores that the choice is based on
  std::vector<double> spreadOfEachOutput; ///< the best spread for each output alone
};
SpreadChoice chooseSpread(const Eigen::Ref<const Eigen::MatrixXd>& samples,
                          const Eigen::Ref<const Eigen::MatrixXd>& targets, const RbfOptions& options,
                          const std::stop_token& stop = {});

} // namespace palp
