#pragma once

#include <Eigen/Core>

namespace palp {

/// Exponents (variables x terms) of all monomials of degrees `lowest` to `highest`, by ascending degree; within a
/// degree the powers of the first variables descend: x^2, x y, y^2.
Eigen::MatrixXi monomialExponents(Eigen::Index variables, int lowest, int highest);

} // namespace palp
