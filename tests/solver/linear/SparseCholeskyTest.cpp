#include "tests/solver/TestBlocks.h"

#include "solver/linear/Front.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <vector>

using namespace palp;
using namespace palp::test;

namespace palp::baseline {
extern const LaneKernels laneKernelSet;
} // namespace palp::baseline

namespace {

/// The tangent at rest of a cube held at its bottom, with fronts wider than a tile.
struct Tangent {
  explicit Tangent(double poissonRatio)
      : problem(cubeTets(8, 0.1), rubberOf(poissonRatio),
                [](const Eigen::Vector3d& x, int) { return x.z() == 0 ? std::optional<double>(0) : std::nullopt; }) {
    const Assembler& assembler = problem.assembler;
    ElementTangents tangents;
    ElementForces forces;
    assembler.tangent(problem.discretisation->atRest(), tangents, forces, 1, {});
    values = assembler.matrix(tangents, 1);
    plan = std::make_shared<const CholeskyPlan>(assembler.pattern());
  }
  [[nodiscard]] Eigen::VectorXd times(const Eigen::VectorXd& x) const {
    const SparsePattern& pattern = plan->pattern();
    Eigen::VectorXd y = Eigen::VectorXd::Zero(x.size());
    for (int j = 0; j < pattern.size(); ++j)
      for (int k = pattern.columns[j]; k < pattern.columns[j + 1]; ++k) {
        y(pattern.rows[k]) += values[k] * x(j);
        if (pattern.rows[k] != j) y(j) += values[k] * x(pattern.rows[k]);
      }
    return y;
  }
  [[nodiscard]] Eigen::VectorXd rightSide() const {
    return Eigen::VectorXd::NullaryExpr(plan->tree().size(), [](Eigen::Index i) { return std::sin(3. * double(i)); });
  }

  BoundaryValueProblem problem;
  LaneVector values;
  std::shared_ptr<const CholeskyPlan> plan;
};

class CholeskyOf : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(PoissonRatios, CholeskyOf, testing::Values(0.3, 0.4999, 0.5));

TEST_P(CholeskyOf, SolvesWithTheSameBytesOnAnyNumberOfThreads) {
  const Tangent tangent(GetParam());
  const Eigen::VectorXd b = tangent.rightSide();
  Eigen::VectorXd first;
  for (const int threads : {1, 2, 5}) {
    SparseCholesky cholesky(tangent.plan);
    ASSERT_EQ(cholesky.factorise(tangent.values, threads, {}), SparseCholesky::Outcome::Done);
    Eigen::VectorXd x = b;
    cholesky.solve(x);
    EXPECT_LT((b - tangent.times(x)).norm(), 1e-7 * b.norm());
    if (threads == 1)
      first = x;
    else
      EXPECT_EQ(std::memcmp(first.data(), x.data(), sizeof(double) * x.size()), 0) << threads;
  }
}

TEST_P(CholeskyOf, SolvesForManyRightSidesAsForEachOfThem) {
  const Tangent tangent(GetParam());
  SparseCholesky cholesky(tangent.plan);
  ASSERT_EQ(cholesky.factorise(tangent.values, 2, {}), SparseCholesky::Outcome::Done);
  const Eigen::VectorXd b = tangent.rightSide();
  LaneSides sides(static_cast<int>(b.size()), 1); // one row more, held at 0
  LaneSides::Lanes right = sides.lanes(sides.right);
  right.setOnes();
  for (int lane = 0; lane < batchColumns; ++lane)
    right.col(lane).tail(b.size()) = std::pow(10., lane - 16) * (b + Eigen::VectorXd::Unit(b.size(), lane));
  right.col(5).setZero(); // of no load
  const Eigen::MatrixXd asked = right.bottomRows(b.size());
  cholesky.solve(sides, {});
  const Eigen::MatrixXd found = sides.lanes(sides.x);
  EXPECT_TRUE(found.row(0).isZero(0));
  EXPECT_TRUE(found.col(5).isZero(0));
  for (int lane = 0; lane < batchColumns; ++lane) {
    const Eigen::VectorXd x = found.col(lane).tail(b.size());
    EXPECT_LE((asked.col(lane) - tangent.times(x)).norm(), 1e-5 * asked.col(lane).norm()) << lane;
  }
}

// Where kappa is no more than 1000 times the shear modulus (RubberConstants::roundsWell).
TEST(Cholesky, SolvesWithProductsInSinglePrecisionAndTheSameBytesOnAnyNumberOfThreads) {
  const Tangent tangent(0.4995);
  const Eigen::VectorXd b = tangent.rightSide();
  Eigen::VectorXd first, inDouble = b;
  SparseCholesky usual(tangent.plan);
  ASSERT_EQ(usual.factorise(tangent.values, 1, {}), SparseCholesky::Outcome::Done);
  usual.solve(inDouble);
  for (const int threads : {1, 2}) {
    SparseCholesky cholesky(tangent.plan);
    ASSERT_EQ(cholesky.factorise(tangent.values, threads, {}, UpdatePrecision::Single), SparseCholesky::Outcome::Done);
    Eigen::VectorXd x = b;
    cholesky.solve(x);
    EXPECT_LT((b - tangent.times(x)).norm(), 1e-7 * b.norm());
    EXPECT_GT((x - inDouble).norm(), 0) << "there are products in single precision";
    if (threads == 1)
      first = x;
    else
      EXPECT_EQ(std::memcmp(first.data(), x.data(), sizeof(double) * x.size()), 0);
  }
}

TEST(Cholesky, GivesTheInverseBetweenItsLastGroups) {
  const Tangent tangent(0.4999);
  auto pattern = std::make_shared<SparsePattern>(tangent.plan->pattern());
  pattern->lastGroups = {700, 12, 13, 801, 400};
  SparseCholesky cholesky(std::make_shared<const CholeskyPlan>(pattern));
  ASSERT_EQ(cholesky.factorise(tangent.values, 2, {}), SparseCholesky::Outcome::Done);
  const Eigen::MatrixXd inverse = cholesky.inverseOfLast();
  ASSERT_EQ(inverse.rows(), 15);
  const auto unknown = [&](int i) { return pattern->groupStart[pattern->lastGroups[i / 3]] + i % 3; };
  for (const int j : {0, 4, 11}) {
    Eigen::VectorXd x = Eigen::VectorXd::Unit(pattern->size(), unknown(j));
    cholesky.solve(x);
    for (int i = 0; i < 15; ++i) EXPECT_NEAR(inverse(i, j), x(unknown(i)), 1e-5 * inverse(j, j));
  }
}

// Without the neighbours of some groups the others fall into parts, which know of some of the last groups alone.
TEST(Cholesky, LastGroupsAreLastWhereTheOthersFallIntoParts) {
  const Tangent tangent(0.49);
  auto pattern = std::make_shared<SparsePattern>(tangent.plan->pattern());
  const std::vector<int> cutOff{40, 700, 300};
  std::set<int> around;
  for (int g = 0; g + 1 < static_cast<int>(pattern->groupColumns.size()); ++g)
    for (int k = pattern->groupColumns[g]; k < pattern->groupColumns[g + 1]; ++k)
      for (const int cut : cutOff) {
        if (g == cut) around.insert(pattern->groupRows[k]);
        if (pattern->groupRows[k] == cut) around.insert(g);
      }
  for (const int cut : cutOff) around.erase(cut);
  pattern->lastGroups.assign(around.rbegin(), around.rend());
  SparseCholesky cholesky(std::make_shared<const CholeskyPlan>(pattern));
  ASSERT_EQ(cholesky.factorise(tangent.values, 2, {}), SparseCholesky::Outcome::Done);
  const Eigen::MatrixXd inverse = cholesky.inverseOfLast();
  ASSERT_EQ(inverse.rows(), static_cast<Eigen::Index>(3 * around.size()));
  const auto unknown = [&](Eigen::Index i) { return pattern->groupStart[pattern->lastGroups[i / 3]] + i % 3; };
  for (Eigen::Index j = 0; j < inverse.cols(); j += 11) {
    Eigen::VectorXd x = Eigen::VectorXd::Unit(pattern->size(), unknown(j));
    cholesky.solve(x);
    for (Eigen::Index i = 0; i < inverse.rows(); ++i)
      EXPECT_NEAR(inverse(i, j), x(unknown(i)), 1e-9 * inverse.cwiseAbs().maxCoeff());
  }
}

TEST(Cholesky, AddsForcesThatAnswerTheMotionOfItsLastGroups) {
  const Tangent tangent(0.499);
  auto pattern = std::make_shared<SparsePattern>(tangent.plan->pattern());
  pattern->lastGroups = {700, 12, 13, 801, 400};
  SparseCholesky cholesky(std::make_shared<const CholeskyPlan>(pattern));
  ASSERT_EQ(cholesky.factorise(tangent.values, 2, {}), SparseCholesky::Outcome::Done);
  const auto unknown = [&](int i) { return pattern->groupStart[pattern->lastGroups[i / 3]] + i % 3; };
  Eigen::VectorXd alone = tangent.rightSide(), answered = alone, seen;
  Eigen::VectorXd expected = alone;
  cholesky.solve(alone);
  const auto springs = [](const Eigen::VectorXd& motion) -> Eigen::VectorXd {
    return -0.2 * motion + Eigen::VectorXd::LinSpaced(motion.size(), -0.1, 0.3);
  };
  cholesky.solve(answered, [&](const Eigen::VectorXd& motion) {
    seen = motion;
    return springs(motion);
  });
  ASSERT_EQ(seen.size(), 15);
  const Eigen::VectorXd forces = springs(seen);
  for (int i = 0; i < 15; ++i) {
    EXPECT_NEAR(seen(i), alone(unknown(i)), 1e-4 * alone.cwiseAbs().maxCoeff()) << "by a factor in single precision";
    expected(unknown(i)) += forces(i);
  }
  cholesky.solve(expected);
  EXPECT_LT((answered - expected).norm(), 1e-6 * expected.norm());
}

TEST(Cholesky, RefusesWhatIsNotPositiveDefinite) {
  Tangent tangent(0.3);
  tangent.values[tangent.plan->pattern().columns[100]] *= -1; // on the diagonal
  EXPECT_EQ(SparseCholesky(tangent.plan).factorise(tangent.values, 2, {}),
            SparseCholesky::Outcome::NotPositiveDefinite);
}

TEST(Cholesky, StopsWhenAsked) {
  const Tangent tangent(0.3);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(SparseCholesky(tangent.plan).factorise(tangent.values, 2, stop.get_token()),
            SparseCholesky::Outcome::Stopped);
}

TEST(Cholesky, OneRightSideAgreesWithLanesAndTheBaselineWithTheWidest) {
  const Tangent tangent(0.4999);
  SparseCholesky cholesky(tangent.plan);
  ASSERT_EQ(cholesky.factorise(tangent.values, 2, {}), SparseCholesky::Outcome::Done);
  const BlockedFactor L = cholesky.blocks();
  const Eigen::Index size = tangent.plan->tree().size();
  Eigen::VectorXd widest(size + 1), lane(size);
  widest << tangent.rightSide(), 0;
  Eigen::VectorXd baseline = widest;
  std::vector<float, CacheLineAllocator<float>> lanes((size + 1) * batchColumns);
  for (Eigen::Index i = 0; i < size; ++i) lanes[i * batchColumns + 5] = static_cast<float>(widest(i));
  laneKernels().forwardOne(L, 0, L.count, widest.data());
  laneKernels().backwardOne(L, 0, L.count, widest.data());
  baseline::laneKernelSet.forwardOne(L, 0, L.count, baseline.data());
  baseline::laneKernelSet.backwardOne(L, 0, L.count, baseline.data());
  laneKernels().forward(L, 0, L.count, 1U, lanes.data());
  laneKernels().backward(L, 0, L.count, 1U, lanes.data());
  for (Eigen::Index i = 0; i < size; ++i) lane(i) = lanes[i * batchColumns + 5];
  EXPECT_LT((widest - baseline).head(size).norm(), 1e-9 * widest.norm()); // rounding, times a condition of 1e6
  EXPECT_LT((widest.head(size) - lane).norm(), 1e-2 * widest.norm());     // in single precision
}

// Which lanes go through the factor together depends on which are live; what comes out of them must not.
TEST(LaneKernels, SubstituteTheSameBytesWhicheverOtherBlocksAreLive) {
  const Tangent tangent(0.4999);
  SparseCholesky cholesky(tangent.plan);
  ASSERT_EQ(cholesky.factorise(tangent.values, 1, {}), SparseCholesky::Outcome::Done);
  const BlockedFactor L = cholesky.blocks();
  const std::size_t size = tangent.plan->tree().size();
  const auto substituted = [&](const LaneKernels& kernels, unsigned live) {
    std::vector<float> x((size + 1) * batchColumns);
    for (std::size_t i = 0; i < size * batchColumns; ++i) x[i] = std::sin(3.F * static_cast<float>(i % 10007));
    kernels.forward(L, 0, L.count, live, x.data());
    kernels.backward(L, 0, L.count, live, x.data());
    return x;
  };
  for (const LaneKernels* kernels : {&laneKernels(), &baseline::laneKernelSet}) {
    const std::vector<float> all = substituted(*kernels, 15U);
    for (unsigned live = 0; live < 15; ++live) {
      const std::vector<float> some = substituted(*kernels, live);
      for (std::size_t i = 0; i < some.size(); ++i)
        if (live >> (i % batchColumns / lanes) & 1U) {
          ASSERT_EQ(some[i], all[i]) << "live " << live << ", lane " << i % batchColumns;
        }
    }
  }
}

TEST(UpdateMatrix, ForgetsColumnsThatHaveBeenAddedAndNoOthers) {
  constexpr int size = 700;
  UpdateMatrix matrix(size);
  for (int j = 0; j < size; ++j)
    for (int i = j; i < size; ++i) matrix.column(j)[i] = 1000. * i + j;
  for (const int before : {1, 255, 256, 600, size}) {
    matrix.forgetBefore(before);
    for (int j = before; j < size; ++j)
      for (int i = j; i < size; ++i) ASSERT_EQ(matrix.column(j)[i], 1000. * i + j) << before;
  }
}

TEST(UpdateMatrix, KeepsItsLowerTriangleInBlocksOfColumns) {
  for (const int size : {1, 255, 256, 257, 700}) {
    UpdateMatrix matrix(size);
    for (int j = 0; j < size; ++j)
      for (int i = j; i < size; ++i) matrix.column(j)[i] = 1000. * i + j;
    for (int j = 0; j < size; ++j) {
      for (int i = j; i < size; ++i) ASSERT_EQ(matrix.column(j)[i], 1000. * i + j) << size;
      if (j % frontTile > 0) {
        EXPECT_EQ(matrix.column(j) - matrix.column(j - 1), matrix.stride(j));
      }
    }
  }
}

} // namespace
