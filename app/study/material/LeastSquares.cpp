#include "app/study/material/LeastSquares.h"

#include "model/base/PositiveSolve.h"

#include <Eigen/QR>

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

Minimum levenbergMarquardt(const Eigen::VectorXd& start, const ResidualsOf& residuals,
                           const std::function<bool(const Eigen::VectorXd&)>& allowed) {
  constexpr int iterations = 200;
  constexpr double ends = 1e-12; // relative change of the squares
  Minimum now{start, residuals(start).squaredNorm()};
  if (!std::isfinite(now.squares)) now.squares = std::numeric_limits<double>::infinity();
  double damping = 1e-3;
  for (int k = 0; k < iterations && std::isfinite(now.squares); ++k) {
    Eigen::VectorXd lengths;
    const Eigen::MatrixXd J = normalised(differences(now.at, residuals), lengths);
    if (!J.allFinite()) break;
    const Eigen::VectorXd gradient = J.transpose() * residuals(now.at);
    bool better = false;
    const double before = now.squares;
    for (int trial = 0; trial < 20 && !better; ++trial) {
      Eigen::MatrixXd squares = J.transpose() * J;
      squares.diagonal().array() += damping;
      const auto factor = positiveFactor(squares);
      if (!factor) return now;
      const Eigen::VectorXd next = now.at - factor->solve(gradient).cwiseQuotient(lengths);
      const double at = allowed(next) ? residuals(next).squaredNorm() : std::numeric_limits<double>::infinity();
      better = at < now.squares; // false for not a number
      if (better) now = {next, at};
      damping *= better ? 0.3 : 4;
    }
    if (!better || before - now.squares < ends * before) break;
  }
  return now;
}

} // namespace palp
