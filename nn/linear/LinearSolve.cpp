#include "nn/linear/LinearSolve.h"

#include "model/base/Cancelled.h"
#include "nn/NetworkError.h"
#include "nn/baselines/RecursiveLeastSquares.h"
#include "nn/linear/Lapack.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace palp {
namespace {

/// The smallest ridge of Cholesky's factorisation: below it, rounding makes Gaussian kernels indefinite.
constexpr double kCholeskyRidge = 1e-12;
/// Start of P in recursive least squares: weights of order 1e3 are as good as free.
constexpr double kRecursiveStart = 1e6;

std::string shortNumber(double value) {
  std::ostringstream out;
  out.precision(2);
  out << value;
  return out.str();
}

void warnOfCondition(LinearSolution& solution) {
  if (!(solution.condition > 1e12)) return;
  const double lost = std::min(16.0, std::floor(std::log10(solution.condition)));
  solution.warnings.push_back("the system's condition is " + shortNumber(solution.condition) + ": about " +
                              std::to_string(static_cast<int>(lost)) +
                              " of 16 digits of the weights are lost; a smaller spread or a ridge avoids this");
}

void warnOfRank(LinearSolution& solution, Eigen::Index unknowns) {
  if (solution.rank < unknowns)
    solution.warnings.push_back(std::to_string(unknowns - solution.rank) + " of " + std::to_string(unknowns) +
                                " directions were dropped as linearly dependent to rounding");
}

LinearSolution byQr(Eigen::MatrixXd a, const Eigen::MatrixXd& b, double rcond, std::size_t fixed = 0) {
  const Eigen::Index unknowns = a.cols();
  const lapack::PivotedQr qr(std::move(a), fixed);
  LinearSolution solution;
  const Eigen::Index rank = qr.rank(rcond);
  solution.x = qr.solve(b, rank);
  solution.rank = static_cast<int>(rank);
  solution.condition = qr.condition();
  warnOfCondition(solution);
  warnOfRank(solution, unknowns);
  return solution;
}

/// Column-pivoted QR of a semidefinite matrix given by its lower triangle. The pivots of Cholesky's factorisation
/// reveal its rank as well as the norms of its columns do (what they leave bounds what those leave), and cost a third.
LinearSolution bySemidefiniteQr(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double rcond,
                                const std::stop_token& stop) {
  Eigen::MatrixXd columns = a;
  std::vector<int> order = lapack::semidefinitePivots(columns);
  throwIfStopped(stop);
  const std::size_t fixed = order.size();
  std::vector<bool> taken(static_cast<std::size_t>(a.cols()), false);
  for (const int i : order) taken[static_cast<std::size_t>(i)] = true;
  for (int i = 0; i < a.cols(); ++i)
    if (!taken[static_cast<std::size_t>(i)]) order.push_back(i);
  for (Eigen::Index k = 0; k < a.cols(); ++k) {
    const int i = order[static_cast<std::size_t>(k)];
    columns.col(k).head(i) = a.row(i).head(i).transpose();
    columns.col(k).tail(a.rows() - i) = a.col(i).tail(a.rows() - i);
  }
  LinearSolution solution = byQr(std::move(columns), b, rcond, fixed);
  const Eigen::MatrixXd x = solution.x;
  for (Eigen::Index k = 0; k < a.cols(); ++k) solution.x.row(order[static_cast<std::size_t>(k)]) = x.row(k);
  return solution;
}

/// R of A = Q R without pivoting, and what of Q^T b belongs to it: the same least squares in few rows.
struct Triangular {
  Eigen::MatrixXd r;
  Eigen::MatrixXd right;
};

/// Block of rows after block of rows, so that it can be stopped; twice as fast as pivoting over all rows.
Triangular triangular(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const std::stop_token& stop) {
  const Eigen::Index columns = a.cols();
  Triangular result{Eigen::MatrixXd::Zero(columns, columns), Eigen::MatrixXd::Zero(columns, b.cols())};
  const Eigen::Index step = std::max<Eigen::Index>(1, 2 * columns);
  for (Eigen::Index first = 0; first < a.rows(); first += step) {
    throwIfStopped(stop);
    const Eigen::Index rows = std::min(step, a.rows() - first);
    Eigen::MatrixXd stacked(columns + rows, columns), right(columns + rows, b.cols());
    stacked << result.r, a.middleRows(first, rows);
    right << result.right, b.middleRows(first, rows);
    const lapack::PivotedQr qr(std::move(stacked), static_cast<std::size_t>(columns));
    result = {qr.r(), qr.applyQTransposed(std::move(right)).topRows(columns)};
  }
  return result;
}

/// Raises the ridge tenfold until the factorisation goes through.
LinearSolution byCholesky(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double ridge) {
  LinearSolution solution;
  Eigen::MatrixXd factor;
  for (;; ridge *= 10) {
    factor = a;
    factor.diagonal().array() += ridge;
    if (lapack::choleskyInPlace(factor)) break;
    if (!(ridge < std::numeric_limits<double>::max() / 100))
      throw NetworkError("Cholesky found no factor at any ridge: the samples are too large for double precision");
  }
  solution.x = lapack::solveLower(factor, lapack::solveLower(factor, b, false), true);
  solution.ridge = ridge;
  solution.rank = static_cast<int>(a.cols());
  if (a.cols() > 0) solution.condition = std::pow(factor.diagonal().maxCoeff() / factor.diagonal().minCoeff(), 2);
  warnOfCondition(solution);
  return solution;
}

} // namespace

double smallestRidge(double size) {
  return 4 * std::numeric_limits<double>::epsilon() * size;
}

LinearSolution solveSymmetric(Eigen::MatrixXd a, const Eigen::MatrixXd& b, LeastSquaresMethod method, double ridge,
                              double rcond, const std::stop_token& stop) {
  throwIfStopped(stop);
  if (method == LeastSquaresMethod::Cholesky) {
    const double used = std::max(ridge, kCholeskyRidge);
    LinearSolution solution = byCholesky(a, b, used);
    if (solution.ridge > used)
      solution.warnings.push_back("the ridge was raised to " + shortNumber(solution.ridge) +
                                  ", the smallest at which Cholesky's factorisation exists in double precision");
    return solution;
  }
  a.diagonal().array() += ridge;
  if (method == LeastSquaresMethod::PivotedQr) {
    LinearSolution solution = bySemidefiniteQr(a, b, rcond, stop);
    solution.ridge = ridge;
    return solution;
  }
  // Truncated: x = V diag(1 / l) V^T b over the eigenvalues |l| > rcond max |l|.
  const Eigen::Index unknowns = a.cols();
  const lapack::SymmetricEigen eigen = lapack::symmetricEigen(std::move(a));
  LinearSolution solution;
  solution.ridge = ridge;
  const double largest = unknowns == 0 ? 0 : eigen.values.cwiseAbs().maxCoeff();
  const Eigen::VectorXd inverse =
      eigen.values.unaryExpr([&](double v) { return std::abs(v) > rcond * largest ? 1 / v : 0.0; });
  solution.x = lapack::product(eigen.vectors, false,
                               inverse.asDiagonal() * lapack::product(eigen.vectors, true, b, false), false);
  solution.rank = static_cast<int>((inverse.array() != 0).count());
  solution.condition = unknowns == 0 ? 1 : largest / eigen.values.cwiseAbs().minCoeff();
  warnOfCondition(solution);
  warnOfRank(solution, unknowns);
  return solution;
}

LinearSolution solveLeastSquares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, LeastSquaresMethod method,
                                 double ridge, double rcond, double forgetting, const std::stop_token& stop) {
  LinearSolution solution;
  if (method == LeastSquaresMethod::PivotedQr && a.rows() > 3 * a.cols()) {
    const Triangular tall = triangular(a, b, stop);
    return solveLeastSquares(tall.r, tall.right, method, ridge, rcond, forgetting, stop);
  }
  if (method == LeastSquaresMethod::PivotedQr && ridge == 0) return byQr(a, b, rcond);
  if (method == LeastSquaresMethod::PivotedQr) {
    // |a x - b|^2 + ridge |x|^2 = |[a; sqrt(ridge) I] x - [b; 0]|^2
    Eigen::MatrixXd stacked = Eigen::MatrixXd::Zero(a.rows() + a.cols(), a.cols());
    stacked.topRows(a.rows()) = a;
    stacked.bottomRows(a.cols()).diagonal().setConstant(std::sqrt(ridge));
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(stacked.rows(), b.cols());
    right.topRows(a.rows()) = b;
    solution = byQr(std::move(stacked), right, rcond);
    solution.ridge = ridge;
  } else if (method == LeastSquaresMethod::Cholesky) {
    // The normal equations (a^T a + ridge I) x = a^T b.
    const Eigen::MatrixXd normal = lapack::gram(a, stop);
    throwIfStopped(stop);
    const double largest = a.cols() == 0 ? 0 : normal.diagonal().sum();
    solution = byCholesky(normal, lapack::product(a, true, b, false),
                          std::max({ridge, kCholeskyRidge, smallestRidge(largest)}));
  } else if (method == LeastSquaresMethod::TruncatedSvd) {
    // x = V diag(s / (s^2 + ridge)) U^T b over the singular values s > rcond s1 (G. H. Golub, C. F. Van Loan, Matrix
    // Computations, 4th ed. 2013, 5.5.5 and 6.1.4).
    const lapack::ThinSvd svd = lapack::thinSvd(a);
    const double largest = svd.values.size() == 0 ? 0 : svd.values(0);
    const Eigen::VectorXd filter =
        svd.values.unaryExpr([&](double s) { return s > rcond * largest ? s / (s * s + ridge) : 0.0; });
    solution.x =
        lapack::product(svd.vTransposed, true, filter.asDiagonal() * lapack::product(svd.u, true, b, false), false);
    solution.ridge = ridge;
    solution.rank = static_cast<int>((filter.array() != 0).count());
    solution.condition = svd.values.size() == 0 ? 1 : largest / svd.values.minCoeff();
    warnOfCondition(solution);
    warnOfRank(solution, a.cols());
  } else {
    RecursiveLeastSquares recursive(a.cols(), b.cols(), ridge > 0 ? 1 / ridge : kRecursiveStart, forgetting);
    for (Eigen::Index i = 0; i < a.rows(); ++i) recursive.update(a.row(i).transpose(), b.row(i).transpose());
    solution.x = recursive.weights();
    solution.ridge = ridge > 0 ? ridge : 1 / kRecursiveStart;
    solution.rank = static_cast<int>(std::min(a.rows(), a.cols()));
    solution.condition = lapack::PivotedQr(a).condition();
    warnOfCondition(solution);
  }
  return solution;
}

} // namespace palp
