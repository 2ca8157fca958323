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
}

Eigen::MatrixXd TailSpace::project(const Eigen::MatrixXd& b) const {
  return qr_ ? Eigen::MatrixXd(qr_->applyQTransposed(b).bottomRows(samples_ - rank_)) : b;
}

Eigen::MatrixXd TailSpace::projectBothSides(const Eigen::MatrixXd& a) const {
  if (!qr_) return a;
  const Eigen::Index rest = samples_ - rank_;
  return qr_->applyQFromRight(qr_->applyQTransposed(a)).bottomRightCorner(rest, rest);
}

Eigen::MatrixXd TailSpace::embed(const Eigen::MatrixXd& z) const {
  if (!qr_) return z;
  Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(samples_, z.cols());
  padded.bottomRows(samples_ - rank_) = z;
  return qr_->applyQ(std::move(padded));
}

Eigen::MatrixXd TailSpace::tailBasis() const {
  if (!qr_) return Eigen::MatrixXd(samples_, 0);
  return qr_->applyQ(Eigen::MatrixXd::Identity(samples_, rank_));
}

Eigen::MatrixXd TailSpace::coefficients(const Eigen::MatrixXd& b) const {
  return qr_ ? qr_->solve(b, rank_) : Eigen::MatrixXd(0, b.cols());
}

} // namespace palp
