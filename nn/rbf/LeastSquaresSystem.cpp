#include "nn/rbf/LeastSquaresSystem.h"

#include "model/base/Cancelled.h"
#include "nn/Basis.h"
#include "nn/NoisyCopies.h"
#include "nn/linear/RidgeFit.h"
#include "nn/rbf/KMeans.h"
#include "nn/rbf/KernelSystem.h"

#include <algorithm>
#include <cmath>

namespace palp {
namespace {

Eigen::MatrixXd chooseCenters(const Eigen::MatrixXd& scaled, const RbfOptions& options) {
  const int samples = static_cast<int>(scaled.cols());
  const bool all = options.centers == CenterChoice::Samples;
  const int count = options.centerCount > 0 ? options.centerCount : all ? samples : kMostCenters;
  if (count >= samples) return scaled;
  if (options.centers == CenterChoice::KMeans) return kMeans(scaled, count, options.seed).centers;
  return scaled(Eigen::all, randomColumns(samples, count, options.seed));
}

} // namespace

LeastSquaresSystem::LeastSquaresSystem(const Eigen::Ref<const Eigen::MatrixXd>& samples,
                                       const Eigen::Ref<const Eigen::MatrixXd>& targets, const RbfOptions& options,
                                       int noiseCopies, const std::stop_token& stop)
    : options_(options), scaler_(scalerFor(options, samples)),
      copies_(options.relativeInputNoise > 0 ? noiseCopies : 1),
      rows_(scaler_.apply(
          noisyCopies(samples, options.relativeInputNoise, static_cast<int>(copies_), options.seed, stop))),
      centers_(chooseCenters(scaler_.apply(samples), options)), distances_(squaredDistances(rows_, centers_, stop)),
      tail_(affordableTail(options.tail, rows_)),
      tailIsUnknown_(tail_ == Tail::LinearPenalised || options.method == LeastSquaresMethod::Recursive),
      space_(rows_, tailIsUnknown_ ? Tail::None : tail_), targets_(repeatedColumns(targets, copies_)),
      shift_(tail_ == Tail::None ? Eigen::VectorXd::Zero(targets.rows()) : Eigen::VectorXd(targets.rowwise().mean())),
      right_(space_.project((targets_.colwise() - shift_).transpose())) {}

double LeastSquaresSystem::tailFactor() const {
  return tail_ == Tail::LinearPenalised ? std::sqrt(options_.tailVariance) : 1;
}

Eigen::MatrixXd LeastSquaresSystem::system(double spread, const std::stop_token& stop) const {
  throwIfStopped(stop);
  Eigen::MatrixXd phi = distances_;
  basisInPlace(phi, gaussianRate(spread, options_.convention));
  if (!tailIsUnknown_ || tail_ == Tail::None) return space_.project(phi);
  const Eigen::Index inputs = tail_ == Tail::Bias ? 0 : rows_.rows();
  Eigen::MatrixXd all(phi.rows(), phi.cols() + inputs + 1);
  all.leftCols(phi.cols()) = phi;
  all.middleCols(phi.cols(), inputs) = tailFactor() * rows_.topRows(inputs).transpose();
  all.rightCols(1).setConstant(tailFactor());
  return all;
}

RbfSolution LeastSquaresSystem::solve(double spread, double ridge, const std::stop_token& stop) const {
  const Eigen::MatrixXd a = system(spread, stop);
  const LinearSolution solved = solveLeastSquares(a, right_, options_.method, ridge * static_cast<double>(copies_),
                                                  options_.rcond, options_.forgetting, stop);
  RbfSolution solution;
  solution.ridge = solved.ridge / static_cast<double>(copies_);
  solution.condition = solved.condition;
  solution.rank = solved.rank;
  solution.unknowns = static_cast<int>(a.cols());
  solution.warnings = solved.warnings;
  const Eigen::Index count = centers_.cols();
  solution.weights = solved.x.topRows(count).transpose();
  solution.bias = shift_;
  if (tail_ == Tail::None) return solution;
  Eigen::MatrixXd coefficients = tailFactor() * solved.x.bottomRows(solved.x.rows() - count);
  if (!tailIsUnknown_) {
    Eigen::MatrixXd phi = distances_;
    basisInPlace(phi, gaussianRate(spread, options_.convention));
    coefficients =
        space_.coefficients((targets_.colwise() - shift_).transpose() - lapack::product(phi, false, solved.x, false));
  }
  solution.bias += coefficients.bottomRows(1).transpose();
  if (tail_ != Tail::Bias) solution.tail = coefficients.topRows(rows_.rows()).transpose();
  return solution;
}

std::vector<LeaveOneOutResult> LeastSquaresSystem::leaveOneOut(double spread, const std::vector<double>& ridges,
                                                               const std::stop_token& stop) const {
  const lapack::ThinSvd svd =
      copies_ > 1 ? lapack::svdOfGram(system(spread, stop), stop) : lapack::thinSvd(system(spread, stop));
  // System = U diag(s) V^T: the hat matrix of the ridge is Q2 U diag(f) U^T Q2^T with f = s^2 / (s^2 + k ridge), and
  // Q1 Q1^T of the exact tail.
  const Eigen::MatrixXd left = space_.embed(svd.u);
  const Eigen::MatrixXd tailBasis = space_.tailBasis();
  const Eigen::MatrixXd rotated = lapack::product(svd.u, true, right_, false);
  const Eigen::MatrixXd whole = space_.embed(right_);
  std::vector<LeaveOneOutResult> results;
  for (const double ridge : ridges) {
    throwIfStopped(stop);
    const Eigen::VectorXd filter = svd.values.unaryExpr([&](double s) {
      const double scaledRidge = ridge * static_cast<double>(copies_);
      return s > options_.rcond * svd.values(0) ? s * s / (s * s + scaledRidge) : 0.0;
    });
    const Eigen::MatrixXd remainder = whole - lapack::product(left, false, filter.asDiagonal() * rotated, false);
    results.push_back(summarised(
        spread, ridge, leftOutErrors(remainder, left * filter.cwiseSqrt().asDiagonal(), tailBasis, copies_), targets_));
  }
  return results;
}

} // namespace palp
