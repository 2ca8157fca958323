#include "nn/measured/GroupRidge.h"

#include "model/base/Cancelled.h"
#include "nn/linear/Lapack.h"

#include <algorithm>
#include <limits>

namespace palp {

namespace {

constexpr double kConstantPenalty = 1e-9; ///< of the constant, for each row: keeps the matrix definite

/// Solution of a positive definite system; NaN where it is not.
Eigen::MatrixXd solved(Eigen::MatrixXd normal, const Eigen::MatrixXd& right) {
  if (!lapack::choleskyInPlace(normal))
    return Eigen::MatrixXd::Constant(right.rows(), right.cols(), std::numeric_limits<double>::quiet_NaN());
  return lapack::solveLower(normal, lapack::solveLower(normal, right, false), true);
}

} // namespace

GroupRidge::GroupRidge(Eigen::MatrixXd a, Eigen::MatrixXd y) : a_(std::move(a)), y_(std::move(y)) {
  a_.conservativeResize(Eigen::NoChange, a_.cols() + 1);
  a_.rightCols<1>().setOnes();
  normal_ = lapack::gram(a_);
  right_ = lapack::product(a_, true, y_, false);
  meanSquare_ = normal_.diagonal().head(a_.cols() - 1).sum() / static_cast<double>(a_.rows());
}

Eigen::MatrixXd GroupRidge::penalised(Eigen::MatrixXd normal, double lambda) const {
  const auto rows = static_cast<double>(a_.rows());
  normal.diagonal().head(a_.cols() - 1).array() += lambda * rows * meanSquare_;
  normal(a_.cols() - 1, a_.cols() - 1) += kConstantPenalty * rows;
  return normal;
}

Eigen::MatrixXd GroupRidge::fit(double lambda) const {
  return solved(penalised(normal_, lambda), right_);
}

std::vector<Eigen::MatrixXd> GroupRidge::errors(const std::vector<Fold>& folds, const std::vector<double>& lambdas,
                                                const std::stop_token& stop) const {
  std::vector<Eigen::MatrixXd> all(lambdas.size(), Eigen::MatrixXd::Zero(y_.rows(), y_.cols()));
  for (const Fold& fold : folds) {
    throwIfStopped(stop);
    const Eigen::MatrixXd out = a_(fold.leftOut, Eigen::all), judged = a_(fold.judged, Eigen::all);
    const Eigen::MatrixXd normal = normal_ - lapack::gram(out);
    const Eigen::MatrixXd right = right_ - out.transpose() * y_(fold.leftOut, Eigen::all);
    for (std::size_t l = 0; l < lambdas.size(); ++l) {
      throwIfStopped(stop);
      all[l](fold.judged, Eigen::all) =
          y_(fold.judged, Eigen::all) - judged * solved(penalised(normal, lambdas[l]), right);
    }
  }
  return all;
}

Eigen::MatrixXd GroupRidge::singleRowErrors(double lambda) const {
  Eigen::MatrixXd factor = penalised(normal_, lambda);
  if (!lapack::choleskyInPlace(factor))
    return Eigen::MatrixXd::Constant(y_.rows(), y_.cols(), std::numeric_limits<double>::quiet_NaN());
  const Eigen::MatrixXd half = lapack::solveLower(factor, a_.transpose(), false); // features x rows
  const Eigen::VectorXd kept = (1 - half.colwise().squaredNorm().array()).max(1e-14).transpose();
  const Eigen::MatrixXd remainder = y_ - half.transpose() * (half * y_);
  return kept.cwiseInverse().asDiagonal() * remainder;
}

} // namespace palp
