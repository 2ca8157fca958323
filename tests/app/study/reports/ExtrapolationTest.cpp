#include "app/study/reports/errortime/Extrapolation.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

TEST(Extrapolation, NeverUsesAMeshWithoutAnAnswer) {
  const auto answer = [](double error) { return Eigen::VectorXd(Eigen::VectorXd::Constant(2, 1 + error)); };
  const Eigen::VectorXd none;
  // Errors of second order on meshes whose sizes halve, so that Richardson's answer is 1 to rounding.
  const auto all = extrapolated({answer(16), answer(4), answer(1), answer(0.25)}, 2);
  const auto withoutFinest = extrapolated({answer(16), answer(4), answer(1), none}, 2);
  ASSERT_TRUE(all && withoutFinest);
  EXPECT_NEAR(all->value(0), 1, 1e-12);
  EXPECT_NEAR(withoutFinest->value(0), 1, 1e-12);
  EXPECT_FALSE(extrapolated({answer(16), none, answer(1), answer(0.25)}, 2)) << "no three neighbours";
  EXPECT_FALSE(extrapolated({answer(1), answer(0.25)}, 2));
}

} // namespace
} // namespace palp
