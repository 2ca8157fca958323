#include "model/Material.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palp {
namespace {

constexpr double kRounding = 1e-12; // of a handful of operations

TEST(Material, HasThePapersDerivedConstants) {
  const Material paper;
  EXPECT_NEAR(paper.shearModulus_MPa(), 0.8215, 0.8215 * kRounding);
  // 1 - 2 nu loses three digits to cancellation at nu = 0.499
  EXPECT_NEAR(paper.bulkModulus_MPa(), 410.75, 410.75 * kRounding * 1e3);
  EXPECT_NEAR(paper.smallStrainYoung_MPa(), 2.46286, 5e-6);       // printed with six digits
  EXPECT_NEAR(paper.smallStrainPoissonRatio(), 0.49900067, 5e-9); // printed with eight digits
}

TEST(Material, CompressibilityIsTheInverseOfTheBulkModulus) {
  for (const double nu : {0.0, 0.3, 0.49, 0.499, 0.4999999}) {
    const Material material{MooneyRivlin{0.3286, 0.08215}, nu};
    EXPECT_NEAR(material.compressibility_per_MPa() * material.bulkModulus_MPa(), 1, kRounding) << nu;
    EXPECT_NEAR(material.bulkModulus_MPa() * (1 - 2 * nu), material.shearModulus_MPa(), kRounding) << nu;
  }
}

TEST(Material, IsIncompressibleAtOneHalf) {
  const Material material{MooneyRivlin{0.3286, 0.08215}, 0.5};
  EXPECT_EQ(material.compressibility_per_MPa(), 0);
  EXPECT_TRUE(std::isinf(material.bulkModulus_MPa()));
  EXPECT_EQ(material.smallStrainPoissonRatio(), 0.5);
  EXPECT_NEAR(material.smallStrainYoung_MPa(), 3 * material.shearModulus_MPa(), kRounding);
}

TEST(Material, SmallStrainPoissonRatioLeavesTheEnteredOneAwayFromOneHalf) {
  EXPECT_NEAR((Material{MooneyRivlin{0.3286, 0.08215}, 0.3}).smallStrainPoissonRatio(), 0.324,
              5e-4); // printed with three digits
  EXPECT_NEAR((Material{MooneyRivlin{0.3286, 0.08215}, 0.0}).smallStrainPoissonRatio(), 0.125, kRounding);
}

TEST(Material, ModuliObeyTheRelationsOfLinearElasticity) {
  for (const double nu : {0.0, 0.2, 0.45, 0.499}) {
    const Material material{MooneyRivlin{1.5, 0.25}, nu};
    const double E = material.smallStrainYoung_MPa();
    const double v = material.smallStrainPoissonRatio();
    EXPECT_NEAR(E / (2 * (1 + v)), material.shearModulus_MPa(), kRounding * 10) << nu;
    // 1 - 2 v cancels near one half
    EXPECT_NEAR(E / (3 * (1 - 2 * v)) / material.bulkModulus_MPa(), 1, 1e-9) << nu;
  }
}

} // namespace
} // namespace palp
