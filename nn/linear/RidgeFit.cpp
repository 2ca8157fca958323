#include "nn/linear/RidgeFit.h"

#include "model/base/Cancelled.h"
#include "nn/NetworkError.h"
#include "nn/SpreadSweep.h"
#include "nn/linear/Lapack.h"
#include "nn/rbf/RbfSystem.h"

#include <Eigen/Cholesky>

#include <cmath>
#include <limits>

namespace palp {

Eigen::MatrixXd leftOutErrors(const Eigen::MatrixXd& remainder, const Eigen::MatrixXd& l, const Eigen::MatrixXd& t,
                              Eigen::Index copies) {
  Eigen::MatrixXd errors(remainder.cols(), remainder.rows());
  for (Eigen::Index first = 0; first < remainder.rows(); first += copies) {
    const Eigen::MatrixXd group = l.middleRows(first, copies), tail = t.middleRows(first, copies);
    Eigen::MatrixXd kept = -group * group.transpose() - tail * tail.transpose();
    // A sample that alone determines a direction cannot be left out: its error is then its residual, not a division by
    // 0.
    kept.diagonal().array() += 1 + 1e-14;
    // Its entries near 0 are differences of rounded numbers and may be of either sign: only the result is checked.
    const Eigen::MatrixXd found = kept.ldlt().solve(remainder.middleRows(first, copies));
    if (!found.allFinite()) throw NetworkError("leave-one-out: the readings contain numbers beyond double precision");
    errors.middleCols(first, copies) = found.transpose();
  }
  return errors;
}

RidgeFit ridgeFit(const Eigen::MatrixXd& a, const Eigen::MatrixXd& y, Eigen::Index copies,
                  const std::optional<double>& ridge, const std::stop_token& stop, double rcond) {
  const Eigen::RowVectorXd meanA = a.colwise().mean(), meanY = y.colwise().mean();
  const Eigen::MatrixXd shifted = a.rowwise() - meanA;
  const lapack::ThinSvd svd = copies > 1 ? lapack::svdOfGram(shifted, stop) : lapack::thinSvd(shifted);
  const Eigen::MatrixXd centred = y.rowwise() - meanY;
  const Eigen::MatrixXd rotated = lapack::product(svd.u, true, centred, false);
  const double largest = svd.values.size() == 0 ? 0 : svd.values(0);
  const Eigen::MatrixXd constant = Eigen::MatrixXd::Constant(a.rows(), 1, 1 / std::sqrt(static_cast<double>(a.rows())));
  const Eigen::MatrixXd targets = y.transpose();

  const auto errorsAt = [&](double value) {
    throwIfStopped(stop);
    const Eigen::VectorXd filter = svd.values.unaryExpr(
        [&](double s) { return s > rcond * largest ? s * s / (s * s + value * largest * largest) : 0.0; });
    const Eigen::MatrixXd remainder = centred - lapack::product(svd.u, false, filter.asDiagonal() * rotated, false);
    return summarised(0, value, leftOutErrors(remainder, svd.u * filter.cwiseSqrt().asDiagonal(), constant, copies),
                      targets);
  };
  LeaveOneOutResult best = errorsAt(ridge.value_or(1e-13));
  if (!ridge)
    for (const double value : logarithmicRange(1e-13, 10, 29)) {
      LeaveOneOutResult next = errorsAt(value);
      if (next.score < best.score) best = std::move(next);
    }

  // x = V diag(s / (s^2 + ridge s1^2)) U^T y over the singular values above rounding.
  RidgeFit fit;
  fit.ridge = best.ridge;
  const Eigen::VectorXd inverse = svd.values.unaryExpr(
      [&](double s) { return s > rcond * largest ? s / (s * s + best.ridge * largest * largest) : 0.0; });
  fit.x = lapack::product(svd.vTransposed, true, inverse.asDiagonal() * rotated, false);
  fit.constant = (meanY - meanA * fit.x).transpose();
  fit.rank = static_cast<int>((inverse.array() != 0).count());
  const double least = svd.values.size() == 0 ? 0 : svd.values.minCoeff();
  fit.condition = least > 0 ? largest / least : std::numeric_limits<double>::infinity();
  fit.residuals.resize(y.cols(), y.rows() / copies);
  for (Eigen::Index i = 0; i < fit.residuals.cols(); ++i) fit.residuals.col(i) = best.residuals.col(i * copies);
  return fit;
}

Eigen::MatrixXd repeatedColumns(const Eigen::MatrixXd& columns, Eigen::Index copies) {
  Eigen::MatrixXd result(columns.rows(), columns.cols() * copies);
  for (Eigen::Index i = 0; i < result.cols(); ++i) result.col(i) = columns.col(i / copies);
  return result;
}

} // namespace palp
