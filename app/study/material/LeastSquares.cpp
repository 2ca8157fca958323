#include "app/study/material/LeastSquares.h"

#include "model/base/PositiveSolve.h"

#include <Eigen/QR>
#include <unsupported/Eigen/LevenbergMarquardt>

#include <cmath>
#include <limits>

namespace palp {

namespace {

constexpr double kDependent = 1e-7; // of the columns' size

/// Columns of length 1, as constants differ by orders of magnitude.
Eigen::MatrixXd normalised(const Eigen::MatrixXd& columns, Eigen::VectorXd& lengths) {
  lengths = columns.colwise().norm().transpose();
  return columns * lengths.cwiseInverse().asDiagonal();
}

} // namespace

std::optional<Eigen::VectorXd> leastSquares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& right) {
  Eigen::VectorXd lengths;
  const Eigen::MatrixXd unit = normalised(columns, lengths);
  if (!unit.allFinite() || !right.allFinite()) return {};
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(unit);
  qr.setThreshold(kDependent);
  if (qr.rank() < columns.cols()) return {};
  return qr.solve(right).cwiseQuotient(lengths);
}

Eigen::MatrixXd inverseOfSquares(const Eigen::MatrixXd& J) {
  Eigen::VectorXd lengths;
  const Eigen::MatrixXd unit = normalised(J, lengths);
  const auto factor = positiveFactor(Eigen::MatrixXd(unit.transpose() * unit));
  if (!factor) return Eigen::MatrixXd::Constant(J.cols(), J.cols(), std::numeric_limits<double>::infinity());
  const Eigen::MatrixXd inverse = factor->solve(Eigen::MatrixXd::Identity(J.cols(), J.cols()));
  return lengths.cwiseInverse().asDiagonal() * inverse * lengths.cwiseInverse().asDiagonal();
}

Eigen::MatrixXd differences(const Eigen::VectorXd& at, const ResidualsOf& residuals) {
  Eigen::MatrixXd J;
  for (Eigen::Index k = 0; k < at.size(); ++k) {
    const double step = 1e-6 * std::max(std::abs(at(k)), 1e-6);
    Eigen::VectorXd plus = at, minus = at;
    plus(k) += step;
    minus(k) -= step;
    const Eigen::VectorXd column = (residuals(plus) - residuals(minus)) / (2 * step);
    if (k == 0) J.resize(column.size(), at.size());
    J.col(k) = column;
  }
  return J;
}

namespace {

/// The residuals as Eigen's solver calls them.
struct Functor : Eigen::DenseFunctor<double> {
  Functor(Eigen::Index count, const ResidualsOf& of, const std::function<bool(const Eigen::VectorXd&)>& may,
          const Eigen::VectorXd& start)
      : DenseFunctor(static_cast<int>(start.size()), static_cast<int>(count)), residuals(of), allowed(may) {}

  /// Far from the minimum for parameters that are not allowed, so that the step is shortened.
  int operator()(const Eigen::VectorXd& at, Eigen::VectorXd& values) const {
    constexpr double far = 1e150;
    if (allowed(at)) values = residuals(at);
    if (!allowed(at) || !values.allFinite()) values.setConstant(this->values(), far);
    return 0;
  }
  /// Ends the search where there is no slope.
  int df(const Eigen::VectorXd& at, Eigen::MatrixXd& slope) const {
    slope = differences(at, residuals);
    return slope.allFinite() ? 0 : -1;
  }

  const ResidualsOf& residuals;
  const std::function<bool(const Eigen::VectorXd&)>& allowed;
};

} // namespace

Minimum levenbergMarquardt(const Eigen::VectorXd& start, const ResidualsOf& residuals,
                           const std::function<bool(const Eigen::VectorXd&)>& allowed) {
  constexpr int evaluations = 2000;
  constexpr double ends = 1e-12; // relative change of the squares, or of the parameters
  const Eigen::VectorXd first = residuals(start);
  Minimum found{start, first.squaredNorm()};
  if (!std::isfinite(found.squares)) return {start, std::numeric_limits<double>::infinity()};
  Functor functor(first.size(), residuals, allowed, start);
  Eigen::LevenbergMarquardt<Functor> search(functor);
  search.setFtol(ends);
  search.setXtol(ends);
  search.setMaxfev(evaluations);
  search.minimize(found.at);
  found.squares = search.fnorm() * search.fnorm();
  return found;
}

} // namespace palp
