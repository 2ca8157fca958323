#include "nn/rbf/KernelSystem.h"

#include "model/base/Cancelled.h"
#include "nn/Basis.h"
#include "nn/NetworkError.h"
#include "nn/linear/LinearSolve.h"

#include <algorithm>
#include <limits>

namespace palp {
namespace {

Eigen::VectorXd shiftFor(Tail tail, const Eigen::MatrixXd& targets) {
  return tail == Tail::None ? Eigen::VectorXd::Zero(targets.rows()) : Eigen::VectorXd(targets.rowwise().mean());
}

} // namespace

Tail affordableTail(Tail wanted, const Eigen::MatrixXd& scaled) {
  if (wanted != Tail::Linear) return wanted;
  const Eigen::Index rest = scaled.cols() - std::min(scaled.rows() + 1, scaled.cols());
  return 3 * rest < scaled.cols() ? Tail::LinearPenalised : wanted;
}

KernelSystem::KernelSystem(const Eigen::Ref<const Eigen::MatrixXd>& samples,
                           const Eigen::Ref<const Eigen::MatrixXd>& targets, const RbfOptions& options)
    : options_(options), scaler_(scalerFor(options, samples)), scaled_(scaler_.apply(samples)),
      distances_(squaredDistances(scaled_)), tail_(affordableTail(options.tail, scaled_)), space_(scaled_, tail_),
      targets_(targets), shift_(shiftFor(tail_, targets_)),
      right_(space_.project((targets_.colwise() - shift_).transpose())) {}

Eigen::MatrixXd KernelSystem::kernel(double spread) const {
  Eigen::MatrixXd phi = distances_;
  const double rate = gaussianRate(spread, options_.convention);
  for (Eigen::Index j = 0; j < phi.cols(); ++j) basisInPlace(phi.block(j, j, phi.rows() - j, 1), rate, form());
  if (tail_ == Tail::LinearPenalised) {
    phi += options_.tailVariance * lapack::gram(scaled_);
    phi.array() += options_.tailVariance;
  }
  return phi;
}

BasisForm KernelSystem::form() const {
  return tail_ == Tail::Linear ? BasisForm::Remainder : BasisForm::Gaussian;
}

RbfSolution KernelSystem::solve(double spread, double ridge, const std::stop_token& stop) const {
  throwIfStopped(stop);
  const Eigen::MatrixXd phi = kernel(spread);
  throwIfStopped(stop);
  // (Q2^T Phi Q2 + ridge I) z = Q2^T y
  const LinearSolution solved =
      solveSymmetric(space_.projectBothSides(phi), right_, options_.method, ridge, options_.rcond, stop);
  throwIfStopped(stop);
  const Eigen::MatrixXd weights = space_.embed(solved.x); // w = Q2 z, samples x outputs
  RbfSolution solution;
  solution.ridge = solved.ridge;
  solution.condition = solved.condition;
  solution.rank = solved.rank;
  solution.unknowns = static_cast<int>(right_.rows());
  solution.warnings = solved.warnings;
  solution.weights = weights.transpose();
  solution.bias = shift_;
  solution.form = form();
  if (tail_ == Tail::LinearPenalised) {
    solution.tail = options_.tailVariance * lapack::product(weights, true, scaled_, true);
    solution.bias += options_.tailVariance * weights.colwise().sum().transpose();
  } else if (tail_ != Tail::None) {
    // P c = y - Phi w; the ridge's part of the residual is orthogonal to P.
    const Eigen::MatrixXd rest = (targets_.colwise() - shift_).transpose() - lapack::symmetricProduct(phi, weights);
    const Eigen::MatrixXd coefficients = space_.coefficients(rest);
    solution.bias += coefficients.bottomRows(1).transpose();
    if (tail_ == Tail::Linear) solution.tail = coefficients.topRows(scaled_.rows()).transpose();
  }
  return solution;
}

std::vector<LeaveOneOutResult> KernelSystem::leaveOneOut(double spread, const std::vector<double>& ridges,
                                                         const std::stop_token& stop) const {
  throwIfStopped(stop);
  if (ridges.size() == 1) return {byInverse(spread, ridges.front(), stop)};
  return byEigen(spread, ridges, stop);
}

LeaveOneOutResult KernelSystem::byInverse(double spread, double ridge, const std::stop_token& stop) const {
  const Eigen::Index unknowns = right_.rows();
  bool indefinite = false;
  for (;;) {
    throwIfStopped(stop);
    Eigen::MatrixXd phi = kernel(spread);
    throwIfStopped(stop);
    space_.projectInPlace(phi);
    throwIfStopped(stop);
    auto factor = phi.bottomRightCorner(unknowns, unknowns);
    ridge = std::max(ridge, smallestRidge(unknowns == 0 ? 0 : factor.diagonal().sum()));
    factor.diagonal().array() += ridge;
    if (!lapack::choleskyInPlace(factor)) {
      if (!(ridge < std::numeric_limits<double>::max() / 100))
        throw NetworkError("leave-one-out: no ridge makes the system definite: the samples are too large for double "
                           "precision");
      ridge = std::max(10 * ridge, std::numeric_limits<double>::min());
      indefinite = true;
      continue;
    }
    // A = L L^T. With H = L^-1 Q2^T: w = H^T (L^-1 Q2^T y), and diag(Q2 A^-1 Q2^T) are the squares of H's columns.
    throwIfStopped(stop);
    const Eigen::MatrixXd right = lapack::solveLower(factor, right_, false);
    space_.solveProjectionInPlace(phi);
    const auto half = phi.bottomRows(unknowns);
    LeaveOneOutResult left =
        result(spread, ridge, lapack::product(half, true, right, false), half.colwise().squaredNorm().transpose());
    left.indefinite = indefinite;
    return left;
  }
}

std::vector<LeaveOneOutResult> KernelSystem::byEigen(double spread, const std::vector<double>& ridges,
                                                     const std::stop_token& stop) const {
  Eigen::MatrixXd system = space_.projectBothSides(kernel(spread));
  const double least = smallestRidge(system.rows() == 0 ? 0 : system.diagonal().sum());
  throwIfStopped(stop);
  const lapack::SymmetricEigen eigen = lapack::symmetricEigen(std::move(system));
  throwIfStopped(stop);
  // Q2^T Phi Q2 = V diag(l) V^T once, then for each ridge: w = U diag(1 / (l + ridge)) V^T Q2^T y, U = Q2 V, and the
  // diagonal of the inverse is that of U diag(1 / (l + ridge)) U^T.
  const Eigen::MatrixXd vectors = space_.embed(eigen.vectors);
  const Eigen::MatrixXd squares = vectors.cwiseAbs2();
  const Eigen::MatrixXd rotated = lapack::product(eigen.vectors, true, right_, false);
  std::vector<LeaveOneOutResult> results;
  for (const double wanted : ridges) {
    const double ridge = std::max(wanted, least);
    const Eigen::VectorXd inverse = (eigen.values.array().max(0.0) + ridge).inverse();
    results.push_back(result(spread, ridge, lapack::product(vectors, false, inverse.asDiagonal() * rotated, false),
                             squares * inverse));
  }
  return results;
}

LeaveOneOutResult KernelSystem::result(double spread, double ridge, const Eigen::MatrixXd& weights,
                                       const Eigen::VectorXd& inverseDiagonal) const {
  // e_i = w_i / (A^-1)_ii (S. Rippa, Adv. Comput. Math. 11 (1999) 193), with a tail Q2 (Q2^T A Q2)^-1 Q2^T for A^-1,
  // A = Phi + ridge I. A sample that the tail alone fits whatever its target has a weight and a diagonal of 0: nothing
  // is known of it.
  const Eigen::VectorXd divisor = (inverseDiagonal.array() > 0).select(inverseDiagonal, 1.0);
  Eigen::MatrixXd residuals = (divisor.cwiseInverse().asDiagonal() * weights).transpose();
  return summarised(spread, ridge, std::move(residuals), targets_);
}

} // namespace palp
