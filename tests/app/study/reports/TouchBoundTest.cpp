#include "app/study/reports/map/TouchBound.h"

#include "io/DesignFile.h"
#include "model/DesignError.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace palp {
namespace {

constexpr double kTouchNoise = 1e-4;

MeshOptions coarseTouches() {
  MeshOptions options;
  options.mapped = std::array<int, 3>{12, 12, 4};
  return options;
}

/// Spheres of 5 mm that press with 3 N, at the corners of a rectangle: the first two slide, the others are held.
SampleSet fourTouches(const SensorDesign& design) {
  SampleSet set;
  set.origin.designFingerprint = designFingerprint(design);
  set.touches = Eigen::MatrixXd::Zero(kTouchRows, 4);
  set.touches.row(kTouchSize_mm).setConstant(5);
  set.touches.row(kTouchFriction) << 0, 0, 0.5, 0.5;
  set.touches.row(kTouchX_mm) << 8, 20, 8, 20;
  set.touches.row(kTouchY_mm) << 10, 10, 18, 18;
  set.forces_N = Eigen::MatrixXd::Zero(3, 4);
  set.forces_N.row(2).setConstant(-3);
  return set;
}

TEST(TouchBound, IsThatOfTheMapAtTheSamePlaces) {
  const SensorDesign design = paperDesign();
  const HyperelasticProblem problem(design, sensorMesh(design, coarseTouches()));
  const auto surfaces = InfluenceSurfaces::find(problem, readingsAtRest(design, 0), 0);
  ASSERT_TRUE(surfaces);
  TouchMapRequest request;
  request.touch = {IndenterShape::Sphere, 5, 0, {0, 0}, 0, Press{{0, 0, -3}}};
  request.low_mm = {8, 10};
  request.high_mm = {20, 18};
  request.relativeNoise = kTouchNoise;
  const TouchMap map = touchMap(*surfaces, request, 0);
  const auto bounds = touchBounds(fourTouches(design), design, kTouchNoise, coarseTouches(), 0);
  ASSERT_TRUE(bounds && bounds->known.size() == 4);
  for (int x = 0; x < 2; ++x) {
    const TouchDeviations& slides = bounds->known[static_cast<std::size_t>(x)];
    EXPECT_NEAR(slides.place_mm.norm(), map.slipperyPlace_mm(x, 0), 1e-9 * map.slipperyPlace_mm(x, 0));
    EXPECT_NEAR(slides.force_N.z(), map.slipperyForce_N(x, 0), 1e-9 * map.slipperyForce_N(x, 0));
    EXPECT_EQ(slides.force_N.head<2>().norm(), 0);
    const TouchDeviations& held = bounds->known[static_cast<std::size_t>(2 + x)];
    EXPECT_NEAR(held.place_mm.norm(), map.heldPlace_mm(x, 1), 1e-9 * map.heldPlace_mm(x, 1));
    EXPECT_NEAR(held.force_N.x(), map.heldForce_N[0](x, 1), 1e-9 * map.heldForce_N[0](x, 1));
  }
  EXPECT_TRUE(bounds->sizeUnknown.empty()) << "all are of one size";
}

TEST(TouchBound, IsHigherForWhoHasToFindTheSizeAsWell) {
  const SensorDesign design = paperDesign();
  SampleSet samples = fourTouches(design);
  samples.touches.row(kTouchSize_mm) << 4, 5, 4, 5;
  const auto bounds = touchBounds(samples, design, kTouchNoise, coarseTouches(), 0);
  ASSERT_TRUE(bounds && bounds->sizeUnknown.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_GT(bounds->sizeUnknown[i].force_N.z(), 1.001 * bounds->known[i].force_N.z()) << i;
    EXPECT_GE(bounds->sizeUnknown[i].place_mm.norm(), bounds->known[i].place_mm.norm()) << i;
  }
}

TEST(TouchBound, OfAnotherDesignOrOfNoTouchesIsRefused) {
  SensorDesign other = paperDesign();
  other.block_mm.z() = 6;
  EXPECT_THROW(touchBounds(fourTouches(paperDesign()), other, kTouchNoise, coarseTouches(), 0), Error);
  SampleSet areas = fourTouches(other);
  areas.touches.resize(0, 0);
  EXPECT_THROW(touchBounds(areas, other, kTouchNoise, coarseTouches(), 0), Error);
  SampleSet planes = fourTouches(other);
  planes.touches.row(kTouchShape).setConstant(static_cast<double>(IndenterShape::Plane));
  EXPECT_THROW(touchBounds(planes, other, kTouchNoise, coarseTouches(), 0), DesignError);
}

TEST(TouchBound, ErrorsOfAnEstimateThatReachesItAreOnceIt) {
  constexpr Eigen::Index kSamples = 20'000;
  std::mt19937 engine(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> size(0.01, 0.1);
  std::vector<TouchDeviations> bounds;
  Eigen::MatrixXd forces(3, kSamples), places(2, kSamples);
  for (Eigen::Index i = 0; i < kSamples; ++i) {
    const double place_mm = size(engine);
    bounds.push_back({{0, 0, size(engine)}, {place_mm, place_mm}});
    forces.col(i) << 0, 0, normal(engine) * bounds.back().force_N.z();
    places.col(i) << normal(engine) * place_mm, normal(engine) * place_mm;
  }
  const ErrorsOverBounds once = errorsOverBounds(bounds, forces, places);
  EXPECT_NEAR(once.forceRatio, 1, 0.03);
  EXPECT_NEAR(once.placeRatio, 1, 0.03);
  const ErrorsOverBounds twice = errorsOverBounds(bounds, 2 * forces, 3 * places);
  EXPECT_NEAR(twice.forceRatio, 2 * once.forceRatio, 1e-12);
  EXPECT_NEAR(twice.placeRatio, 3 * once.placeRatio, 1e-12);
  EXPECT_EQ(twice.place_mm, once.place_mm);
}

} // namespace
} // namespace palp
