#include "model/RubberLaw.h"

#include "model/MaterialCheck.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palp {
namespace {

const Yeoh kYeoh{0.2, 0.03, 0.002};
const Ogden kOgden{{0.4, 0.02}, {2, 5}};
const Gent kGent{0.4, 12};
const MooneyRivlin kMooney{0.15, 0.05};
const std::vector<RubberLaw> kLaws{kMooney, NeoHooke{0.2}, kYeoh, kGent, kOgden};
constexpr double kTenDigits = 6e-10; // half a unit of the tenth digit of numbers up to 10

struct PrintedStress {
  RubberLaw law;
  TestMode mode;
  double stretch, nominal_MPa, energy_MPa;
};

/// Calculated apart from this program, in 30 digits, printed with ten.
const PrintedStress kPrinted[] = {
    {kYeoh, TestMode::Uniaxial, 0.7, -0.5941200596, 0.07312748342},
    {kYeoh, TestMode::Uniaxial, 1.3, 0.3031751122, 0.04728199688},
    {kYeoh, TestMode::Uniaxial, 2, 1.204, 0.536},
    {kYeoh, TestMode::Equibiaxial, 0.7, -3.741082749, 0.5867446616},
    {kYeoh, TestMode::Equibiaxial, 1.3, 0.5091641916, 0.1627966},
    {kYeoh, TestMode::Equibiaxial, 2, 2.588998535, 2.040859863},
    {kYeoh, TestMode::Planar, 0.7, -1.03479139, 0.1149153764},
    {kYeoh, TestMode::Planar, 1.3, 0.367298521, 0.05876882816},
    {kYeoh, TestMode::Planar, 2, 1.37015625, 0.62465625},
    {kOgden, TestMode::Uniaxial, 0.7, -0.5622827827, 0.07270305802},
    {kOgden, TestMode::Uniaxial, 1.3, 0.3029687526, 0.04849369727},
    {kOgden, TestMode::Uniaxial, 2, 0.8272928932, 0.4469656854},
    {kOgden, TestMode::Equibiaxial, 0.7, -2.502626579, 0.4813662105},
    {kOgden, TestMode::Equibiaxial, 1.3, 0.4346707816, 0.1532229964},
    {kOgden, TestMode::Equibiaxial, 2, 0.9154960938, 1.110101562},
    {kOgden, TestMode::Planar, 0.7, -0.952258836, 0.1127520202},
    {kOgden, TestMode::Planar, 1.3, 0.3591249361, 0.05951480979},
    {kOgden, TestMode::Planar, 2, 0.877875, 0.49805},
};

TEST(RubberLaw, HasThePrintedStressesAndEnergies) {
  for (const auto& [law, mode, stretch, nominal, energy] : kPrinted) {
    EXPECT_NEAR(nominalStress_MPa(law, mode, stretch), nominal, kTenDigits) << law.index() << " at " << stretch;
    EXPECT_NEAR(energy_MPa(law, testStretches(mode, stretch)), energy, kTenDigits) << law.index() << " at " << stretch;
  }
}

TEST(RubberLaw, GivesTheUniaxialStressesOfTextbooks) {
  for (const double l : {0.7, 1.3, 2.0}) {
    const double s = l * l + 2 / l - 3, geometry = 2 * (l - 1 / (l * l));
    EXPECT_NEAR(nominalStress_MPa(kMooney, TestMode::Uniaxial, l), geometry * (0.15 + 0.05 / l), 1e-14);
    EXPECT_NEAR(nominalStress_MPa(NeoHooke{0.2}, TestMode::Uniaxial, l), geometry * 0.2, 1e-14);
    EXPECT_NEAR(nominalStress_MPa(kGent, TestMode::Uniaxial, l), geometry * 0.2 * 12 / (12 - s), 1e-14);
  }
}

TEST(RubberLaw, StressesAreTheDerivativesOfTheEnergy) {
  constexpr double h = 1e-6; // central differences: h^2 and rounding over h, together about 1e-10
  const Eigen::Vector3d at(1.4, 0.9, 1 / (1.4 * 0.9));
  for (const RubberLaw& law : kLaws) {
    const Eigen::Vector3d stresses = principalStresses_MPa(law, at);
    const auto moved = [&](double by) { // along ln l_1 - ln l_2, which keeps the volume
      return energy_MPa(law, at.cwiseProduct(Eigen::Vector3d(std::exp(by), std::exp(-by), 1)));
    };
    EXPECT_NEAR(stresses(0) - stresses(1), (moved(h) - moved(-h)) / (2 * h), 1e-9) << law.index();
  }
}

TEST(RubberLaw, HasItsShearModulusAtRest) {
  constexpr double strain = 1e-6;
  for (const RubberLaw& law : kLaws) {
    EXPECT_NEAR(nominalStress_MPa(law, TestMode::Uniaxial, 1 + strain) / (3 * strain), shearModulus_MPa(law), 1e-5)
        << law.index();
    EXPECT_NEAR(shearModulus_MPa(timesStress(law, 3)), 3 * shearModulus_MPa(law), 1e-14);
  }
}

TEST(RubberLaw, OgdenWithExponentsTwoAndMinusTwoIsMooneyRivlin) {
  const Ogden ogden{{0.3, 0.1}, {2, -2}}; // mu = 2 c10, 2 c01
  for (const double l : {0.5, 0.9, 1.7})
    EXPECT_NEAR(nominalStress_MPa(ogden, TestMode::Planar, l), nominalStress_MPa(kMooney, TestMode::Planar, l), 1e-14);
}

TEST(RubberLaw, OfGentLocks) {
  EXPECT_GT(nominalStress_MPa(kGent, TestMode::Uniaxial, 3.7), 20 * nominalStress_MPa(kGent, TestMode::Uniaxial, 2));
  EXPECT_TRUE(std::isnan(nominalStress_MPa(kGent, TestMode::Uniaxial, 3.9)));     // I1 - 3 = 12.7 is beyond jm = 12
  EXPECT_NEAR(stableRange(kGent, TestMode::Uniaxial, 0.5, 10).most, 3.804, 0.02); // where l^2 + 2/l - 3 = 12
}

TEST(RubberLaw, OfANegativeC01IsStableInTensionAlone) {
  // Dragon Skin 10 fitted to tension: 2 (l - 1/l^2) (c10 + c01/l) turns around before l = -c01/c10 = 0.715.
  const MooneyRivlin tension{0.04908, -0.03511};
  const StableRange range = stableRange(tension, TestMode::Uniaxial, 0.3, 3);
  EXPECT_GT(range.least, 0.715);
  EXPECT_LT(range.least, 1);
  const auto warning = stabilityWarning({.law = tension});
  ASSERT_TRUE(warning);
  EXPECT_NE(warning->find("uniaxial"), std::string::npos) << *warning;
  EXPECT_FALSE(stabilityWarning(Material{}));
}

} // namespace
} // namespace palp
