#include "solver/batch/AndersonBatch.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace palp {
namespace {

constexpr int count = 40, followers = 7;

/// Lanes' fixed points of x -> x + (b - A x), A = 1 + a part that grows with the lane; followers go half of the way.
struct Lanes {
  std::vector<int> rows;
  std::vector<float> directions = std::vector<float>(std::size_t(count + 1) * batchColumns);
  LaneVector u = LaneVector(std::size_t(count) * batchColumns), x = LaneVector(std::size_t(followers) * batchColumns);
  std::array<double, batchColumns> scale{};
  AndersonBatch mixing{count, followers, followers};

  Lanes() {
    for (int i = 0; i < count; ++i) rows.push_back(count - 1 - i);
    scale.fill(2);
  }
  static double slope(int i, int column) { return 1 + 0.6 * std::sin(1. + i) * column / batchColumns; }
  double residual(int i, int column) const {
    return 1 + i - slope(i, column) * u[std::size_t(i) * batchColumns + column];
  }
  void iterate() {
    LaneVector follow(x.size());
    for (int column = 0; column < batchColumns; ++column) {
      for (int i = 0; i < count; ++i)
        directions[std::size_t(rows[i]) * batchColumns + column] =
            static_cast<float>(residual(i, column) / scale[column]);
      for (int k = 0; k < followers; ++k)
        follow[(std::size_t(column / lanes) * followers + k) * lanes + column % lanes] = residual(k, column) / 2;
    }
    mixing.moveLeading(rows, directions.data(), scale, u.data());
    for (int b = 0; b < batchColumns / lanes; ++b) {
      const std::size_t first = std::size_t(b) * followers * lanes;
      mixing.moveFollowing(b, 0, follow.data() + first, x.data() + first);
    }
  }
  double follower(int k, int column) const {
    return x[(std::size_t(column / lanes) * followers + k) * lanes + column % lanes];
  }
};

/// One lane by the formulas of AndersonBatch.h, in double.
Eigen::VectorXd byFormula(int column, int iterations) {
  std::vector<Eigen::VectorXd> r, s;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(count);
  for (int k = 0; k < iterations; ++k) {
    Eigen::VectorXd now(count);
    for (int i = 0; i < count; ++i) now(i) = 1 + i - Lanes::slope(i, column) * u(i);
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

TEST(AndersonBatch, StepsAreThoseOfTheFormula) {
  Lanes some;
  for (int column = 0; column < batchColumns; ++column) some.mixing.begin(column, true);
  for (int k = 0; k < 4; ++k) some.iterate();
  for (const int column : {0, 5, 8, 21, 31}) {
    const Eigen::VectorXd u = byFormula(column, 4);
    for (int i = 0; i < count; ++i) // the past is kept in single precision
      EXPECT_NEAR(some.u[std::size_t(i) * batchColumns + column], u(i), 1e-4 * u.lpNorm<Eigen::Infinity>()) << column;
    for (int k = 0; k < followers; ++k) // half of the direction, so half of each step
      EXPECT_NEAR(some.follower(k, column), u(k) / 2, 1e-4 * u.lpNorm<Eigen::Infinity>()) << column;
  }
}

TEST(AndersonBatch, ALaneThatIsNotMixedGoesAlongItsDirections) {
  Lanes some;
  some.mixing.begin(3, true);
  double plain = 0;
  for (int k = 0; k < 5; ++k) {
    plain += 2 * double(static_cast<float>(some.residual(6, 4) / 2));
    some.iterate();
  }
  EXPECT_EQ(some.u[6 * batchColumns + 4], plain);
}

TEST(AndersonBatch, ALaneWithoutScaleStaysAndOneThatRestartsForgets) {
  Lanes some;
  for (int column = 0; column < batchColumns; ++column) some.mixing.begin(column, true);
  for (int k = 0; k < 3; ++k) some.iterate();
  const double before = some.u[2 * batchColumns + 9], follower = some.follower(2, 9);
  some.scale[9] = 0;
  some.mixing.restart(10);
  const double restarted = some.u[2 * batchColumns + 10] + 2 * double(static_cast<float>(some.residual(2, 10) / 2));
  LaneVector none(some.x.size());
  for (int column = 0; column < batchColumns; ++column)
    for (int i = 0; i < count; ++i)
      some.directions[std::size_t(some.rows[i]) * batchColumns + column] =
          static_cast<float>(some.residual(i, column) / 2);
  some.mixing.moveLeading(some.rows, some.directions.data(), some.scale, some.u.data());
  some.mixing.moveFollowing(1, 0, none.data(), some.x.data() + followers * lanes);
  EXPECT_EQ(some.u[2 * batchColumns + 9], before);
  EXPECT_EQ(some.follower(2, 9), follower);
  EXPECT_EQ(some.u[2 * batchColumns + 10], restarted);
}

} // namespace
} // namespace palp
