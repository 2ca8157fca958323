#include "solver/assembly/SurfaceTraction.h"

#include "model/DesignError.h"
#include "solver/SensorMesh.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <ostream>

namespace palp {
/// In the names of the tests.
static void PrintTo(ElementShape shape, std::ostream* out) {
  *out << (shape == ElementShape::Tetrahedron10 ? "tetrahedra" : "hexahedra");
}
} // namespace palp

using namespace palp;

namespace {

constexpr double rounding = 1e-12;

class Tractions : public testing::TestWithParam<ElementShape> {
protected:
  SensorDesign design_ = paperDesign();
  Mesh mesh_ = GetParam() == ElementShape::Tetrahedron10
                   ? sensorMesh(design_, {.meshSize_mm = 8, .mapped = {}})
                   : sensorMesh(design_, {.meshSize_mm = {}, .mapped = std::array{7, 5, 2}});
  [[nodiscard]] bool tets() const { return GetParam() == ElementShape::Tetrahedron10; }
  /// Mean of a function over the region: the shares' sum of its values at the nodes, where the shapes represent it.
  [[nodiscard]] double mean(const Eigen::Matrix2Xd& region,
                            const std::function<double(double x, double y)>& function) const {
    double sum = 0;
    for (const NodeShare& s : tractionShares(mesh_, region))
      sum += s.share * function(mesh_.nodes_mm(0, s.node), mesh_.nodes_mm(1, s.node));
    return sum;
  }
};
INSTANTIATE_TEST_SUITE_P(Meshes, Tractions, testing::Values(ElementShape::Tetrahedron10, ElementShape::Hexahedron8));

TEST_P(Tractions, OfEveryAreaSumToTheForceAndActAtItsCentre) {
  for (int area = 0; area < design_.areas.count(); ++area) {
    const Rectangle r = design_.areaRectangle(area);
    const Eigen::Vector2d centre = (r.low_mm + r.high_mm) / 2;
    const Eigen::Matrix2Xd region = regionOf(r);
    EXPECT_NEAR(mean(region, [](double, double) { return 1; }), 1, rounding);
    EXPECT_NEAR(mean(region, [](double x, double) { return x; }), centre.x(), 30 * rounding);
    EXPECT_NEAR(mean(region, [](double, double y) { return y; }), centre.y(), 30 * rounding);
    EXPECT_NEAR(mean(region, [](double x, double y) { return x * y; }), centre.prod(), 900 * rounding);
  }
}

TEST_P(Tractions, OfDiscsAnywhereSumToTheForceAndActAtTheirCentre) {
  for (const PatchLoad& patch : {PatchLoad{{11.3, 17.9}, 4, {}}, PatchLoad{{15, 15}, 15, {}},
                                 PatchLoad{{2.2, 28}, 0.4, {}}, PatchLoad{{10, 15}, 0.01, {}}}) {
    const Eigen::Matrix2Xd region = regionOf(patch);
    const Eigen::Vector2d c = patch.centre_mm;
    // Sums of differences of numbers up to 30, over areas down to 1e-4 of a face's.
    const double tolerance = patch.radius_mm < 0.1 ? 1e-7 : 1e-9;
    EXPECT_NEAR(mean(region, [](double, double) { return 1; }), 1, rounding);
    EXPECT_NEAR(mean(region, [](double x, double) { return x; }), c.x(), tolerance);
    EXPECT_NEAR(mean(region, [](double, double y) { return y; }), c.y(), tolerance);
    EXPECT_NEAR(mean(region, [](double x, double y) { return x * y; }), c.prod(), 30 * tolerance);
  }
}

TEST_P(Tractions, OfQuadraticFacesHaveTheRegionsSecondMoments) {
  if (!tets()) GTEST_SKIP() << "bilinear shapes do not represent squares";
  const Rectangle area = design_.areaRectangle(4);
  const Eigen::Vector2d size = area.high_mm - area.low_mm, centre = (area.low_mm + area.high_mm) / 2;
  EXPECT_NEAR(mean(regionOf(area), [&](double x, double) { return (x - centre.x()) * (x - centre.x()); }),
              size.x() * size.x() / 12, 900 * rounding);
  const PatchLoad patch{{13.1, 12.4}, 6, {}};
  EXPECT_NEAR(mean(regionOf(patch),
                   [&](double x, double y) { return (Eigen::Vector2d(x, y) - patch.centre_mm).squaredNorm(); }),
              36. / 2, 36. / 2 * 1e-4); // a polygon of 256 sides instead of the circle: (2 pi / 256)^2 / 6 at most
}

TEST_P(Tractions, TakeEachFacesShareAsItsShapesDo) {
  // A uniform traction on a quadratic triangle acts on its midpoints alone, a third each; on a rectangle a quarter on
  // each corner.
  const Eigen::Matrix2Xd region = regionOf(design_.areaRectangle(2));
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(mesh_.nodeCount());
  double total = 0;
  for (Eigen::Index f = 0; f < mesh_.topFaces.cols(); ++f) {
    if (tets() && mesh_.topFaceAreas(f) != 2) continue;
    const auto at = [&](int n) { return Eigen::Vector3d(mesh_.nodes_mm.col(mesh_.topFaces(n, f))); };
    if (tets()) {
      const double area = (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
      for (int n = 3; n < 6; ++n) expected(mesh_.topFaces(n, f)) += area / 3;
      total += area;
    }
  }
  if (!tets()) GTEST_SKIP() << "the mapped mesh does not meet the areas' borders: its moments are tested above";
  expected /= total;
  for (const NodeShare& s : tractionShares(mesh_, region)) expected(s.node) -= s.share;
  EXPECT_LT(expected.cwiseAbs().maxCoeff(), rounding);
}

TEST_P(Tractions, OfALoadAddUpItsPartsAndActOnTheTopFaceAlone) {
  const LoadCase load{{{0, {1, 0.5, -6}}, {0, {0, 0, -1}}, {4, {-1, 1, -2}}}, {{{11, 17}, 2.5, {0.5, 0.2, -3}}}};
  const Eigen::VectorXd forces = nodalForces(mesh_, design_, load);
  Eigen::Vector3d total = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero(), expected = moment;
  for (int n = 0; n < mesh_.nodeCount(); ++n) {
    const Eigen::Vector3d force = forces.segment<3>(3 * n);
    total += force;
    moment += mesh_.nodes_mm.col(n).cross(force);
    if (mesh_.nodes_mm(2, n) < design_.block_mm.z()) {
      EXPECT_EQ(force.norm(), 0) << n;
    }
  }
  const auto add = [&](const Eigen::Vector2d& at, const Eigen::Vector3d& force) {
    expected += Eigen::Vector3d(at.x(), at.y(), design_.block_mm.z()).cross(force);
  };
  for (const AreaLoad& a : load.areas) {
    const Rectangle r = design_.areaRectangle(a.area);
    add((r.low_mm + r.high_mm) / 2, a.force_N);
  }
  add(load.patches[0].centre_mm, load.patches[0].force_N);
  EXPECT_LT((total - load.totalForce_N()).norm(), 100 * rounding);
  EXPECT_LT((moment - expected).norm(), 1e-8); // N mm, of 100
}

TEST_P(Tractions, OfALoadThatCannotActAreRefused) {
  EXPECT_THROW(static_cast<void>(nodalForces(mesh_, design_, {{{6, {0, 0, -1}}}, {}})), DesignError);
  EXPECT_THROW(static_cast<void>(nodalForces(mesh_, design_, {{}, {{{15, 15}, 1e-200, {0, 0, -1}}}})), DesignError);
}

} // namespace
