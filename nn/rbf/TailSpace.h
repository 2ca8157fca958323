#pragma once

// Private to nn.

#include "nn/RbfTrainer.h"
#include "nn/linear/Lapack.h"

#include <Eigen/Core>

#include <optional>

namespace palp {

/// The regressors P = [inputs, 1] of an exact tail (or 1 alone, or nothing) and the space orthogonal to them, in which
/// the Gaussians' weights live: with P = Q1 R the projection is b -> Q2^T b.
class TailSpace {
public:
  /// `scaled` is inputs x samples. Tail::LinearPenalised and Tail::None have no such regressors.
  TailSpace(const Eigen::MatrixXd& scaled, Tail tail);

  [[nodiscard]] Eigen::Index samples() const { return samples_; }
  [[nodiscard]] Eigen::Index rank() const { return rank_; }
  /// Q2^T b.
  [[nodiscard]] Eigen::MatrixXd project(const Eigen::MatrixXd& b) const;
  /// Q2^T a Q2 for a symmetric a, the lower triangle from the lower triangle.
  [[nodiscard]] Eigen::MatrixXd projectBothSides(const Eigen::MatrixXd& a) const;
  /// The same into the last samples - rank rows and columns of a.
  void projectInPlace(Eigen::MatrixXd& a) const;
  /// l^-1 Q2^T into the last samples - rank rows of `a`, where its last columns hold the lower factor l, 0 above: much
  /// cheaper than to solve for a dense Q2^T.
  void solveProjectionInPlace(Eigen::MatrixXd& a) const;
  /// Q2 z.
  [[nodiscard]] Eigen::MatrixXd embed(const Eigen::MatrixXd& z) const;
  /// Q1, samples x rank.
  [[nodiscard]] Eigen::MatrixXd tailBasis() const;
  /// Least-squares coefficients of P for b (samples x outputs): regressors x outputs, the bias last.
  [[nodiscard]] Eigen::MatrixXd coefficients(const Eigen::MatrixXd& b) const;

private:
  /// `corner` becomes that of Q^T a Q, from that of a.
  void reflect(const Eigen::MatrixXd& a, Eigen::Ref<Eigen::MatrixXd> corner) const;

  Eigen::Index samples_ = 0;
  Eigen::Index rank_ = 0;
  std::optional<lapack::PivotedQr> qr_;
  lapack::PivotedQr::BlockReflector q_; ///< of qr_
  Eigen::MatrixXd vt_;                  ///< its V T
};

} // namespace palp
