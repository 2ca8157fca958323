#include "solver/batch/ForcePolynomial.h"

#include "model/base/Monomials.h"

#include <Eigen/Dense>

#include <cassert>
#include <cmath>

namespace palp {

namespace {

double radicalInverse(int index, int base) {
  double value = 0, digit = 1;
  for (; index > 0; index /= base) {
    digit /= base;
    value += digit * (index % base);
  }
  return value;
}

} // namespace

ForcePolynomial::ForcePolynomial(const ForceRange& range, int degree)
    : scale_(range.low_N.cwiseAbs().cwiseMax(range.high_N.cwiseAbs())), exponents_(monomialExponents(3, 1, degree)) {
  for (int d = 0; d < 3; ++d)
    if (scale_(d) == 0) scale_(d) = 1;
}

Eigen::VectorXd ForcePolynomial::monomials(const Eigen::Vector3d& force_N) const {
  Eigen::VectorXd values(terms());
  for (int t = 0; t < terms(); ++t) {
    values(t) = 1;
    for (int d = 0; d < 3; ++d)
      for (int k = 0; k < exponents_(d, t); ++k) values(t) *= force_N(d) / scale_(d);
  }
  return values;
}

Eigen::MatrixXd ForcePolynomial::fit(const std::vector<Eigen::Vector3d>& forces_N) const {
  assert(static_cast<int>(forces_N.size()) >= terms() && "least squares need a force for each term");
  const auto count = static_cast<Eigen::Index>(forces_N.size());
  Eigen::MatrixXd M(count, terms());
  for (Eigen::Index i = 0; i < count; ++i) M.row(i) = monomials(forces_N[i]).transpose();
  return M.completeOrthogonalDecomposition().pseudoInverse().transpose();
}

bool inRange(const ForceRange& range, const Eigen::Vector3d& force_N) {
  return (force_N.array() >= range.low_N.array()).all() && (force_N.array() <= range.high_N.array()).all();
}

bool onOneArea(const LoadCase& load, const ForceRange& range) {
  return load.areas.size() == 1 && load.patches.empty() && load.indenters.empty() &&
         inRange(range, load.areas.front().force_N);
}

Eigen::Vector3d coveringForce(const ForceRange& range, int index) {
  Eigen::Vector3d share;
  for (int d = 0; d < 3; ++d)
    share(d) = index < 8 ? double(index >> d & 1) : radicalInverse(index - 7, d == 0 ? 2 : d == 1 ? 3 : 5);
  return range.low_N + share.cwiseProduct(range.high_N - range.low_N);
}

} // namespace palp
