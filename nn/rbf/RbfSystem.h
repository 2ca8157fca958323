#pragma once

// Private to nn.

#include "nn/LeaveOneOut.h"
#include "nn/RbfTrainer.h"
#include "nn/rbf/TailSpace.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace palp {

/// Weights at one spread and ridge, and how they were found.
struct RbfSolution {
  Eigen::MatrixXd weights; ///< outputs x centres
  Eigen::MatrixXd tail;    ///< outputs x inputs, empty without a linear tail
  Eigen::VectorXd bias;
  BasisForm form = BasisForm::Gaussian;
  double ridge = 0; ///< that was used
  double condition = 0;
  int rank = 0;
  int unknowns = 0;
  std::vector<std::string> warnings;
};

/// Samples, targets and everything about a network but spread and ridge. Immutable: spreads may be tried in parallel.
/// All throw Cancelled soon after a stop request.
class RbfSystem {
public:
  virtual ~RbfSystem() = default;
  [[nodiscard]] virtual RbfSolution solve(double spread, double ridge, const std::stop_token& stop) const = 0;
  /// Leave-one-out errors at one spread and each of the ridges.
  [[nodiscard]] virtual std::vector<LeaveOneOutResult> leaveOneOut(double spread, const std::vector<double>& ridges,
                                                                   const std::stop_token& stop) const = 0;
  [[nodiscard]] virtual const Eigen::MatrixXd& centers() const = 0;
  [[nodiscard]] virtual const FeatureScaler& scaler() const = 0;
  /// Tail in use: `options.tail`, or LinearPenalised where there are too few samples for an exact one.
  [[nodiscard]] virtual Tail tail() const = 0;
};

/// The system that the options describe: interpolation with one centre a sample, or least squares on fewer centres or
/// on noisy copies. Throws NetworkError where there can be none. `noiseCopies` overrides the options'.
std::unique_ptr<RbfSystem> rbfSystem(const Eigen::Ref<const Eigen::MatrixXd>& samples,
                                     const Eigen::Ref<const Eigen::MatrixXd>& targets, const RbfOptions& options,
                                     int noiseCopies, const std::stop_token& stop = {});

/// The scaler that the options describe.
FeatureScaler scalerFor(const RbfOptions& options, const Eigen::Ref<const Eigen::MatrixXd>& samples);

/// Throws NetworkError for samples, targets or options that make no network.
void requireUsable(const Eigen::Ref<const Eigen::MatrixXd>& samples, const Eigen::Ref<const Eigen::MatrixXd>& targets,
                   const RbfOptions& options);

/// rms and score of residuals (outputs x samples) of targets (outputs x samples).
LeaveOneOutResult summarised(double spread, double ridge, Eigen::MatrixXd residuals, const Eigen::MatrixXd& targets);

} // namespace palp
