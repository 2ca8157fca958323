#include "app/study/reports/map/TouchMap.h"

#include "model/DesignError.h"
#include "model/RowColumnResistance.h"
#include "solver/SensorMesh.h"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace palp {
namespace {

HyperelasticProblem mappedBlock(const SensorDesign& design) {
  MeshOptions options;
  options.mapped = std::array<int, 3>{12, 12, 4};
  return {design, sensorMesh(design, options)};
}

TouchMapRequest request() {
  TouchMapRequest request;
  request.touch = {IndenterShape::Sphere, 5, 0, {0, 0}, 0, Press{{0, 0, -3}}};
  request.low_mm = {4, 4};
  request.high_mm = {26, 26};
  request.places = {5, 5};
  return request;
}

/// d ln R by small motions, in the order of the map's readings, against the law itself.
TEST(TouchMap, ItsReadingsFollowTheLaw) {
  for (const bool follows : {false, true}) {
    SensorDesign design = paperDesign();
    design.lowerFollowsRubber = follows;
    const LinearReadings readings = readingsAtRest(design, 0);
    std::mt19937 engine(4);
    std::uniform_real_distribution<double> uniform(-1, 1);
    ElectrodeDisplacements moved = ElectrodeDisplacements::atRest(design), back = moved;
    const double step_mm = 1e-5;
    for (double& value : moved.upper_mm.reshaped()) value = step_mm * uniform(engine);
    for (double& value : moved.lower_mm.reshaped()) value = step_mm * uniform(engine);
    back.upper_mm = -moved.upper_mm;
    back.lower_mm = -moved.lower_mm;
    const Eigen::VectorXd wanted =
        (rowColumnResistances(design, moved).array() / rowColumnResistances(design, back).array())
            .log()
            .matrix()
            .reshaped() /
        2;
    Eigen::Matrix3Xd motion(3, readings.points_mm.cols());
    motion << moved.upper_mm, moved.lower_mm;
    EXPECT_LT((readings.gradient_per_mm * motion.reshaped() - wanted).norm(), 1e-6 * wanted.norm()) << follows;
  }
}

TEST(TouchMap, RefusesAPressureLaw) {
  SensorDesign design = paperDesign();
  design.pressureLaw = PressureLaw{};
  EXPECT_THROW(readingsAtRest(design, 0), DesignError);
}

/// The paper's block and its wires are mirrored at y = 15 mm.
TEST(TouchMap, OfAMirroredSensorIsMirrored) {
  const SensorDesign design = paperDesign();
  const auto surfaces = InfluenceSurfaces::find(mappedBlock(design), readingsAtRest(design, 0), 0);
  ASSERT_TRUE(surfaces);
  const TouchMap map = touchMap(*surfaces, request(), 0);
  for (const Eigen::MatrixXd* values : {&map.smallestForce_N, &map.slipperyPlace_mm, &map.heldPlace_mm}) {
    const Eigen::MatrixXd mirrored = values->rowwise().reverse();
    EXPECT_LT((*values - mirrored).norm(), 1e-3 * values->norm());
    EXPECT_GT(values->minCoeff(), 0);
  }
  // More unknowns cannot help, but for rounding: where forces sideways tell nothing of the others both are the same.
  constexpr double kRounding = 1e-9;
  EXPECT_GE((map.heldPlace_mm.array() / map.slipperyPlace_mm.array()).minCoeff(), 1 - kRounding);
  EXPECT_GE((map.heldForce_N[2].array() / map.slipperyForce_N.array()).minCoeff(), 1 - kRounding);
}

TEST(TouchMap, GoesWithTheNoiseAndPlacesWithOneOverTheForce) {
  const SensorDesign design = paperDesign();
  const auto surfaces = InfluenceSurfaces::find(mappedBlock(design), readingsAtRest(design, 0), 0);
  ASSERT_TRUE(surfaces);
  TouchMapRequest noisy = request();
  noisy.relativeNoise *= 4;
  const TouchMap map = touchMap(*surfaces, request(), 0), four = touchMap(*surfaces, noisy, 0);
  EXPECT_LT((four.smallestForce_N - 4 * map.smallestForce_N).norm(), 1e-9 * four.smallestForce_N.norm());
  EXPECT_LT((four.heldPlace_mm - 4 * map.heldPlace_mm).norm(), 1e-6 * four.heldPlace_mm.norm());
  TouchMapRequest punch = request(); // its contact does not grow with the force
  punch.touch = {IndenterShape::Flat, 2, 0.2, {0, 0}, 0, Press{{0, 0, -1}}};
  TouchMapRequest strong = punch;
  strong.touch.control = Press{{0, 0, -3}};
  const TouchMap weak = touchMap(*surfaces, punch, 0), hard = touchMap(*surfaces, strong, 0);
  EXPECT_EQ(weak.contactRadius_mm, 2);
  EXPECT_LT((weak.slipperyPlace_mm - 3 * hard.slipperyPlace_mm).norm(), 1e-6 * weak.slipperyPlace_mm.norm());
  EXPECT_LT((weak.slipperyForce_N - hard.slipperyForce_N).norm(), 1e-6 * weak.slipperyForce_N.norm());
}

/// The deviations are those of a least squares estimate with that noise, drawn.
TEST(TouchMap, DeviationsAreWhatManyEstimatesShow) {
  const SensorDesign design = paperDesign();
  const auto surfaces = InfluenceSurfaces::find(mappedBlock(design), readingsAtRest(design, 0), 0);
  ASSERT_TRUE(surfaces);
  TouchMapRequest one = request();
  one.places = {2, 2};
  const TouchMap map = touchMap(*surfaces, one, 0);
  Indenter touch = one.touch;
  touch.place_mm = one.low_mm;
  const TouchInfluence influence = surfaces->of(std::array{touch}, 0).front();
  Eigen::MatrixXd j(influence.perNewton.rows(), 5);
  j << influence.perNewton, -3 * influence.byPlace_per_Nmm;
  const Eigen::MatrixXd estimator = (j.transpose() * j).ldlt().solve(j.transpose());
  std::mt19937 engine(8);
  std::normal_distribution<double> normal(0, one.relativeNoise);
  double force = 0, place = 0;
  const int draws = 4000;
  for (int i = 0; i < draws; ++i) {
    const Eigen::VectorXd noise = Eigen::VectorXd::NullaryExpr(j.rows(), [&] { return normal(engine); });
    const Eigen::VectorXd error = estimator * noise;
    force += error(2) * error(2);
    place += error.tail<2>().squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(force / draws), map.heldForce_N[2](0, 0), 0.05 * map.heldForce_N[2](0, 0));
  EXPECT_NEAR(std::sqrt(place / draws), map.heldPlace_mm(0, 0), 0.05 * map.heldPlace_mm(0, 0));
}

TEST(TouchMap, TwoTouchesAreToldApartFartherWhereThereIsMoreNoise) {
  const SensorDesign design = paperDesign();
  const auto surfaces = InfluenceSurfaces::find(mappedBlock(design), readingsAtRest(design, 0), 0);
  ASSERT_TRUE(surfaces);
  TouchMapRequest fine = request();
  fine.places = {23, 23};
  fine.relativeNoise = 1e-5;
  TouchMapRequest noisy = fine;
  noisy.relativeNoise *= 4;
  const TouchMap map = touchMap(*surfaces, fine, 0), more = touchMap(*surfaces, noisy, 0);
  EXPECT_TRUE(std::isnan(map.twoPoint_mm(0, 0))) << "no pair lies about a corner";
  const double near_mm = map.twoPoint_mm(11, 11), far_mm = more.twoPoint_mm(11, 11);
  EXPECT_GT(near_mm, 0.2);
  EXPECT_NEAR(far_mm, 2 * near_mm, 0.1 * far_mm) << "with the root of the noise while the distance is small";
  noisy.relativeNoise *= 1000;
  EXPECT_TRUE(touchMap(*surfaces, noisy, 0).twoPoint_mm.array().isNaN().all()) << "lost in noise";
}

TEST(TouchMap, IsNoNumberWhereOneAxisHasNoPair) {
  const SensorDesign design = paperDesign();
  TouchMapRequest wanted = request();
  wanted.places = {5, 2}; // no place has two neighbours along y
  const auto surfaces = InfluenceSurfaces::find(mappedBlock(design), readingsAtRest(design, 0), 0);
  ASSERT_TRUE(surfaces);
  EXPECT_TRUE(touchMap(*surfaces, wanted, 0).twoPoint_mm.array().isNaN().all());
}

} // namespace
} // namespace palp
