#pragma once

#include <Eigen/Core>

namespace palp {

/// Linear least squares, one observation at a time, with exponential forgetting: how the paper trains, and how a
/// network keeps learning online. P is the inverse correlation matrix of the regressors.
class RecursiveLeastSquares {
public:
  /// `initialVariance` is the initial P: if large, the first observations decide. `forgetting` in (0, 1].
  RecursiveLeastSquares(Eigen::Index unknowns, Eigen::Index outputs, double initialVariance = 1e6,
                        double forgetting = 1);
  /// Starts from known weights (unknowns x outputs).
  RecursiveLeastSquares(Eigen::MatrixXd weights, double initialVariance, double forgetting = 1);

  /// One observation: regressors (unknowns) and targets (outputs).
  void update(const Eigen::Ref<const Eigen::VectorXd>& regressors, const Eigen::Ref<const Eigen::VectorXd>& targets);

  /// Unknowns x outputs.
  [[nodiscard]] const Eigen::MatrixXd& weights() const { return weights_; }

private:
  Eigen::MatrixXd weights_;
  Eigen::MatrixXd variance_;
  double forgetting_;
};

} // namespace palp
