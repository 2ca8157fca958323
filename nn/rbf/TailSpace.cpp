#include "nn/rbf/TailSpace.h"

namespace palp {
namespace {

/// Directions of the inputs smaller than this against the largest are rounding of the samples.
constexpr double kTailRcond = 1e-13;

} // namespace

TailSpace::TailSpace(const Eigen::MatrixXd& scaled, Tail tail) : samples_(scaled.cols()) {
  if (tail != Tail::Bias && tail != Tail::Linear) return;
  const Eigen::Index inputs = tail == Tail::Linear ? scaled.rows() : 0;
  Eigen::MatrixXd regressors(samples_, inputs + 1);
  regressors.leftCols(inputs) = scaled.topRows(inputs).transpose();
  regressors.col(inputs).setOnes();
  qr_.emplace(std::move(regressors));
  rank_ = qr_->rank(kTailRcond);
  q_ = qr_->blockReflector();
  vt_ = q_.v * q_.t;
}

Eigen::MatrixXd TailSpace::project(const Eigen::MatrixXd& b) const {
  if (!qr_) return b;
  const Eigen::Index rest = samples_ - rank_;
  const Eigen::MatrixXd inner = lapack::product(vt_, true, b, false);
  return b.bottomRows(rest) - lapack::product(q_.v.bottomRows(rest), false, inner, false);
}

void TailSpace::projectInPlace(Eigen::MatrixXd& a) const {
  const Eigen::Index rest = samples_ - rank_;
  reflect(a, a.bottomRightCorner(rest, rest));
}

Eigen::MatrixXd TailSpace::projectBothSides(const Eigen::MatrixXd& a) const {
  const Eigen::Index rest = samples_ - rank_;
  Eigen::MatrixXd corner = a.bottomRightCorner(rest, rest);
  reflect(a, corner);
  return corner;
}

void TailSpace::reflect(const Eigen::MatrixXd& a, Eigen::Ref<Eigen::MatrixXd> corner) const {
  if (!qr_) return;
  // Q^T A Q = A - V W^T - W V^T with W = A V T - V T^T V^T A V T / 2.
  const Eigen::MatrixXd product = lapack::symmetricProduct(a, vt_);
  const Eigen::MatrixXd middle = lapack::product(vt_, true, product, false) / 2;
  const Eigen::MatrixXd w = product - lapack::product(q_.v, false, middle, false);
  lapack::subtractRankTwo(q_.v.bottomRows(corner.rows()), w.bottomRows(corner.rows()), corner);
}

void TailSpace::solveProjectionInPlace(Eigen::MatrixXd& a) const {
  // Q2^T = [0 I] - V2 (V T)^T with V2 the last rows of V.
  const Eigen::Index rest = samples_ - rank_;
  auto inverse = a.bottomRightCorner(rest, rest);
  lapack::invertLowerInPlace(inverse);
  if (!qr_) return;
  const Eigen::MatrixXd solved = lapack::product(inverse, false, q_.v.bottomRows(rest), false);
  a.bottomLeftCorner(rest, rank_).setZero();
  lapack::subtractProduct(solved, vt_, a.bottomRows(rest));
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
