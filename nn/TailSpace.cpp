#include "nn/TailSpace.h"

namespace palp {
namespace {

/// Directions of the inputs smaller than this against the largest are rounding of the samples.
constexpr double tailRcond = 1e-13;

} // namespace

TailSpace::TailSpace(const Eigen::MatrixXd& scaled, Tail tail) : samples_(scaled.cols()) {
  if (tail != Tail::Bias && tail != Tail::Linear) return;
  const Eigen::Index inputs = tail == Tail::Linear ? scaled.rows() : 0;
  Eigen::MatrixXd regressors(samples_, inputs + 1);
  regressors.leftCols(inputs) = scaled.topRows(inputs).transpose();
  regressors.col(inputs).setOnes();
  qr_.emplace(std::move(regressors));
  rank_ = qr_->rank(tailRcond);
  q_ = qr_->blockReflector();
}

Eigen::MatrixXd TailSpace::project(const Eigen::MatrixXd& b) const {
  if (!qr_) return b;
  const Eigen::Index rest = samples_ - rank_;
  const Eigen::MatrixXd inner = q_.t.transpose() * lapack::product(q_.v, true, b, false);
  return b.bottomRows(rest) - lapack::product(q_.v.bottomRows(rest), false, inner, false);
}

Eigen::MatrixXd TailSpace::projectBothSides(const Eigen::MatrixXd& a) const {
  if (!qr_) return a;
  // Q^T A Q = A - V W^T - W V^T with W = A V T - V T^T V^T A V T / 2.
  const Eigen::Index rest = samples_ - rank_, count = q_.v.cols();
  const Eigen::MatrixXd product = lapack::product(a, false, q_.v * q_.t, false);
  const Eigen::MatrixXd middle = q_.t.transpose() * lapack::product(q_.v, true, product, false);
  const Eigen::MatrixXd w = product - q_.v * (middle / 2);
  Eigen::MatrixXd left(rest, 2 * count), right(rest, 2 * count);
  left << q_.v.bottomRows(rest), w.bottomRows(rest);
  right << w.bottomRows(rest), q_.v.bottomRows(rest);
  return a.bottomRightCorner(rest, rest) - lapack::product(left, false, right, true);
}

Eigen::MatrixXd TailSpace::embed(const Eigen::MatrixXd& z) const {
  if (!qr_) return z;
  const Eigen::Index rest = samples_ - rank_;
  const Eigen::MatrixXd inner = q_.t * lapack::product(q_.v.bottomRows(rest), true, z, false);
  Eigen::MatrixXd result = -lapack::product(q_.v, false, inner, false);
  result.bottomRows(rest) += z;
  return result;
}

Eigen::MatrixXd TailSpace::tailBasis() const {
  if (!qr_) return Eigen::MatrixXd(samples_, 0);
  const Eigen::MatrixXd inner = q_.t * q_.v.topRows(rank_).transpose();
  return Eigen::MatrixXd::Identity(samples_, rank_) - lapack::product(q_.v, false, inner, false);
}

Eigen::MatrixXd TailSpace::coefficients(const Eigen::MatrixXd& b) const {
  return qr_ ? qr_->solve(b, rank_) : Eigen::MatrixXd(0, b.cols());
}

} // namespace palp
