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

/// A bonded layer, nu = 0.499, pressed by a punch with its rim: the integral equation of the layer (Hayes, Keer,
/// Herrmann and Mockros 1972) for the profile 0 to r = 1.8 mm, then an arc of 0.2 mm, solved anew; the contact ends on
/// the rim at r = 1.81805 mm. A sharp edge of 2 mm would take 16 % more, one of 1.8 mm 1 % less.
TEST(FlatPunch, PressesABondedLayerAsTheClosedFormOfItsRimSays) {
  const SensorDesign design = paperDesign();
  LoadCase load;
  load.indenters = {{IndenterShape::Flat, 2, 0.2, {15, 15}, 0, Motion{0.01, Eigen::Vector2d::Zero()}}};
  MeshOptions options = meshFor(design, load, {});
  options.meshSize_mm = 2 * standardMeshSize_mm(design); // 0.03 % of error all the same
  const Solution solution = HyperelasticProblem(design, sensorMesh(design, options)).solve(load);
  ASSERT_TRUE(solution.converged) << solution.stopReason;
  constexpr double kForce_N = 0.189554;
  EXPECT_NEAR(-solution.state().indenters[0].force_N.z(), kForce_N, 0.01 * kForce_N);
}

} // namespace
} // namespace palp
