#include "solver/field/SphericalMeans.h"

#include "solver/SensorMesh.h"
#include "tests/model/RandomLayout.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <functional>
#include <numbers>

namespace palp {
namespace {

constexpr double kRadius = 0.15, kReach = 0.9;

/// The middle of a small block whose l is that of the nodes, quadratic between and cut off below 0.
struct Middle {
  explicit Middle(unsigned seed) : design(randomLayout(seed, 0.8)), mesh(sensorMesh(design)), means(mesh) {}

  [[nodiscard]] AtElectrode around(const std::function<double(const Eigen::Vector3d&)>& l,
                                   const Eigen::Matrix3d& stretch = Eigen::Matrix3d::Identity()) const {
    const Mesh& tets = mesh.tets();
    // So stiff a law that ln(1 + p / p0) is p / p0 to 1e-6.
    FieldConductivity k{Eigen::VectorXd(tets.nodes_mm.cols()), {.p0_MPa = 1e6, .exponent = 2e6}};
    const Eigen::Matrix3Xd nodes = stretch * tets.nodes_mm;
    const Eigen::Vector4d inside(0.1, 0.2, 0.3, 0.4);
    const auto corners = tets.elements.col(element()).head<4>();
    const Eigen::Vector3d centre = nodes(Eigen::all, corners) * inside;
    for (Eigen::Index n = 0; n < nodes.cols(); ++n) k.pressures_MPa(n) = l(nodes.col(n) - centre);
    return means.around(nodes, FieldFunctions(mesh, k, 1), {element(), inside, centre, kRadius, kReach});
  }
  /// The nearest to the middle.
  [[nodiscard]] int element() const {
    const Mesh& tets = mesh.tets();
    Eigen::Index nearest = 0;
    Eigen::VectorXd distance(tets.elements.cols());
    for (Eigen::Index e = 0; e < distance.size(); ++e)
      distance(e) =
          (tets.nodes_mm(Eigen::all, tets.elements.col(e).head<4>()).rowwise().mean() - design.block_mm / 2).norm();
    distance.minCoeff(&nearest);
    return static_cast<int>(nearest);
  }

  SensorDesign design;
  FieldMesh mesh;
  SphericalMeans means;
};

/// Integrals over r from a to the reach, midpoint rule.
double integral(const std::function<double(double)>& of) {
  constexpr int steps = 20000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += of(kRadius + (kReach - kRadius) * (i + 0.5) / steps);
  return sum * (kReach - kRadius) / steps;
}
double chi(double r) {
  return AtElectrode::cutOff(r * r / (kReach * kReach));
}

class SphericalMeansOf : public testing::TestWithParam<unsigned> {};

TEST_P(SphericalMeansOf, ASlopeIsThatOfTheCentreAndHasNoPoles) {
  const Eigen::Vector3d slope(0.1, -0.2, 0.05);
  const AtElectrode found = Middle(GetParam()).around([&](const Eigen::Vector3d& d) { return 5 + slope.dot(d); });
  EXPECT_NEAR(found.value, 5, 1e-4); // of the law
  EXPECT_LT((found.slope - slope).norm(), 1e-4);
  EXPECT_NEAR(found.simple, 0, 1e-5);
  EXPECT_NEAR(found.square, 0, 1e-5);
}

/// L(r) = 5 + c r^2, in a stretched block too: spheres are those of the deformed block.
TEST_P(SphericalMeansOf, ACurvatureHasItsIntegrals) {
  const double c = 0.3;
  Eigen::Matrix3d stretch;
  stretch << 1.1, 0.1, 0, 0, 0.95, 0, 0, 0.05, 0.9;
  for (const Eigen::Matrix3d& by : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), stretch}) {
    const AtElectrode found =
        Middle(GetParam()).around([&](const Eigen::Vector3d& d) { return 5 + c * d.squaredNorm(); }, by);
    const double simple = -integral([&](double r) { return 2 * c * r * chi(r); });
    const double square = -integral([&](double r) { return 2 * c * chi(r); }) / (2 * std::numbers::pi);
    EXPECT_NEAR(found.value, 5 + c * kRadius * kRadius, 1e-4);
    EXPECT_NEAR(found.simple, simple, 1e-3 * std::abs(simple));
    EXPECT_NEAR(found.square, square, 1e-3 * std::abs(square));
  }
}

/// l = max(g (x - b), 0) has L(r) = g (r - b)^2 / (4 r) for r > |b|, wherever in the sphere or beside it the kink is.
TEST_P(SphericalMeansOf, AKinkIsFeltOnTheSphereAndOutside) {
  const double g = 0.5;
  const Eigen::Vector3d normal = Eigen::Vector3d(1, 0.4, 0.3).normalized();
  for (const double b : {0., 0.1, 0.3}) {
    const AtElectrode found =
        Middle(GetParam()).around([&](const Eigen::Vector3d& d) { return g * (normal.dot(d) - b); });
    const auto mean = [&](double r) { return r > b ? g * (r - b) * (r - b) / (4 * r) : 0; };
    const auto rise = [&](double r) { return r > b ? g * (1 - b * b / (r * r)) / 4 : 0; };
    const double simple = -integral([&](double r) { return rise(r) * chi(r); });
    const double square = -integral([&](double r) { return rise(r) * chi(r) / r; }) / (2 * std::numbers::pi);
    EXPECT_NEAR(found.value, mean(kRadius), 0.02 * g * kRadius) << b; // 50 points on a kink
    EXPECT_NEAR(found.simple, simple, 0.05 * std::abs(simple)) << b;
    EXPECT_NEAR(found.square, square, 0.05 * std::abs(square)) << b;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SphericalMeansOf, testing::Values(1U, 7U, 23U));

} // namespace
} // namespace palp
