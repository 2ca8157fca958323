#pragma once

// Private to nn.

#include "nn/rbf/RbfSystem.h"

namespace palp {

/// Interpolation with one centre a sample, as kriging (H. Wendland, Scattered Data Approximation, 2005, 8.5):
///   (Phi + ridge I) w + P c = y,  P^T w = 0,  Phi_ij = phi(|s(x_i) - s(x_j)|),  P = [s(x), 1].
/// The ridge is added to the diagonal of Phi, which is 1. It is kriging's nugget; in least squares on the same centres
/// it would multiply w^T Phi w. With the exact tail out of the way (TailSpace, P = Q1 R, w = Q2 z) what is solved is
///   (Q2^T Phi Q2 + ridge I) z = Q2^T y,  then  P c = y - Phi w.
/// A penalised tail is a kernel of its own: Phi + tailVariance (X^T X + 1), and no P.
class KernelSystem final : public RbfSystem {
public:
  KernelSystem(const Eigen::Ref<const Eigen::MatrixXd>& samples, const Eigen::Ref<const Eigen::MatrixXd>& targets,
               const RbfOptions& options);
  [[nodiscard]] RbfSolution solve(double spread, double ridge, const std::stop_token& stop) const override;
  [[nodiscard]] std::vector<LeaveOneOutResult> leaveOneOut(double spread, const std::vector<double>& ridges,
                                                           const std::stop_token& stop) const override;
  [[nodiscard]] const Eigen::MatrixXd& centers() const override { return scaled_; }
  [[nodiscard]] const FeatureScaler& scaler() const override { return scaler_; }
  [[nodiscard]] Tail tail() const override { return tail_; }

private:
  /// Its lower triangle.
  [[nodiscard]] Eigen::MatrixXd kernel(double spread) const;
  [[nodiscard]] BasisForm form() const;
  [[nodiscard]] LeaveOneOutResult byInverse(double spread, double ridge, const std::stop_token& stop) const;
  [[nodiscard]] std::vector<LeaveOneOutResult> byEigen(double spread, const std::vector<double>& ridges,
                                                       const std::stop_token& stop) const;
  [[nodiscard]] LeaveOneOutResult result(double spread, double ridge, const Eigen::MatrixXd& weights,
                                         const Eigen::VectorXd& inverseDiagonal) const;

  RbfOptions options_;
  FeatureScaler scaler_;
  Eigen::MatrixXd scaled_;
  Eigen::MatrixXd distances_; ///< squared, the lower triangle
  Tail tail_;
  TailSpace space_;
  Eigen::MatrixXd targets_; ///< outputs x samples
  Eigen::VectorXd shift_;   ///< subtracted from the targets
  Eigen::MatrixXd right_;   ///< projected targets
};

/// LinearPenalised in place of an exact linear tail that would leave the Gaussians less than a third of the samples.
Tail affordableTail(Tail wanted, const Eigen::MatrixXd& scaled);

} // namespace palp
