#pragma once

#include "model/LoadCase.h"

#include <Eigen/Core>

#include <vector>

namespace palp {

/// Monomials of a force of degrees 1 to `degree` (no constant: no force, no answer), each component scaled by the
/// largest of its range.
class ForcePolynomial {
public:
  ForcePolynomial(const ForceRange& range, int degree);

  [[nodiscard]] int terms() const { return static_cast<int>(exponents_.cols()); }
  [[nodiscard]] Eigen::VectorXd monomials(const Eigen::Vector3d& force_N) const;
  /// Least squares: coefficients = values * this (points x terms), where column i of values belongs to force i.
  [[nodiscard]] Eigen::MatrixXd fit(const std::vector<Eigen::Vector3d>& forces_N) const;

private:
  Eigen::Vector3d scale_;
  Eigen::MatrixXi exponents_; ///< 3 x terms
};

/// Whether a force lies in the range.
bool inRange(const ForceRange& range, const Eigen::Vector3d& force_N);

/// Whether the load is one force on one area, in the range, and nothing else, so that a polynomial of an area applies.
bool onOneArea(const LoadCase& load, const ForceRange& range);

/// Forces that cover the range: its 8 corners, then Halton's sequence.
Eigen::Vector3d coveringForce(const ForceRange& range, int index);

} // namespace palp
