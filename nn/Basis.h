#pragma once

#include <Eigen/Core>

#include <string>

namespace palp {

/// What a spread means. The two differ by a factor in spread only: sigma = spread / sqrt(2 ln 2) = 0.849 spread.
enum class SpreadConvention {
  Radbas, ///< MATLAB's radbas: phi(r) = exp(-ln2 (r/spread)^2), half height at r = spread
  Sigma,  ///< phi(r) = exp(-r^2 / (2 spread^2))
};

/// The convention's name as in files: radbas, sigma.
std::string name(SpreadConvention convention);
/// Throws NetworkError where no convention has this name.
SpreadConvention spreadConventionNamed(const std::string& name);

/// gamma of phi(r) = exp(-gamma r^2).
double gaussianRate(double spread, SpreadConvention convention);

/// |a_i - b_j|^2, columns of a x columns of b.
Eigen::MatrixXd squaredDistances(const Eigen::Ref<const Eigen::MatrixXd>& a,
                                 const Eigen::Ref<const Eigen::MatrixXd>& b);

/// exp(-gamma r^2) for each entry of `squaredDistance`, in place.
void gaussianInPlace(Eigen::Ref<Eigen::MatrixXd> squaredDistance, double gamma);

} // namespace palp
