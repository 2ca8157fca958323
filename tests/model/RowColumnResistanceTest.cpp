#include "model/RowColumnResistance.h"

#include "model/DesignError.h"

#include <gtest/gtest.h>

#include <random>

namespace palp {
namespace {

/// Displacements of the size of the paper's, pressures on both sides of zero but away from it (the law has a kink
/// there).
ElectrodeDisplacements randomDisplacements(const SensorDesign& design) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  ElectrodeDisplacements displacements = ElectrodeDisplacements::atRest(design);
  for (double& value : displacements.upper_mm.reshaped()) value = 0.1 * uniform(engine);
  for (double& value : displacements.lower_mm.reshaped()) value = 0.05 * uniform(engine);
  for (double& value : displacements.upperPressure_MPa.reshaped()) {
    value = 0.05 * uniform(engine);
    value += value > 0 ? 0.01 : -0.01;
  }
  return displacements;
}

SensorDesign designWith(bool follows, bool pressureLaw) {
  SensorDesign design = paperDesign();
  design.lowerFollowsRubber = follows;
  if (pressureLaw) design.pressureLaw = PressureLaw{};
  return design;
}

TEST(RowColumnResistance, OfOnePairIsRateTimesDistance) {
  SensorDesign design;
  design.upper = {{10}, {{12}}, {{4}}};
  design.lower = {{15}, {{10}}, {{1}}};
  ElectrodeDisplacements displacements = ElectrodeDisplacements::atRest(design);
  EXPECT_DOUBLE_EQ(rowColumnResistances(design, displacements)(0, 0), 1000 * std::sqrt(18.0));
  displacements.upper_mm.col(0) << 3, 0, 1; // now straight above, 4 mm apart
  EXPECT_DOUBLE_EQ(rowColumnResistances(design, displacements)(0, 0), 4000);
}

TEST(RowColumnResistance, IsNotTakenForTheFields) {
  SensorDesign design = paperDesign();
  design.resistance = FieldLaw{};
  EXPECT_THROW(rowColumnResistances(design, ElectrodeDisplacements::atRest(design)), DesignError);
}

TEST(RowColumnResistance, PairsOfAColumnWireAreParallel) {
  SensorDesign design;
  design.upper = {{10}, {{9, 11}}, {{4}}};
  design.lower = {{10}, {{10, 10.0001}}, {{1}}}; // four pairs of nearly one distance
  const double pair = 1000 * std::sqrt(10.0);
  const ElectrodeDisplacements rest = ElectrodeDisplacements::atRest(design);
  EXPECT_NEAR(rowColumnResistances(design, rest)(0, 0), pair / 4, pair * 1e-6); // the 0.0001 mm move it by 1e-9
}

TEST(RowColumnResistance, IsSumOverAllPairsForThePapersDesign) {
  const SensorDesign design = paperDesign();
  const ElectrodeDisplacements moved = randomDisplacements(design);
  const Eigen::MatrixXd resistances = rowColumnResistances(design, moved);
  ASSERT_EQ(resistances.rows(), 10);
  ASSERT_EQ(resistances.cols(), 30);
  for (const auto& [row, column] : {std::pair{0, 0}, {4, 17}, {9, 29}}) {
    double conductance = 0;
    for (int i = 0; i < 10; ++i)
      for (const double y : {5.0, 15.0, 25.0}) {
        const Eigen::Vector3d upper(1.5 + 3 * i, 1.5 + 3 * row, 4);
        const Eigen::Vector3d lower(0.5 + column, y, 1);
        conductance += 1e-3 / (upper + moved.upper_mm.col(10 * row + i) - lower).norm();
      }
    EXPECT_NEAR(resistances(row, column) * conductance, 1, 1e-13); // 30 terms of one sign
  }
}

TEST(RowColumnResistance, FallsWithPressureByTheLaw) {
  SensorDesign design;
  design.upper = {{10}, {{12}}, {{4}}};
  design.lower = {{12}, {{10}}, {{1}}};
  design.pressureLaw = PressureLaw{0.05, 0.5};
  ElectrodeDisplacements displacements = ElectrodeDisplacements::atRest(design);
  displacements.upperPressure_MPa(0) = 0.15; // (1 + 3)^-0.5 = 1/2
  EXPECT_DOUBLE_EQ(rowColumnResistances(design, displacements)(0, 0), 1500);
  displacements.upperPressure_MPa(0) = -0.15; // tension changes nothing
  EXPECT_DOUBLE_EQ(rowColumnResistances(design, displacements)(0, 0), 3000);
}

TEST(RowColumnResistance, LowerElectrodesMoveOnlyWhereTheyFollowTheRubber) {
  ElectrodeDisplacements displacements = ElectrodeDisplacements::atRest(paperDesign());
  const Eigen::MatrixXd rest = rowColumnResistances(paperDesign(), displacements);
  displacements.lower_mm.row(2).setConstant(0.1);
  EXPECT_EQ(rowColumnResistances(designWith(false, false), displacements), rest);
  EXPECT_LT(rowColumnResistances(designWith(true, false), displacements).sum(), rest.sum()); // nearer, so less
}

TEST(RowColumnResistance, AMotionOfTheWholeSensorChangesNothingWhereAllFollow) {
  const SensorDesign design = designWith(true, false);
  ElectrodeDisplacements displacements = ElectrodeDisplacements::atRest(design);
  const Eigen::MatrixXd rest = rowColumnResistances(design, displacements);
  displacements.upper_mm.colwise() += Eigen::Vector3d(0.3, -0.2, 0.1);
  displacements.lower_mm.colwise() += Eigen::Vector3d(0.3, -0.2, 0.1);
  EXPECT_LT((rowColumnResistances(design, displacements) - rest).cwiseAbs().maxCoeff(), 1e-11 * rest.maxCoeff());
}

class ResistanceJacobian : public testing::TestWithParam<std::tuple<bool, bool>> {};

/// Central differences of rowResistances by one entry of a matrix of displacements.
Eigen::VectorXd differenceQuotient(const SensorDesign& design, ElectrodeDisplacements displacements, int row,
                                   double& (*entry)(ElectrodeDisplacements&, int), int index) {
  const double step = 1e-4; // truncation 1e-8, rounding 1e-12 of R / step: both near 1e-8 of the derivatives
  entry(displacements, index) += step;
  const Eigen::VectorXd above = rowResistances(design, displacements, row);
  entry(displacements, index) -= 2 * step;
  return (above - rowResistances(design, displacements, row)) / (2 * step);
}

TEST_P(ResistanceJacobian, IsTheDerivativeOfTheResistances) {
  const auto [follows, pressureLaw] = GetParam();
  const SensorDesign design = designWith(follows, pressureLaw);
  const ElectrodeDisplacements displacements = randomDisplacements(design);
  const int row = 4;
  RowResistanceJacobian jacobian;
  const Eigen::VectorXd resistances = rowResistances(design, displacements, row, &jacobian);
  EXPECT_EQ(resistances, rowResistances(design, displacements, row));

  const double tolerance = 1e-4; // ohm per mm or MPa, of derivatives of about 10: see the step above
  for (int i = 0; i < 30; ++i)
    EXPECT_LT((differenceQuotient(
                   design, displacements, row,
                   [](ElectrodeDisplacements& d, int k) -> double& { return d.upper_mm(k % 3, 40 + k / 3); }, i) -
               jacobian.upper.col(i))
                  .cwiseAbs()
                  .maxCoeff(),
              tolerance);
  for (int i = 0; i < 90; ++i) { // column 3 j + d of row k belongs to the electrodes of column-wire k alone
    const Eigen::VectorXd quotient = differenceQuotient(
        design, displacements, row,
        [](ElectrodeDisplacements& d, int k) -> double& { return d.lower_mm(k % 3, k / 3); }, i);
    for (int k = 0; k < 30; ++k) EXPECT_NEAR(quotient(k), k == i / 9 ? jacobian.lower(k, i % 9) : 0, tolerance);
  }
  for (int i = 0; i < 10; ++i) // second derivatives by p are 1/p0 = 20 times larger
    EXPECT_LT((differenceQuotient(
                   design, displacements, row,
                   [](ElectrodeDisplacements& d, int k) -> double& { return d.upperPressure_MPa(40 + k); }, i) -
               jacobian.pressure.col(i))
                  .cwiseAbs()
                  .maxCoeff(),
              10 * tolerance);
  EXPECT_EQ(jacobian.lower.isZero(), !follows);
  EXPECT_EQ(jacobian.pressure.isZero(), !pressureLaw);
}

INSTANTIATE_TEST_SUITE_P(BothSwitches, ResistanceJacobian, testing::Combine(testing::Bool(), testing::Bool()));

} // namespace
} // namespace palp
