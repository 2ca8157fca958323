#include "solver/ConductionField.h"

#include "model/DesignError.h"
#include "model/FieldAtRest.h"
#include "solver/ConductionBatch.h"
#include "solver/SensorMesh.h"
#include "tests/model/RandomLayout.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>

namespace palp {
namespace {

SensorDesign smallDesign(Readout readout = Readout::VirtualGround) {
  SensorDesign design = randomLayout(11, 0.8);
  design.areas = {2, 1};
  design.forceRange = {{-0.3, -0.3, -1}, {0.3, 0.3, 0}};
  design.resistance = FieldLaw{.electrodeRadius_mm = 0.1, .readout = readout};
  return design;
}

/// A small sensor under the field and its state under a force on its first area.
struct Pressed {
  explicit Pressed(const SensorDesign& design, const Eigen::Vector3d& force_N = {0.2, 0, -0.8})
      : problem(design, sensorMesh(design)), field(problem), solution(problem.solve({{{0, force_N}}, {}})) {}
  [[nodiscard]] Eigen::MatrixXd logResistances(Readout readout) const {
    return NetworkReading(*field.network(solution.state(), 2), readout).resistances_ohm().array().log();
  }
  HyperelasticProblem problem;
  ConductionField field;
  Solution solution;
};

Eigen::MatrixXd logAtRest(const SensorDesign& design, Readout readout) {
  return NetworkReading(networkAtRest(design, *design.field()), readout).resistances_ohm().array().log();
}

TEST(ConductionField, OfABlockAtRestIsTheClosedFormToRounding) {
  const SensorDesign design = smallDesign();
  const Pressed block(design, {0, 0, 0});
  for (const Readout readout : {Readout::Floating, Readout::VirtualGround})
    EXPECT_LT((block.logResistances(readout) - logAtRest(design, readout)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(ConductionField, HeldElectrodesFeelTheBlockAndThoseThatFollowItFeelMore) {
  SensorDesign design = smallDesign();
  const Pressed held(design);
  design.lowerFollowsRubber = true;
  const Pressed following(design);
  const Eigen::MatrixXd rest = logAtRest(design, Readout::VirtualGround);
  const Eigen::MatrixXd a = held.logResistances(Readout::VirtualGround) - rest,
                        b = following.logResistances(Readout::VirtualGround) - rest;
  EXPECT_GT(a.norm(), 0);
  EXPECT_GT((a - b).norm(), 1e-3 * a.norm());
}

TEST(ConductionField, RefusesAnotherLawAndAPressureLaw) {
  SensorDesign design = smallDesign();
  const Mesh mesh = sensorMesh(design, {.meshSize_mm = {}, .mapped = std::array<int, 3>{4, 4, 2}});
  design.pressureLaw = PressureLaw{};
  EXPECT_THROW(ConductionField(HyperelasticProblem(design, mesh)), DesignError);
  design.pressureLaw.reset();
  design.resistance = PairsLaw{};
  EXPECT_THROW(ConductionField(HyperelasticProblem(design, mesh)), DesignError);
}

TEST(ConductionField, TheCurrentsPowerIsThatOfOneVolt) {
  const SensorDesign design = smallDesign(Readout::Floating);
  const Pressed block(design);
  const auto current = block.field.current(block.solution.state(), 0, 1);
  ASSERT_TRUE(current);
  EXPECT_GE(current->potential_V.minCoeff(), -0.05); // between those of the two wires, but for the mesh
  EXPECT_LE(current->potential_V.maxCoeff(), 1.05);
  EXPECT_GT(current->potential_V.maxCoeff() - current->potential_V.minCoeff(), 0.3);
  const FieldLaw& law = *design.field();
  const Eigen::VectorXd power =
      law.resistivity_ohm_mm * current->currentDensity_A_per_mm2.colwise().squaredNorm().transpose();
  EXPECT_LT((power - current->powerDensity_W_per_mm3).norm(), 1e-12 * power.norm());
}

TEST(ConductionField, StopsWhereItIsAsked) {
  const Pressed block(smallDesign());
  std::stop_source source;
  source.request_stop();
  EXPECT_FALSE(block.field.network(block.solution.state(), 1, source.get_token()));
}

TEST(ConductionBatch, SolvesAndPolynomialsAgreeWithSingleStates) {
  const SensorDesign design = smallDesign();
  const Pressed block(design, {0.1, -0.2, -0.5});
  const std::vector<LoadCase> loads{{{{0, {0.1, -0.2, -0.5}}}, {}}};
  const Eigen::MatrixXd change =
      block.logResistances(Readout::VirtualGround) - logAtRest(design, Readout::VirtualGround);
  for (const bool surrogate : {false, true}) {
    const BatchOptions options{.surrogate = surrogate, .threads = 2};
    BatchSolver batch(block.problem, options);
    ConductionBatch field(block.problem, batch, options);
    const auto answers = field.solve(loads, {}, {});
    ASSERT_EQ(answers.resistances_ohm.size(), 1U);
    const Eigen::MatrixXd found =
        (answers.resistances_ohm[0].array().log() - logAtRest(design, Readout::VirtualGround).array()).matrix();
    const double error = (found - change).norm() / change.norm();
    EXPECT_LT(error, surrogate ? 5e-3 : 1e-4) << field.surrogateError();
    if (surrogate) {
      EXPECT_GT(field.surrogateError(), 0);
      EXPECT_LT(error, 10 * field.surrogateError()) << "its measured error says what to expect";
    }
  }
}

} // namespace
} // namespace palp
