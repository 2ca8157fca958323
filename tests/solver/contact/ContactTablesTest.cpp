#include "solver/HyperelasticProblem.h"
#include "solver/SensorMesh.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

struct StripCase {
  double halfWidth_mm, depthRate, forceRate;
  int elementsAcross;
};
void PrintTo(const StripCase& strip, std::ostream* out) {
  *out << "b " << strip.halfWidth_mm << " mm";
}

class PlaneStrain : public testing::TestWithParam<StripCase> {};

/// Force [N] on a cylinder along y that lies across a block of this length. Along y the elements may be long: in the
/// middle nothing changes there.
double cylinderForce_N(double length_mm, const Indenter& cylinder, int elementsAcross) {
  SensorDesign design = paperDesign();
  design.block_mm.x() = 60;
  design.block_mm.y() = length_mm;
  MeshOptions options;
  options.mapped = {{elementsAcross, static_cast<int>(length_mm / 12.5), 8}};
  LoadCase load;
  load.indenters = {cylinder};
  const Solution solution = HyperelasticProblem(design, sensorMesh(design, options)).solve(load);
  EXPECT_TRUE(solution.converged) << solution.stopReason;
  return -solution.state().indenters[0].force_N.z();
}

/// Rows of a bonded layer in plane strain, nu = 0.499 (integral equation of the strip, solved anew): d R / b^2 and
/// P R (1 - nu) / (G b^2). What the free ends take away cancels between blocks of two lengths, if they are long: the
/// ends are felt to exp(-0.74 y / h).
TEST_P(PlaneStrain, ACylinderPressesABondedLayerAsTheClosedFormSays) {
  const auto& [b, depthRate, forceRate, elementsAcross] = GetParam();
  const Material rubber = paperDesign().material;
  ASSERT_EQ(rubber.poissonRatio, 0.499) << "the rows are for this one";
  const double R = 500;
  const Indenter cylinder{
      IndenterShape::CylinderY, R, 0, {30, 50}, 0, Motion{depthRate * b * b / R, Eigen::Vector2d::Zero()}};
  const double aLength = (cylinderForce_N(150, cylinder, elementsAcross) - //
                          cylinderForce_N(100, cylinder, elementsAcross)) /
                         50;
  const double expected = forceRate * rubber.shearModulus_MPa() * b * b / (R * (1 - rubber.poissonRatio));
  EXPECT_NEAR(aLength, expected, 0.01 * expected);
}

INSTANTIATE_TEST_SUITE_P(Rows, PlaneStrain,
                         testing::Values(StripCase{2.5, 0.61109, 1.95838, 120}, StripCase{4, 0.48679, 2.51304, 96},
                                         StripCase{5, 0.44076, 2.98402, 72}),
                         [](const auto& row) { return "Row" + std::to_string(row.index); });

} // namespace
} // namespace palp
