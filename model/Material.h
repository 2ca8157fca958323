#pragma once

#include "model/RubberLaw.h"

namespace palp {

/// Rubber: the isochoric energy of its law and, for every law, (1/d) (J - 1)^2 with d = 2 / kappa and
/// kappa = mu / (1 - 2 nu), mu the shear modulus at rest; for Mooney-Rivlin d = (1 - 2 nu) / (c10 + c01), as in ANSYS.
/// The defaults are the paper's (section 3).
struct Material {
  RubberLaw law;
  double poissonRatio = 0.499; ///< as entered, in ANSYS's sense; 0.5 is incompressible
  double density_t_per_mm3 = 1e-9;

  /// mu, the shear modulus at rest [MPa].
  [[nodiscard]] double shearModulus_MPa() const;
  /// kappa = 2/d = mu / (1 - 2 nu) [MPa]; infinite for nu = 0.5.
  [[nodiscard]] double bulkModulus_MPa() const;
  /// 1/kappa [1/MPa]; 0 for nu = 0.5. The mixed elements use this one.
  [[nodiscard]] double compressibility_per_MPa() const;
  /// Poisson's ratio of the linear limit, (3 kappa - 2 mu) / (2 (3 kappa + mu)): differs from the entered one away from
  /// 0.5.
  [[nodiscard]] double smallStrainPoissonRatio() const;
  /// Young's modulus of the linear limit, 2 mu (1 + nu) with the small-strain nu [MPa].
  [[nodiscard]] double smallStrainYoung_MPa() const;
  bool operator==(const Material&) const = default;
};

} // namespace palp
