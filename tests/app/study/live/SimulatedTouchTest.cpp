#include "app/study/live/SimulatedTouch.h"

#include "model/base/Error.h"
#include "tests/app/study/live/LiveFixture.h"
#include "tests/io/Refusal.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

TEST(SimulatedTouch, GivesTheResistancesOfTheSolvedSamples) {
  const SampleSet& samples = shippedSamples();
  const SimulatedTouch touch(samples);
  double worst = 0;
  for (Eigen::Index i = 0; i < samples.size(); ++i) {
    const Eigen::MatrixXd R = touch.resistances_ohm({samples.area(i), samples.forces_N.col(i)});
    const Eigen::VectorXd solved = samples.resistances_ohm.col(i);
    worst = std::max(worst, (R.reshaped<Eigen::RowMajor>().array() / solved.array() - 1).abs().maxCoeff());
  }
  EXPECT_LT(worst, 1e-6); // the fit of the cubic; a fifth of a good board's noise
}

TEST(SimulatedTouch, GoesOverAllAreasAndRestsFirst) {
  const SimulatedTouch touch(shippedSamples());
  for (int area = 0; area < 6; ++area) {
    const double start_s = area * SimulatedTouch::kTouch_s;
    EXPECT_EQ(touch.truth(start_s + 0.5).force_N, Eigen::Vector3d::Zero());
    const SimulatedTouch::Truth pressed = touch.truth(start_s + 0.75 * SimulatedTouch::kTouch_s);
    EXPECT_EQ(pressed.area, area);
    EXPECT_LT(pressed.force_N.z(), -4);
    EXPECT_GT(pressed.force_N.z(), -6); // within the samples
  }
  EXPECT_EQ(touch.truth(6 * SimulatedTouch::kTouch_s + 1.5).area, 0);
}

TEST(SimulatedTouch, RefusesSamplesThatLackSomething) {
  SampleSet samples = shippedSamples();
  samples.area.setZero();
  EXPECT_THROW(SimulatedTouch{samples}, Error);
  samples = shippedSamples();
  samples.resistances_ohm.resize(0, samples.size());
  EXPECT_THROW(SimulatedTouch{samples}, Error);
}

/// The shipped samples with every row-wire as often as it takes.
SampleSet withRowWires(int rowWires) {
  SampleSet samples = shippedSamples();
  const Eigen::Index columns = samples.columnWires;
  Eigen::MatrixXd resistances(rowWires * columns, samples.size());
  for (int row = 0; row < rowWires; ++row)
    resistances.middleRows(row * columns, columns) =
        samples.resistances_ohm.middleRows((row % samples.rowWires) * columns, columns);
  samples.resistances_ohm = std::move(resistances);
  samples.rowWires = rowWires;
  samples.displacements_mm.resize(0, samples.size());
  return samples;
}

TEST(SimulatedBoard, ScansEveryRowWireUpToThoseThatItsMaskHolds) {
  for (const int rowWires : {1, 10, 31, 32}) {
    VirtualBoard board = simulatedBoard(withRowWires(rowWires), {}, 1000, 1);
    EXPECT_EQ(board.configuration().rowMask, static_cast<std::uint32_t>((1ULL << rowWires) - 1)) << rowWires;
  }
}

TEST(SimulatedBoard, RefusesMoreRowWiresThanTheProtocolHas) {
  for (const int rowWires : {33, 64, 70})
    EXPECT_NE(refusal([&] { simulatedBoard(withRowWires(rowWires), {}, 1000, 1); }).find("up to 32"), std::string::npos)
        << rowWires;
}

} // namespace
} // namespace palp
