#pragma once

#include "model/base/NamedEnum.h"

#include <Eigen/Core>

#include <stop_token>
#include <string>

namespace palp {

/// What a spread means. The two differ by a factor in spread only: sigma = spread / sqrt(2 ln 2) = 0.849 spread.
enum class SpreadConvention {
  Radbas, ///< MATLAB's radbas: phi(r) = exp(-ln2 (r/spread)^2), half height at r = spread
  Sigma,  ///< phi(r) = exp(-r^2 / (2 spread^2))
};

inline constexpr NamedEnum kSpreadConventions("spread convention",
                                              std::array{std::pair{SpreadConvention::Radbas, "radbas"},
                                                         std::pair{SpreadConvention::Sigma, "sigma"}});
inline std::string name(SpreadConvention convention) {
  return kSpreadConventions.name(convention);
}

/// How the basis is written. With an exact linear tail the weights are orthogonal to 1 and to the inputs. So
/// 1 - gamma r^2 can be subtracted from the Gaussian without changing the network's function (only its bias), and the
/// remainder keeps its digits when the spread is large and all Gaussians are close to 1.
enum class BasisForm {
  Gaussian,  ///< exp(-gamma r^2)
  Remainder, ///< exp(-gamma r^2) - 1 + gamma r^2
};
inline constexpr NamedEnum kBasisForms("basis", std::array{std::pair{BasisForm::Gaussian, "gaussian"},
                                                           std::pair{BasisForm::Remainder, "remainder"}});
inline std::string name(BasisForm form) {
  return kBasisForms.name(form);
}

/// gamma of phi(r) = exp(-gamma r^2).
double gaussianRate(double spread, SpreadConvention convention);

/// |a_i - b_j|^2, columns of a x columns of b. Throws Cancelled between blocks of columns of a.
Eigen::MatrixXd squaredDistances(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b,
                                 const std::stop_token& stop = {});

/// |a_i - a_j|^2 in the lower triangle, 0 above.
Eigen::MatrixXd squaredDistances(const Eigen::Ref<const Eigen::MatrixXd>& a);

/// The basis at each entry of `squaredDistance`, in place.
void basisInPlace(Eigen::Ref<Eigen::MatrixXd> squaredDistance, double gamma, BasisForm form = BasisForm::Gaussian);

} // namespace palp
