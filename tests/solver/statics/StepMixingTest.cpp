#include "solver/statics/StepMixing.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace palp {
namespace {

/// z <- z + r(z) with r = M (z* - z): contracts as I - M does, slowly in one direction.
struct LinearIteration {
  Eigen::Vector3d rates{0.4, 0.55, 0.9}, goal{1, -2, 0.5};
  [[nodiscard]] Eigen::VectorXd direction(const Eigen::VectorXd& z) const { return rates.cwiseProduct(goal - z); }
};

TEST(StepMixing, EndsALinearIterationInAsManyStepsAsItHasRates) {
  const LinearIteration iteration;
  Eigen::VectorXd mixed = Eigen::Vector3d::Zero(), plain = mixed;
  LaneVector follows{0};
  StepMixing mixing;
  for (int k = 0; k < 5; ++k) {
    plain += iteration.direction(plain);
    Eigen::VectorXd step = iteration.direction(mixed);
    LaneVector along{step(0) - 3 * step(1)}; // a number that follows the others linearly
    mixing.mix(step, along);
    mixed += step;
    follows[0] += along[0];
  }
  EXPECT_LT((mixed - iteration.goal).norm(), 1e-8);
  EXPECT_GT((plain - iteration.goal).norm(), 1e-2);
  EXPECT_NEAR(follows[0], mixed(0) - 3 * mixed(1), 1e-12);
}

TEST(StepMixing, ForgetsWhatBelongsToAnotherIteration) {
  const LinearIteration iteration;
  const Eigen::VectorXd start = Eigen::Vector3d(0.3, 0.3, 0.3);
  StepMixing used, fresh;
  LaneVector none;
  for (const Eigen::Vector3d& z : {Eigen::Vector3d(5, 1, 0), Eigen::Vector3d(2, 2, 9)}) {
    Eigen::VectorXd step = iteration.direction(z);
    used.mix(step, none);
  }
  used.restart();
  Eigen::VectorXd a = iteration.direction(start), b = a;
  used.mix(a, none);
  fresh.mix(b, none);
  EXPECT_TRUE(a == b);
}

} // namespace
} // namespace palp
