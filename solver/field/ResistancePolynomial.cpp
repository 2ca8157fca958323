#include "solver/field/ResistancePolynomial.h"

#include <algorithm>
#include <array>

namespace palp {

namespace {

constexpr int keptStates = 3;
/// States fitted for degrees 2, 3, 4 with 9, 19, 34 terms. On held-out forces a cubic fitted to 20 states has at most
/// twice the error of one fitted to 25; a pressure law's kink needs the fourth degree, and more states.
constexpr std::array<int, 3> fittedStates{12, 20, 45};

} // namespace

int ResistancePolynomial::statesFor(int degree) {
  return fittedStates[static_cast<std::size_t>(degree - lowestDegree)] + keptStates;
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
