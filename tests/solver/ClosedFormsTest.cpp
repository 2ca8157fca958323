#include "tests/solver/TestBlocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <ostream>

using namespace palp;
using namespace palp::test;

namespace {

bool isTop(const Eigen::Vector3d& x) {
  return x.z() > 1 - 1e-9;
}
bool onBoundary(const Eigen::Vector3d& x) {
  return x.minCoeff() < 1e-9 || x.maxCoeff() > 1 - 1e-9;
}

enum class Shape { Tets, Hexes };
/// In the names of the tests.
void PrintTo(Shape shape, std::ostream* out) {
  *out << (shape == Shape::Tets ? "tetrahedra" : "hexahedra");
}
Mesh distorted(Shape shape) {
  return shape == Shape::Tets ? cubeTets(2, 0.2) : cubeHexes(3, 0.2);
}

/// Nominal stress of a cube with symmetry planes at the axes whose top is moved to `stretch`.
double uniaxialStress(Shape shape, double stretch, double poissonRatio) {
  const BoundaryValueProblem p(distorted(shape), rubberOf(poissonRatio), [&](const Eigen::Vector3d& x, int d) {
    if (x(d) < 1e-9) return std::optional(0.);
    return d == 2 && isTop(x) ? std::optional(stretch - 1) : std::nullopt;
  });
  const NewtonResult result = p.solve();
  EXPECT_TRUE(result.converged) << result.stopReason;
  return p.reaction(result, 2, isTop);
}

class OnBothElements : public testing::TestWithParam<Shape> {};
INSTANTIATE_TEST_SUITE_P(Distorted, OnBothElements, testing::Values(Shape::Tets, Shape::Hexes));

constexpr double eightDigits = 1e-8;
constexpr double printed = 6e-7; // half a unit of the sixth digit

/// Principal nominal stress dW/dl_i of W = c10 (J^-2/3 I1 - 3) + c01 (J^-4/3 I2 - 3) + kappa/2 (J - 1)^2 [MPa].
double principalStress(const Material& material, const Eigen::Vector3d& l, int i) {
  const auto& m = std::get<MooneyRivlin>(material.law);
  const double J = l.prod(), I1 = l.squaredNorm(), s = l(i) * l(i);
  const double I2 = (I1 * I1 - l.array().pow(4).sum()) / 2;
  return m.c10_MPa * std::pow(J, -2. / 3) * (2 * l(i) - 2. / 3 * I1 / l(i)) +
         m.c01_MPa * std::pow(J, -4. / 3) * (2 * l(i) * (I1 - s) - 4. / 3 * I2 / l(i)) +
         material.bulkModulus_MPa() * (J - 1) * J / l(i);
}

/// Uniaxial nominal stress: the transverse stretch that leaves the sides free is found by bisection.
double uniaxialClosedForm(const Material& m, double stretch) {
  double low = 0.5 / std::sqrt(stretch), high = 2 / std::sqrt(stretch);
  for (int k = 0; k < 200; ++k) {
    const double t = (low + high) / 2;
    (principalStress(m, {t, t, stretch}, 0) > 0 ? high : low) = t;
  }
  return principalStress(m, {low, low, stretch}, 2);
}

TEST_P(OnBothElements, GiveTheUniaxialStressOfCompressibleRubber) {
  const double stretches[] = {0.5, 0.8, 0.9, 1.1, 1.5, 2};
  const double stresses[] = {-3.447460, -0.657303, -0.280777, 0.220481, 0.808503, 1.291775};
  for (int i = 0; i < 6; ++i) {
    const double closed = uniaxialClosedForm(rubberOf(0.499), stretches[i]);
    EXPECT_NEAR(closed, stresses[i], printed);
    EXPECT_NEAR(uniaxialStress(GetParam(), stretches[i], 0.499), closed, eightDigits);
  }
}

TEST_P(OnBothElements, GiveTheUniaxialStressOfIncompressibleRubberToEightDigits) {
  const MooneyRivlin m;
  for (const double l : {0.6, 0.9, 1.2, 1.8})
    EXPECT_NEAR(uniaxialStress(GetParam(), l, 0.5), 2 * (l - 1 / (l * l)) * (m.c10_MPa + m.c01_MPa / l), eightDigits);
}

TEST_P(OnBothElements, GiveTheEquibiaxialStress) {
  const BoundaryValueProblem p(distorted(GetParam()), rubberOf(0.5), [](const Eigen::Vector3d& x, int d) {
    if (x(d) < 1e-9) return std::optional(0.);
    return d < 2 && x(d) > 1 - 1e-9 ? std::optional(0.5) : std::nullopt;
  });
  const NewtonResult result = p.solve();
  ASSERT_TRUE(result.converged) << result.stopReason;
  const MooneyRivlin m;
  const double l = 1.5, closed = 2 * (l - std::pow(l, -5)) * (m.c10_MPa + m.c01_MPa * l * l);
  EXPECT_NEAR(closed, 1.405086, printed);
  EXPECT_NEAR(p.reaction(result, 0, [](const Eigen::Vector3d& x) { return x.x() > 1 - 1e-9; }), closed, eightDigits);
}

TEST_P(OnBothElements, GiveTheStressOfConfinedCompression) {
  const double stretches[] = {0.999, 0.99, 0.98}, stresses[] = {-0.411847, -4.118598, -8.237491};
  for (int i = 0; i < 3; ++i) {
    const BoundaryValueProblem p(distorted(GetParam()), rubberOf(0.499), [&](const Eigen::Vector3d& x, int d) {
      if (d < 2 && (x(d) < 1e-9 || x(d) > 1 - 1e-9)) return std::optional(0.);
      if (d == 2 && x.z() < 1e-9) return std::optional(0.);
      return d == 2 && isTop(x) ? std::optional(stretches[i] - 1) : std::nullopt;
    });
    const NewtonResult result = p.solve();
    ASSERT_TRUE(result.converged) << result.stopReason;
    const double closed = principalStress(rubberOf(0.499), {1, 1, stretches[i]}, 2);
    EXPECT_NEAR(closed, stresses[i], printed);
    EXPECT_NEAR(p.reaction(result, 2, isTop), closed, eightDigits);
  }
}

TEST_P(OnBothElements, GiveTheStressesOfSimpleShear) {
  // Sheared along x with the height z: the closed form's axis 2 is z here.
  const BoundaryValueProblem p(distorted(GetParam()), rubberOf(0.499), [](const Eigen::Vector3d& x, int d) {
    return onBoundary(x) ? std::optional(d == 0 ? 0.5 * x.z() : 0.) : std::nullopt;
  });
  const NewtonResult result = p.solve();
  ASSERT_TRUE(result.converged) << result.stopReason;
  // Mean stress by the forces on the boundary: P_ij = sum of f_i X_j.
  double work = 0;
  for (int n = 0; n < p.mesh.nodeCount(); ++n) work += result.internalForces(3 * n) * p.mesh.nodes_mm(2, n);
  EXPECT_NEAR(work, 0.41075, eightDigits);
  double p21 = 0, p33 = 0, p11 = 0;
  for (int n = 0; n < p.mesh.nodeCount(); ++n) {
    p21 += result.internalForces(3 * n + 2) * p.mesh.nodes_mm(0, n);
    p33 += result.internalForces(3 * n + 1) * p.mesh.nodes_mm(1, n);
    p11 += result.internalForces(3 * n) * p.mesh.nodes_mm(0, n);
  }
  EXPECT_NEAR(p21, 0.451825, eightDigits);
  EXPECT_NEAR(p33, -0.041075, eightDigits);
  EXPECT_NEAR(p11, -0.08215, eightDigits);
}

TEST_P(OnBothElements, PassThePatchTest) {
  const auto linear = [](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(0.02 * x.x() + 0.03 * x.y() - 0.01 * x.z(), 0.04 * x.z() - 0.01 * x.y(),
                           0.02 * x.x() - 0.01 * x.z());
  };
  const BoundaryValueProblem p(distorted(GetParam()), rubberOf(0.499), [&](const Eigen::Vector3d& x, int d) {
    return onBoundary(x) ? std::optional(linear(x)(d)) : std::nullopt;
  });
  const NewtonResult result = p.solve();
  ASSERT_TRUE(result.converged) << result.stopReason;
  for (int n = 0; n < p.mesh.nodeCount(); ++n)
    EXPECT_LT((result.increments.back().state.displacements.segment<3>(3 * n) - linear(p.mesh.nodes_mm.col(n))).norm(),
              1e-10);
}

TEST(Torsion, OfACylinderGivesRivlinsMomentAndAxialForce) {
  constexpr double radius = 5, height = 5, twist = 0.1;
  constexpr int cells = 8;
  // A polygon of 4 cells sides with the circle's polar moment: 4 cells r^4 sin(t) (2 + cos(t)) / 12, t its angle.
  constexpr double t = 2 * std::numbers::pi / (4 * cells);
  const double polygon =
      radius * std::pow(std::numbers::pi / 2 / (4 * cells * std::sin(t) * (2 + std::cos(t)) / 12), 0.25);
  const Mesh mesh = cylinderTets(cells, polygon, height);
  const BoundaryValueProblem p(mesh, rubberOf(0.5), [&](const Eigen::Vector3d& x, int d) {
    if (x.z() > 1e-9 && x.z() < height - 1e-9) return std::optional<double>{};
    const double angle = twist * x.z(), c = std::cos(angle), s = std::sin(angle);
    const Eigen::Vector3d u(c * x.x() - s * x.y() - x.x(), s * x.x() + c * x.y() - x.y(), 0);
    return std::optional(u(d));
  });
  const NewtonResult result = p.solve(1e-9);
  ASSERT_TRUE(result.converged) << result.stopReason;
  double moment = 0, axial = 0;
  for (int n = 0; n < mesh.nodeCount(); ++n) {
    const Eigen::Vector3d X = mesh.nodes_mm.col(n);
    if (X.z() < height - 1e-9) continue;
    const Eigen::Vector3d x = X + result.increments.back().state.displacements.segment<3>(3 * n);
    moment += x.x() * result.internalForces(3 * n + 1) - x.y() * result.internalForces(3 * n);
    axial += result.internalForces(3 * n + 2);
  }
  EXPECT_NEAR(moment, 80.6506, 0.01 * 80.6506);
  EXPECT_NEAR(axial, -4.8390, 0.01 * 4.8390);
}

TEST(BondedBlock, InCompressionHasGentAndLindleysModulus) {
  const Mesh mesh = cylinderTets(10, 3, 1); // shape factor radius / (2 height) = 1.5
  constexpr double strain = 0.001;
  const BoundaryValueProblem p(mesh, rubberOf(0.499), [&](const Eigen::Vector3d& x, int d) {
    if (x.z() < 1e-9) return std::optional(0.);
    return isTop(x) ? std::optional(d == 2 ? -strain : 0.) : std::nullopt;
  });
  const NewtonResult result = p.solve(1e-9);
  ASSERT_TRUE(result.converged);
  EXPECT_NEAR(-p.reaction(result, 2, isTop) / (9 * std::numbers::pi) / strain, 13.1,
              0.1 * 13.1); // the formula is good to 5 to 10 %
}

} // namespace
