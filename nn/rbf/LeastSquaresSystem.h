#pragma once

// Private to nn.

#include "nn/linear/LinearSolve.h"
#include "nn/rbf/RbfSystem.h"

namespace palp {

/// Least squares on given centres, and on noisy copies of the samples where there is noise:
///   min |Phi w + P c - y|^2 + k ridge |w|^2,  Phi_ij = phi(|s(x_i) - c_j|),
/// over the rows of all k copies, so that the ridge weighs the same against each sample however many copies it has. An
/// exact tail P c is not penalised (TailSpace projects it out); a penalised one is among the unknowns, as columns
/// sqrt(tailVariance) [s(x), 1].
class LeastSquaresSystem final : public RbfSystem {
public:
  LeastSquaresSystem(const Eigen::Ref<const Eigen::MatrixXd>& samples, const Eigen::Ref<const Eigen::MatrixXd>& targets,
                     const RbfOptions& options, int noiseCopies, const std::stop_token& stop);
  [[nodiscard]] RbfSolution solve(double spread, double ridge, const std::stop_token& stop) const override;
  [[nodiscard]] std::vector<LeaveOneOutResult> leaveOneOut(double spread, const std::vector<double>& ridges,
                                                           const std::stop_token& stop) const override;
  [[nodiscard]] const Eigen::MatrixXd& centers() const override { return centers_; }
  [[nodiscard]] const FeatureScaler& scaler() const override { return scaler_; }
  [[nodiscard]] Tail tail() const override { return tail_; }

private:
  /// Gaussians at the rows, with the tail's columns where it is among the unknowns; rows x unknowns, projected.
  [[nodiscard]] Eigen::MatrixXd system(double spread, const std::stop_token& stop) const;
  [[nodiscard]] double tailFactor() const;

  RbfOptions options_;
  FeatureScaler scaler_;
  Eigen::Index copies_ = 1;
  Eigen::MatrixXd rows_; ///< scaled inputs of what is fitted: sample i's copies are columns i copies ...
  Eigen::MatrixXd centers_;
  Eigen::MatrixXd distances_; ///< squared, rows x centres
  Tail tail_;
  bool tailIsUnknown_; ///< the tail is among the unknowns, not projected out
  TailSpace space_;
  Eigen::MatrixXd targets_; ///< outputs x rows
  Eigen::VectorXd shift_;
  Eigen::MatrixXd right_;
};

} // namespace palp
