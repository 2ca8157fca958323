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
        rest(problem.parts().initialTangent(1, {})), model(problem.parts(), *rest),
        shares(tractionShares(problem.mesh(), regionOf(problem.design().areaRectangle(1)))) {}

  [[nodiscard]] LoadBatch started() const {
    LoadBatch batch(model, problem.parts().upperProbe(), problem.parts().lowerProbe());
    for (int b = 0; b < LoadBatch::blocks; ++b) batch.reset(b);
    for (int lane = 0; lane < loads; ++lane)
      batch.addForce(lane, {&shares, Eigen::Vector3d(0.1 * lane, 0.3, -0.4 * lane)});
    return batch;
  }
  /// So many iterations of the lanes first .. last - 1.
  static void iterate(LoadBatch& batch, int first, int last, int times) {
    std::array<bool, batchLanes> active{};
    std::fill(active.begin() + first, active.begin() + last, true);
    std::array<double, batchLanes> change{};
    for (int i = 0; i < times; ++i) batch.iterate(active, change, {});
    for (int lane = first; lane < last; ++lane) EXPECT_GE(change[lane], 0);
  }
  void expectSameBlock(LoadBatch& a, LoadBatch& b, int block) const {
    a.catchUp(block);
    b.catchUp(block);
    for (int lane = block * lanes; lane < (block + 1) * lanes; ++lane) expectSameLane(a, lane, b, lane);
  }
  void expectSameLane(LoadBatch& a, int laneOfA, LoadBatch& b, int laneOfB) const {
    a.catchUp(laneOfA / lanes);
    b.catchUp(laneOfB / lanes);
    for (std::size_t row = 0; row < 3 * std::size_t(model.mesh().nodes()); ++row)
      ASSERT_EQ(a.displacements()[row * batchLanes + laneOfA], b.displacements()[row * batchLanes + laneOfB])
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
  both.catchUp(0);
  alone.catchUp(0);
  for (int e = 0; e < model.mesh().elements(); ++e)
    for (int k = 0; k < model.mesh().unknowns(); ++k) ASSERT_EQ(both.unknown(e, k, 0), alone.unknown(e, k, 0)) << e;
}

// Bubbles and pressures follow by themselves where an electrode looks, elsewhere when they are asked to.
TEST_F(Batches, KnowWhatTheElectrodesFeelBeforeTheirElementsHaveCaughtUp) {
  LoadBatch batch = started();
  iterate(batch, 0, loads, 3);
  const auto before = batch.electrodes(1);
  batch.catchUp(1);
  const auto after = batch.electrodes(1);
  for (int lane = 0; lane < lanes; ++lane) {
    EXPECT_EQ(before[lane].upper_mm, after[lane].upper_mm);
    EXPECT_EQ(before[lane].lower_mm, after[lane].lower_mm);
    EXPECT_EQ(before[lane].upperPressure_MPa, after[lane].upperPressure_MPa);
    EXPECT_GT(after[lane].upperPressure_MPa.norm(), 0);
  }
}

/// Lanes that are mixed, with forces of their own, in place of what they were.
void mixLane(LoadBatch& batch, int lane, const TractionShares& shares, double pressing_N) {
  batch.mix(lane);
  batch.addForce(lane, {&shares, Eigen::Vector3d(0.3, 0.1, -pressing_N)});
}

// A touch that is found makes room for another, while its block's others go on.
TEST_F(Batches, BeginALaneForItselfAmongOthersThatAreOnTheirWay) {
  LoadBatch among = started(), alone = started();
  for (int lane = 0; lane < lanes; ++lane) mixLane(among, lane, shares, 0.5 + 0.2 * lane);
  iterate(among, 0, loads, 3);
  mixLane(among, 2, shares, 1.7);
  iterate(among, 0, loads, 4);
  mixLane(alone, 2, shares, 1.7);
  iterate(alone, 2, 3, 4);
  expectSameLane(among, 2, alone, 2);
}

TEST_F(Batches, MoveALaneThatGoesOnAsIfItHadStayed) {
  LoadBatch moved = started(), stayed = started();
  for (LoadBatch* batch : {&moved, &stayed})
    for (const int lane : {1, 9}) mixLane(*batch, lane, shares, 1 + lane);
  for (LoadBatch* batch : {&moved, &stayed}) {
    iterate(*batch, 0, loads, 3);
    batch->goOn(9, true); // takes effect in the next iteration
  }
  moved.move(9, 4);
  iterate(moved, 0, lanes, 4);
  iterate(stayed, 0, loads, 4);
  expectSameLane(moved, 4, stayed, 9);
  expectSameLane(moved, 1, stayed, 1);
}

TEST_F(Batches, ALaneWithoutNumbersIsLostAndHasNotArrived) {
  LoadBatch batch = started();
  batch.addForce(3, {&shares, Eigen::Vector3d(0, 0, std::numeric_limits<double>::quiet_NaN())});
  std::array<bool, batchLanes> active{};
  std::fill_n(active.begin(), loads, true);
  std::array<double, batchLanes> change{};
  batch.iterate(active, change, {});
  EXPECT_LT(change[3], 0);
  EXPECT_GT(change[4], 0) << "lanes do not mix";
}

TEST_F(Batches, TheirChangesAreOfAllThatIsWatched) {
  const PointProbe &upper = problem.parts().upperProbe(), &lower = problem.parts().lowerProbe();
  LoadBatch few = started(), all(model, upper, lower, {true, 0.05, true});
  for (int b = 0; b < LoadBatch::blocks; ++b) all.reset(b);
  for (int lane = 0; lane < loads; ++lane) all.addForce(lane, {&shares, Eigen::Vector3d(0.1 * lane, 0.3, -0.4 * lane)});
  std::array<bool, batchLanes> active{};
  std::fill_n(active.begin(), loads, true);
  std::array<double, batchLanes> ofFew{}, ofAll{};
  for (int i = 0; i < 3; ++i) {
    few.iterate(active, ofFew, {});
    all.iterate(active, ofAll, {});
  }
  int larger = 0;
  for (int lane = 0; lane < loads; ++lane) {
    EXPECT_GE(ofAll[lane], ofFew[lane]) << lane;
    larger += ofAll[lane] > ofFew[lane] ? 1 : 0;
  }
  EXPECT_GT(larger, 0);
  expectSameBlock(few, all, 0);
}

} // namespace
} // namespace palp
