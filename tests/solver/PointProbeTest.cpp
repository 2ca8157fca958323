#include "solver/PointProbe.h"

#include "model/DesignError.h"
#include "tests/solver/TestBlocks.h"

#include <gtest/gtest.h>

#include <random>

using namespace palp;
using namespace palp::test;

namespace {

LoadIncrement atRest(const Mesh& mesh) {
  const int own = mesh.shape == ElementShape::Tetrahedron10 ? 7 : 1;
  return {1, Eigen::Matrix3Xd::Zero(3, mesh.nodeCount()), Eigen::MatrixXd::Zero(own, mesh.elementCount())};
}

Eigen::Matrix3Xd randomPoints(int count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> inside(0, 1);
  return Eigen::Matrix3Xd::NullaryExpr(3, count, [&](Eigen::Index, Eigen::Index) { return inside(random); });
}

Eigen::Vector3d linear(const Eigen::Vector3d& x) {
  return {0.1 + 0.02 * x.x() - 0.3 * x.y(), 0.5 * x.z() + x.x(), 0.7 - x.y() + 0.01 * x.z()};
}
Eigen::Vector3d quadratic(const Eigen::Vector3d& x) {
  return {x.x() * x.y(), x.z() * x.z() - x.x(), x.y() * x.z() + 2 * x.x() * x.x()};
}

TEST(PointProbe, ReadsLinearFieldsOfDistortedElementsExactly) {
  for (const Mesh& mesh : {cubeTets(3, 0.2), cubeHexes(3, 0.2)}) {
    LoadIncrement state = atRest(mesh);
    for (int n = 0; n < mesh.nodeCount(); ++n) state.displacements_mm.col(n) = linear(mesh.nodes_mm.col(n));
    const Eigen::Matrix3Xd points = randomPoints(200), u = PointProbe(mesh, points).displacements_mm(state);
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      EXPECT_LT((u.col(i) - linear(points.col(i))).norm(), 1e-12); // Newton's iteration in hexahedra ends at 1e-13
  }
}

TEST(PointProbe, ReadsQuadraticFieldsOfTetrahedraExactly) {
  const Mesh mesh = cubeTets(3, 0.2);
  LoadIncrement state = atRest(mesh);
  for (int n = 0; n < mesh.nodeCount(); ++n) state.displacements_mm.col(n) = quadratic(mesh.nodes_mm.col(n));
  const Eigen::Matrix3Xd points = randomPoints(200), u = PointProbe(mesh, points).displacements_mm(state);
  for (Eigen::Index i = 0; i < points.cols(); ++i) EXPECT_LT((u.col(i) - quadratic(points.col(i))).norm(), 1e-12);
}

TEST(PointProbe, AddsTheBubbleThatIsOneAtTheCentroid) {
  const Mesh mesh = cubeTets(2, 0.2);
  LoadIncrement state = atRest(mesh);
  state.elementUnknowns.topRows<3>().setRandom();
  Eigen::Matrix3Xd centroids(3, mesh.elementCount());
  for (int e = 0; e < mesh.elementCount(); ++e)
    centroids.col(e) = mesh.nodes_mm(Eigen::all, mesh.elements.col(e).head<4>()).rowwise().mean();
  const Eigen::Matrix3Xd u = PointProbe(mesh, centroids).displacements_mm(state);
  EXPECT_LT((u - state.elementUnknowns.topRows<3>()).norm(), 1e-12);
}

TEST(PointProbe, ReadsLinearPressuresOfTetrahedraWithCompressionPositive) {
  const Mesh mesh = cubeTets(3, 0.2);
  LoadIncrement state = atRest(mesh);
  const auto tension = [](const Eigen::Vector3d& x) { return 1 + 2 * x.x() - 3 * x.y() + 4 * x.z(); };
  for (int e = 0; e < mesh.elementCount(); ++e)
    for (int k = 0; k < 4; ++k) state.elementUnknowns(3 + k, e) = tension(mesh.nodes_mm.col(mesh.elements(k, e)));
  const Eigen::Matrix3Xd points = randomPoints(100);
  const Eigen::VectorXd p = PointProbe(mesh, points).pressures_MPa(state);
  for (Eigen::Index i = 0; i < points.cols(); ++i) EXPECT_NEAR(p(i), -tension(points.col(i)), 1e-12);
}

TEST(PointProbe, AveragesPressuresThatJumpOverTheElementsThatHoldThePoint) {
  const Mesh mesh = cubeHexes(2, 0);
  LoadIncrement state = atRest(mesh);
  for (int e = 0; e < 8; ++e) state.elementUnknowns(0, e) = -(1 << e);
  Eigen::Matrix3Xd points(3, 3);
  points << 0.5, 0.25, 0.5, 0.5, 0.25, 0.25, 0.5, 0.25, 0.25; // a corner of all, inside the first, a face of two
  const Eigen::VectorXd p = PointProbe(mesh, points).pressures_MPa(state);
  EXPECT_NEAR(p(0), 255. / 8, 1e-12);
  EXPECT_NEAR(p(1), 1, 1e-12);
  EXPECT_NEAR(p(2), 1.5, 1e-12);
}

TEST(PointProbe, ReadsNodesEdgesAndFacesAsFromInside) {
  for (const Mesh& mesh : {cubeTets(2, 0.2), cubeHexes(2, 0.2)}) {
    LoadIncrement state = atRest(mesh);
    state.displacements_mm.setRandom();
    const Eigen::Matrix3Xd u = PointProbe(mesh, mesh.nodes_mm).displacements_mm(state);
    EXPECT_LT((u - state.displacements_mm).cwiseAbs().maxCoeff(), 1e-9); // points on faces are found to 1e-9
  }
}

TEST(PointProbe, RefusesAPointOutside) {
  const Eigen::Matrix3Xd outside = Eigen::Vector3d(0.5, 0.5, 1.001);
  for (const Mesh& mesh : {cubeTets(2, 0), cubeHexes(2, 0)}) EXPECT_THROW(PointProbe(mesh, outside), DesignError);
}

} // namespace
