#include "solver/InfluenceSurfaces.h"

#include "solver/HyperelasticProblem.h"
#include "solver/PointProbe.h"
#include "solver/SensorMesh.h"
#include "solver/TouchFields.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace palp {
namespace {

/// Displacements along x, y and z at points inside elements, where the bubbles count, and at one on the top face.
LinearReadings displacements() {
  LinearReadings readings;
  readings.points_mm.resize(3, 4);
  readings.points_mm << 10.3, 14.1, 20.9, 12.2, 12.7, 16.2, 8.4, 11.1, 2.9, 3.6, 1.7, 5;
  readings.gradient_per_mm = Eigen::MatrixXd::Identity(12, 12);
  return readings;
}

HyperelasticProblem block(double meshSize_mm) {
  const SensorDesign design = paperDesign();
  MeshOptions options;
  options.meshSize_mm = meshSize_mm;
  options.electrodesAsNodes = false;
  return {design, sensorMesh(design, options)};
}

Eigen::VectorXd read(const HyperelasticProblem& problem, const LoadCase& load, double tolerance) {
  NewtonOptions options;
  options.relativeTolerance = tolerance;
  const Solution solution = problem.solve(load, options);
  EXPECT_TRUE(solution.converged) << solution.stopReason;
  return PointProbe(problem.mesh(), displacements().points_mm).displacements_mm(solution.state()).reshaped();
}

TEST(InfluenceSurfaces, AreWhatASolveForALoadedAreaSays) {
  const HyperelasticProblem problem = block(2.5);
  const auto surfaces = InfluenceSurfaces::find(problem, displacements(), 0);
  ASSERT_TRUE(surfaces);
  const Rectangle area = problem.design().areaRectangle(1);
  constexpr int n = 80; // cells of the midpoint rule along each side
  Eigen::Matrix2Xd points(2, n * n);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k)
      points.col(n * i + k) =
          area.low_mm.array() + Eigen::Array2d(i + 0.5, k + 0.5) / n * (area.high_mm - area.low_mm).array();
  Eigen::MatrixX3d influence = Eigen::MatrixX3d::Zero(12, 3);
  for (const Eigen::MatrixX3d& of : surfaces->at(points)) influence += of / (n * n);
  constexpr double small_N = 1e-4;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::VectorXd solved =
        read(problem, {{{1, small_N * Eigen::Vector3d::Unit(axis)}}, {}, {}}, 1e-9) / small_N;
    EXPECT_LT((influence.col(axis) - solved).norm(), 1e-3 * solved.norm()) << "force along axis " << axis;
  }
}

TEST(InfluenceSurfaces, OfATouchAreWhatFullNewtonSaysOfASmallOne) {
  const SensorDesign design = paperDesign();
  const double force_N = -1;
  const Indenter touch{IndenterShape::Sphere, 9, 0, {12.4, 13.7}, 0, Press{{0, 0, force_N}}};
  const LoadCase load{{}, {}, {touch}};
  MeshOptions options;
  options.meshSize_mm = 3;
  options.electrodesAsNodes = false;
  const HyperelasticProblem problem(design, sensorMesh(design, meshFor(design, load, options)));
  const auto surfaces = InfluenceSurfaces::find(problem, displacements(), 0);
  ASSERT_TRUE(surfaces);
  const TouchInfluence influence = surfaces->of(std::array{touch}, 0).front();
  const Eigen::VectorXd solved = read(problem, load, 1e-8) / force_N;
  EXPECT_LT((influence.perNewton.col(2) - solved).norm(), 0.03 * solved.norm());
  const double radius_mm = std::cbrt(3 * 9 / (16 * design.material.shearModulus_MPa())); // Hertz, of a half-space
  EXPECT_NEAR(influence.radius_mm, radius_mm, 0.05 * radius_mm);
}

TEST(InfluenceSurfaces, OfFewerReadingsAreTheSameAndEachOneIsCounted) {
  const HyperelasticProblem problem = block(2.5);
  LinearReadings some = displacements();
  some.gradient_per_mm = Eigen::MatrixXd(some.gradient_per_mm(std::array{7, 2}, Eigen::all));
  std::size_t counted = 0;
  const auto all = InfluenceSurfaces::find(problem, displacements(), 2);
  const auto found = InfluenceSurfaces::find(problem, some, 2, {}, [&](std::size_t more) { counted += more; });
  ASSERT_TRUE(all && found);
  EXPECT_EQ(counted, 2u);
  const Eigen::Vector3d block_mm = problem.design().block_mm;
  Eigen::Matrix2Xd points(2, 3);
  points << 11, 0, block_mm.x(), 14, 0, block_mm.y() / 3; // corners and edges of the face, too
  const auto of = all->at(points), less = found->at(points);
  for (std::size_t p = 0; p < of.size(); ++p) {
    const Eigen::MatrixX3d same = of[p](std::array{7, 2}, Eigen::all);
    EXPECT_LT((less[p] - same).norm(), 1e-12 * same.norm() + 1e-300) << p;
  }
}

TEST(InfluenceSurfaces, FollowThePlaceAsTheirDifferencesDo) {
  const HyperelasticProblem problem = block(2);
  LinearReadings inside = displacements();
  inside.points_mm.conservativeResize(3, 3); // on the face they change at once where a touch comes to them
  inside.gradient_per_mm = Eigen::MatrixXd::Identity(9, 9);
  const auto surfaces = InfluenceSurfaces::find(problem, inside, 0);
  ASSERT_TRUE(surfaces);
  constexpr double shift_mm = 0.4;
  for (const IndenterShape shape : {IndenterShape::Sphere, IndenterShape::Flat}) {
    std::vector<Indenter> touches(5, {shape, 3, 0.3, {11, 14}, 0, Press{{0, 0, -2}}});
    for (int axis = 0; axis < 2; ++axis)
      for (int side = 0; side < 2; ++side)
        touches[static_cast<std::size_t>(1 + 2 * axis + side)].place_mm(axis) += (side == 0 ? 1 : -1) * shift_mm;
    const std::vector<TouchInfluence> of = surfaces->of(touches, 0);
    for (int axis = 0; axis < 2; ++axis) {
      const auto at = static_cast<std::size_t>(1 + 2 * axis);
      const Eigen::VectorXd difference = (of[at].perNewton - of[at + 1].perNewton).col(2) / (2 * shift_mm);
      EXPECT_LT((of[0].byPlace_per_Nmm.col(axis) - difference).norm(), 0.05 * difference.norm())
          << shapeName(shape) << ' ' << axis;
    }
  }
}

/// By reciprocity: the block moves under touches as the touches' places move under the readings.
TEST(TouchFields, SayOfReadingsWhatInfluenceSurfacesSayOfTouches) {
  const HyperelasticProblem problem = block(3);
  const std::vector<Indenter> touches{{IndenterShape::Sphere, 4, 0, {11, 14}, 0, Press{{0, 0, -2}}},
                                      {IndenterShape::Flat, 2, 0.3, {1, 27}, 0, Press{{0, 0, -1}}}};
  const auto surfaces = InfluenceSurfaces::find(problem, displacements(), 0);
  const auto fields = TouchFields::find(problem, touches, 2), again = TouchFields::find(problem, touches, 1);
  ASSERT_TRUE(surfaces && fields && again);
  const std::vector<TouchInfluence> by = surfaces->of(touches, 0), found = fields->of(displacements(), 2),
                                    same = again->of(displacements(), 1);
  for (std::size_t t = 0; t < touches.size(); ++t) {
    EXPECT_EQ(found[t].radius_mm, by[t].radius_mm);
    EXPECT_LT((found[t].perNewton - by[t].perNewton).norm(), 1e-9 * by[t].perNewton.norm()) << t;
    EXPECT_LT((found[t].byPlace_per_Nmm - by[t].byPlace_per_Nmm).norm(), 1e-7 * by[t].byPlace_per_Nmm.norm()) << t;
    EXPECT_EQ(found[t].perNewton, same[t].perNewton);
  }
}

TEST(InfluenceSurfaces, AreTheSameBytesAtAnyNumberOfThreads) {
  const HyperelasticProblem problem = block(4);
  const std::vector<Indenter> touches(20, {IndenterShape::Pin, 2, 0, {9, 21}, 0, Press{{0, 0, -1}}});
  const auto one = InfluenceSurfaces::find(problem, displacements(), 1),
             three = InfluenceSurfaces::find(problem, displacements(), 3);
  ASSERT_TRUE(one && three);
  const auto a = one->of(touches, 1), b = three->of(touches, 3);
  for (std::size_t i = 0; i < touches.size(); ++i) {
    EXPECT_EQ(a[i].perNewton, b[i].perNewton);
    EXPECT_EQ(a[i].byPlace_per_Nmm, b[i].byPlace_per_Nmm);
  }
}

TEST(InfluenceSurfaces, StopWhenAsked) {
  const HyperelasticProblem problem = block(4);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_FALSE(InfluenceSurfaces::find(problem, displacements(), 0, stop.get_token()));
}

} // namespace
} // namespace palp
