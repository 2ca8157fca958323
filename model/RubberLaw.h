#pragma once

#include "model/base/NamedEnum.h"

#include <Eigen/Core>

#include <variant>
#include <vector>

namespace palp {

// Laws of rubber by their isochoric energy W [MPa]: I1, I2 are the invariants of the isochoric right Cauchy-Green
// tensor J^(-2/3) C, l1, l2, l3 the isochoric principal stretches. The volumetric energy is the same for all
// (Material). The element kernels have the laws of their own (solver/element/kernels/RubberLaws.h, OgdenPoint.h).

/// W = c10 (I1 - 3) + c01 (I2 - 3). The defaults are the paper's (section 3).
struct MooneyRivlin {
  double c10_MPa = 0.3286;
  double c01_MPa = 0.08215;
  bool operator==(const MooneyRivlin&) const = default;
};

/// W = c10 (I1 - 3).
struct NeoHooke {
  double c10_MPa = 0.41075;
  bool operator==(const NeoHooke&) const = default;
};

/// W = c10 (I1 - 3) + c20 (I1 - 3)^2 + c30 (I1 - 3)^3.
struct Yeoh {
  double c10_MPa = 0.41075;
  double c20_MPa = 0;
  double c30_MPa = 0;
  bool operator==(const Yeoh&) const = default;
};

/// W = -(mu jm / 2) ln(1 - (I1 - 3) / jm): the rubber locks as I1 - 3 approaches jm.
struct Gent {
  double mu_MPa = 0.8215;
  double jm = 30;
  bool operator==(const Gent&) const = default;
};

/// W = sum over 1 to 3 terms of (2 mu / alpha^2) (l1^alpha + l2^alpha + l3^alpha - 3), as in Abaqus and CalculiX; other
/// authors (Ogden 1972, ANSYS) print mu' / alpha with mu' = 2 mu / alpha.
struct Ogden {
  std::vector<double> mu_MPa{0.8215};
  std::vector<double> alpha{2};
  bool operator==(const Ogden&) const = default;
};
inline constexpr std::size_t kMostOgdenTerms = 3;

using RubberLaw = std::variant<MooneyRivlin, NeoHooke, Yeoh, Gent, Ogden>;

/// The alternatives of RubberLaw in their order, as named in design files.
enum class RubberLawKind { MooneyRivlin, NeoHooke, Yeoh, Gent, Ogden };
constexpr NamedEnum kRubberLaws("law", std::array{std::pair{RubberLawKind::MooneyRivlin, "mooney-rivlin"},
                                                  std::pair{RubberLawKind::NeoHooke, "neo-hooke"},
                                                  std::pair{RubberLawKind::Yeoh, "yeoh"},
                                                  std::pair{RubberLawKind::Gent, "gent"},
                                                  std::pair{RubberLawKind::Ogden, "ogden"}});
[[nodiscard]] RubberLawKind kindOf(const RubberLaw& law);
/// "Mooney-Rivlin", "Yeoh", ...: for messages and reports.
[[nodiscard]] std::string titleOf(RubberLawKind kind);

/// Shear modulus at rest [MPa].
[[nodiscard]] double shearModulus_MPa(const RubberLaw& law);

/// The law with all stresses times the factor.
[[nodiscard]] RubberLaw timesStress(RubberLaw law, double factor);

/// W [MPa] of three stretches whose product is 1; not a number beyond the limit of Gent's law.
[[nodiscard]] double energy_MPa(const RubberLaw& law, const Eigen::Vector3d& stretches);

/// l_i dW/dl_i [MPa] of three stretches whose product is 1: the principal Cauchy stresses but for a common pressure;
/// not a number beyond the limit of Gent's law.
[[nodiscard]] Eigen::Vector3d principalStresses_MPa(const RubberLaw& law, const Eigen::Vector3d& stretches);

/// Tests of incompressible rubber, the free directions without stress: pulled along one direction; along two alike;
/// along one with the second held ("pure shear" of a wide strip).
enum class TestMode { Uniaxial, Equibiaxial, Planar };
constexpr NamedEnum kTestModes("mode", std::array{std::pair{TestMode::Uniaxial, "uniaxial"},
                                                  std::pair{TestMode::Equibiaxial, "equibiaxial"},
                                                  std::pair{TestMode::Planar, "planar"}});

/// The principal stretches of a test at a stretch, the driven direction first.
[[nodiscard]] Eigen::Vector3d testStretches(TestMode mode, double stretch);

/// Nominal stress (force over the area at rest) along the driven direction [MPa].
[[nodiscard]] double nominalStress_MPa(const RubberLaw& law, TestMode mode, double stretch);

/// The range of stretches around 1 in which the law is stable in a test (Drucker: an increment of strain in any
/// directions costs work), searched from `least` to `most`.
struct StableRange {
  double least = 1;
  double most = 1;
};
[[nodiscard]] StableRange stableRange(const RubberLaw& law, TestMode mode, double least, double most);

} // namespace palp
