#include "solver/batch/LoadBatch.h"

#include "solver/SensorMesh.h"

#include <gtest/gtest.h>

#include <limits>

namespace palp {
namespace {

/// The paper's block on few elements, and loads of one area in the lanes 0 .. 15.
class Batches : public testing::Test {
protected:
  static constexpr int loads = 2 * lanes;

  Batches()
      : problem(paperDesign(), sensorMesh(paperDesign(), {.meshSize_mm = 14, .mapped = {}})),
        rest(problem.block().initialTangent(1, {})), model(problem.block(), *rest),
        shares(tractionShares(problem.mesh(), regionOf(problem.design().areaRectangle(1)))) {}

  [[nodiscard]] LoadBatch started() const {
    LoadBatch batch(model, problem.block().upperProbe(), problem.block().lowerProbe());
    for (int b = 0; b < LoadBatch::blocks; ++b) batch.reset(b);
    for (int column = 0; column < loads; ++column)
      batch.addForce(column, {&shares, Eigen::Vector3d(0.1 * column, 0.3, -0.4 * column)});
    return batch;
  }
  /// So many iterations of the lanes first .. last - 1.
  static void iterate(LoadBatch& batch, int first, int last, int times) {
    std::array<bool, batchColumns> active{};
    std::fill(active.begin() + first, active.begin() + last, true);
    std::array<double, batchColumns> change{};
    for (int i = 0; i < times; ++i) batch.iterate(active, change, {});
    for (int column = first; column < last; ++column) EXPECT_GE(change[column], 0);
  }
  void expectSameBlock(LoadBatch& a, LoadBatch& b, int block) const {
    a.updateInternal(block);
    b.updateInternal(block);
    for (int column = block * lanes; column < (block + 1) * lanes; ++column) expectSameColumn(a, column, b, column);
  }
  void expectSameColumn(LoadBatch& a, int laneOfA, LoadBatch& b, int laneOfB) const {
    a.updateInternal(laneOfA / lanes);
    b.updateInternal(laneOfB / lanes);
    for (std::size_t row = 0; row < 3 * std::size_t(model.mesh().nodes()); ++row)
      ASSERT_EQ(a.displacements()[row * batchColumns + laneOfA], b.displacements()[row * batchColumns + laneOfB])
          << laneOfA;
    for (int e = 0; e < model.mesh().elements(); ++e)
      for (int k = 0; k < model.mesh().unknowns(); ++k)
        ASSERT_EQ(a.unknown(e, k, laneOfA), b.unknown(e, k, laneOfB)) << "element " << e << ", lane " << laneOfA;
  }

  HyperelasticProblem problem;
  std::shared_ptr<const InitialTangent> rest;
  ElementwiseTangent model;
  TractionShares shares;
};

TEST_F(Batches, LeaveABlockThatHasEndedAsItIsWhileOthersGoOn) {
  LoadBatch both = started(), alone = started();
  iterate(both, 0, loads, 2);
  iterate(both, lanes, loads, 3); // the first block has ended
  iterate(alone, 0, lanes, 2);
  expectSameBlock(both, alone, 0);
  LoadBatch other = started();
  iterate(other, lanes, loads, 5);
  expectSameBlock(both, other, 1);
}

TEST_F(Batches, LeaveALaneThatHasEndedAsItIsWhileItsBlockGoesOn) {
  LoadBatch both = started(), alone = started();
  iterate(both, 0, lanes, 2);
  iterate(both, 1, lanes, 2); // lane 0 has ended
  iterate(alone, 0, 1, 2);
  both.updateInternal(0);
  alone.updateInternal(0);
  for (int e = 0; e < model.mesh().elements(); ++e)
    for (int k = 0; k < model.mesh().unknowns(); ++k) ASSERT_EQ(both.unknown(e, k, 0), alone.unknown(e, k, 0)) << e;
}

// Bubbles and pressures follow by themselves where an electrode looks, elsewhere when they are asked to.
TEST_F(Batches, KnowWhatTheElectrodesFeelBeforeTheirElementsHaveCaughtUp) {
  LoadBatch batch = started();
  iterate(batch, 0, loads, 3);
  const auto before = batch.electrodes(1);
  batch.updateInternal(1);
  const auto after = batch.electrodes(1);
  for (int column = 0; column < lanes; ++column) {
    EXPECT_EQ(before[column].upper_mm, after[column].upper_mm);
    EXPECT_EQ(before[column].lower_mm, after[column].lower_mm);
    EXPECT_EQ(before[column].upperPressure_MPa, after[column].upperPressure_MPa);
    EXPECT_GT(after[column].upperPressure_MPa.norm(), 0);
  }
}

/// Lanes that are mixed, with forces of their own, in place of what they were.
void mixColumn(LoadBatch& batch, int column, const TractionShares& shares, double pressing_N) {
  batch.mix(column);
  batch.addForce(column, {&shares, Eigen::Vector3d(0.3, 0.1, -pressing_N)});
}

// A touch that is found makes room for another, while its block's others go on.
TEST_F(Batches, BeginALaneForItselfAmongOthersThatAreOnTheirWay) {
  LoadBatch among = started(), alone = started();
  for (int column = 0; column < lanes; ++column) mixColumn(among, column, shares, 0.5 + 0.2 * column);
  iterate(among, 0, loads, 3);
  mixColumn(among, 2, shares, 1.7);
  iterate(among, 0, loads, 4);
  mixColumn(alone, 2, shares, 1.7);
  iterate(alone, 2, 3, 4);
  expectSameColumn(among, 2, alone, 2);
}

TEST_F(Batches, MoveALaneThatGoesOnAsIfItHadStayed) {
  LoadBatch moved = started(), stayed = started();
  for (LoadBatch* batch : {&moved, &stayed})
    for (const int column : {1, 9}) mixColumn(*batch, column, shares, 1 + column);
  for (LoadBatch* batch : {&moved, &stayed}) {
    iterate(*batch, 0, loads, 3);
    batch->continueWith(9, true); // takes effect in the next iteration
  }
  moved.move(9, 4);
  iterate(moved, 0, lanes, 4);
  iterate(stayed, 0, loads, 4);
  expectSameColumn(moved, 4, stayed, 9);
  expectSameColumn(moved, 1, stayed, 1);
}

TEST_F(Batches, ALaneWithoutNumbersIsLostAndHasNotArrived) {
  LoadBatch batch = started();
  batch.addForce(3, {&shares, Eigen::Vector3d(0, 0, std::numeric_limits<double>::quiet_NaN())});
  std::array<bool, batchColumns> active{};
  std::fill_n(active.begin(), loads, true);
  std::array<double, batchColumns> change{};
  batch.iterate(active, change, {});
  EXPECT_LT(change[3], 0);
  EXPECT_GT(change[4], 0) << "lanes do not mix";
}

TEST_F(Batches, TheirChangesAreOfAllThatIsWatched) {
  const PointProbe &upper = problem.block().upperProbe(), &lower = problem.block().lowerProbe();
  LoadBatch few = started(), all(model, upper, lower, {true, 0.05, true});
  for (int b = 0; b < LoadBatch::blocks; ++b) all.reset(b);
  for (int column = 0; column < loads; ++column)
    all.addForce(column, {&shares, Eigen::Vector3d(0.1 * column, 0.3, -0.4 * column)});
  std::array<bool, batchColumns> active{};
  std::fill_n(active.begin(), loads, true);
  std::array<double, batchColumns> ofFew{}, ofAll{};
  for (int i = 0; i < 3; ++i) {
    few.iterate(active, ofFew, {});
    all.iterate(active, ofAll, {});
  }
  int larger = 0;
  for (int column = 0; column < loads; ++column) {
    EXPECT_GE(ofAll[column], ofFew[column]) << column;
    larger += ofAll[column] > ofFew[column] ? 1 : 0;
  }
  EXPECT_GT(larger, 0);
  expectSameBlock(few, all, 0);
}

} // namespace
} // namespace palp
