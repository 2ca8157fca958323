#include "model/Material.h"

#include <limits>

namespace palp {

double Material::shearModulus_MPa() const {
  return palp::shearModulus_MPa(law);
}

double Material::compressibility_per_MPa() const {
  return (1 - 2 * poissonRatio) / shearModulus_MPa();
}

double Material::bulkModulus_MPa() const {
  const double compressibility = compressibility_per_MPa();
  return compressibility > 0 ? 1 / compressibility : std::numeric_limits<double>::infinity();
}

double Material::smallStrainPoissonRatio() const {
  const double ratio = shearModulus_MPa() * compressibility_per_MPa(); // mu / kappa
  return (3 - 2 * ratio) / (2 * (3 + ratio));
}

double Material::smallStrainYoung_MPa() const {
  return 2 * shearModulus_MPa() * (1 + smallStrainPoissonRatio());
}

} // namespace palp
