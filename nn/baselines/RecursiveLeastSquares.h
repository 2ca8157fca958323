#pragma once

#include <Eigen/Core>

namespace palp {

/// Linear least squares, one observation at a time, with exponential forgetting; the paper's way of training and the
/// way to go on learning online (S. Haykin, Adaptive Filter Theory, 4th ed. 2002, chapter 9):
///   k = P x / (lambda + x^T P x),  w <- w + k (y - w^T x)^T,  P <- (P - k x^T P) / lambda.
/// P is the inverse correlation matrix of the regressors x, lambda the forgetting factor.
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
