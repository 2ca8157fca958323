#include <gtest/gtest.h>

#include <cmath>

// Compiled here once more, for the smallest instruction set: what the kernels say of their series holds.
#define PALP_KERNEL rootsOfTheTest
#define PALP_PACK 2
#include "solver/element/kernels/SingleTet.h"
#undef PALP_KERNEL
#undef PALP_PACK

namespace palp {
namespace {

double rootError(double J) {
  return std::abs(rootsOfTheTest::inverseCubeRoot(rootsOfTheTest::all(J))[0] * std::cbrt(J) - 1);
}

/// Relative to the root itself; the kernel gives the root less one.
double singleRootError(double J) {
  const auto less = static_cast<double>(
      rootsOfTheTest::inverseCubeRootLessOne(rootsOfTheTest::Single{} + static_cast<float>(J - 1))[0]);
  return std::abs((1 + less) * std::cbrt(1 + static_cast<double>(static_cast<float>(J - 1))) - 1);
}

TEST(InverseCubeRoot, IsAsGoodAsItsCommentSays) {
  for (double J = 0.12; J <= 6; J *= 1.01) EXPECT_LT(rootError(J), 2e-15) << J;
  for (const auto& [J, error] : {std::pair{0.1, 2e-14}, {8., 5e-11}, {10., 2.5e-8}, {0.05, 2.5e-8}})
    EXPECT_LT(rootError(J), error) << J;
}

TEST(InverseCubeRoot, InSinglePrecisionIsAsGoodAsItsCommentSays) {
  for (double J = 0.25; J <= 3.5; J *= 1.01) EXPECT_LT(singleRootError(J), 3e-7) << J;
  for (const auto& [J, error] : {std::pair{0.2, 5e-7}, {4., 5e-7}, {5., 1.5e-5}})
    EXPECT_LT(singleRootError(J), error) << J;
}

} // namespace
} // namespace palp
