#include "solver/batch/LaneMixing.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace palp {
namespace {

constexpr int count = 40, followers = 7;

/// Lanes' fixed points of x -> x + (b - A x), A = 1 + a part that grows with the lane; followers go half of the way.
struct Lanes {
  std::vector<int> rows;
  std::vector<float> directions = std::vector<float>(std::size_t(count + 1) * batchLanes);
  LaneVector u = LaneVector(std::size_t(count) * batchLanes), x = LaneVector(std::size_t(followers) * batchLanes);
  std::array<double, batchLanes> scale{};
  LaneMixing mixing{count, followers, followers};

  Lanes() {
    for (int i = 0; i < count; ++i) rows.push_back(count - 1 - i);
    scale.fill(2);
  }
  static double slope(int i, int lane) { return 1 + 0.6 * std::sin(1. + i) * lane / batchLanes; }
  double residual(int i, int lane) const { return 1 + i - slope(i, lane) * u[std::size_t(i) * batchLanes + lane]; }
  void iterate() {
    LaneVector follow(x.size());
    for (int lane = 0; lane < batchLanes; ++lane) {
      for (int i = 0; i < count; ++i)
        directions[std::size_t(rows[i]) * batchLanes + lane] = static_cast<float>(residual(i, lane) / scale[lane]);
      for (int k = 0; k < followers; ++k)
        follow[(std::size_t(lane / lanes) * followers + k) * lanes + lane % lanes] = residual(k, lane) / 2;
    }
    mixing.moveLeading(rows, directions.data(), scale, u.data());
    for (int b = 0; b < batchLanes / lanes; ++b) {
      const std::size_t first = std::size_t(b) * followers * lanes;
      mixing.moveFollowing(b, 0, follow.data() + first, x.data() + first);
    }
  }
  double follower(int k, int lane) const {
    return x[(std::size_t(lane / lanes) * followers + k) * lanes + lane % lanes];
  }
};

/// One lane by the formulas of LaneMixing.h, in double.
Eigen::VectorXd byFormula(int lane, int iterations) {
  std::vector<Eigen::VectorXd> r, s;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(count);
  for (int k = 0; k < iterations; ++k) {
    Eigen::VectorXd now(count);
    for (int i = 0; i < count; ++i) now(i) = 1 + i - Lanes::slope(i, lane) * u(i);
    r.push_back(now);
    Eigen::VectorXd step = now;
    if (const int known = std::min(k, mixingDepth); known > 0) {
      Eigen::MatrixXd change(count, known), motion(count, known);
      for (int j = 0; j < known; ++j) {
        change.col(j) = r[k - j] - r[k - j - 1];
        motion.col(j) = s[k - j - 1] + change.col(j);
      }
      step -= motion * change.colPivHouseholderQr().solve(now);
    }
    s.push_back(step);
    u += step;
  }
  return u;
}

TEST(LaneMixing, StepsAreThoseOfTheFormula) {
  Lanes some;
  for (int lane = 0; lane < batchLanes; ++lane) some.mixing.begin(lane, true);
  for (int k = 0; k < 4; ++k) some.iterate();
  for (const int lane : {0, 5, 8, 21, 31}) {
    const Eigen::VectorXd u = byFormula(lane, 4);
    for (int i = 0; i < count; ++i) // the past is kept in single precision
      EXPECT_NEAR(some.u[std::size_t(i) * batchLanes + lane], u(i), 1e-4 * u.lpNorm<Eigen::Infinity>()) << lane;
    for (int k = 0; k < followers; ++k) // half of the direction, so half of each step
      EXPECT_NEAR(some.follower(k, lane), u(k) / 2, 1e-4 * u.lpNorm<Eigen::Infinity>()) << lane;
  }
}

TEST(LaneMixing, ALaneThatIsNotMixedGoesAlongItsDirections) {
  Lanes some;
  some.mixing.begin(3, true);
  double plain = 0;
  for (int k = 0; k < 5; ++k) {
    plain += 2 * double(static_cast<float>(some.residual(6, 4) / 2));
    some.iterate();
  }
  EXPECT_EQ(some.u[6 * batchLanes + 4], plain);
}

TEST(LaneMixing, ALaneWithoutScaleStaysAndOneThatRestartsForgets) {
  Lanes some;
  for (int lane = 0; lane < batchLanes; ++lane) some.mixing.begin(lane, true);
  for (int k = 0; k < 3; ++k) some.iterate();
  const double before = some.u[2 * batchLanes + 9], follower = some.follower(2, 9);
  some.scale[9] = 0;
  some.mixing.restart(10);
  const double restarted = some.u[2 * batchLanes + 10] + 2 * double(static_cast<float>(some.residual(2, 10) / 2));
  LaneVector none(some.x.size());
  for (int lane = 0; lane < batchLanes; ++lane)
    for (int i = 0; i < count; ++i)
      some.directions[std::size_t(some.rows[i]) * batchLanes + lane] = static_cast<float>(some.residual(i, lane) / 2);
  some.mixing.moveLeading(some.rows, some.directions.data(), some.scale, some.u.data());
  some.mixing.moveFollowing(1, 0, none.data(), some.x.data() + followers * lanes);
  EXPECT_EQ(some.u[2 * batchLanes + 9], before);
  EXPECT_EQ(some.follower(2, 9), follower);
  EXPECT_EQ(some.u[2 * batchLanes + 10], restarted);
}

} // namespace
} // namespace palp
