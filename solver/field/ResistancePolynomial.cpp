#include "solver/field/ResistancePolynomial.h"

#include <algorithm>

namespace palp {

namespace {

constexpr int keptStates = 3;
constexpr double statesATerm = 1.3; // least squares of a polynomial on scattered points

} // namespace

int ResistancePolynomial::statesFor(const ForceRange& range, int degree) {
  return static_cast<int>(statesATerm * ForcePolynomial(range, degree).terms()) + 1 + keptStates;
}

ResistancePolynomial::ResistancePolynomial(const ForceRange& range, int degree,
                                           const std::vector<Eigen::Vector3d>& forces_N, const Eigen::MatrixXd& changes)
    : polynomial_(range, degree) {
  const Eigen::Index fitted = changes.cols() - keptStates;
  coefficients_ = changes.leftCols(fitted) * polynomial_.fit({forces_N.begin(), forces_N.begin() + fitted});
  for (Eigen::Index i = fitted; i < changes.cols(); ++i)
    if (const double norm = changes.col(i).norm(); norm > 0)
      error_ = std::max(error_, (at(forces_N[static_cast<std::size_t>(i)]) - changes.col(i)).norm() / norm);
}

} // namespace palp
