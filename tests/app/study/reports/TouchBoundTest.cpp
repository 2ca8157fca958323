#include "app/study/reports/map/TouchBound.h"

#include "io/DesignFile.h"
#include "model/DesignError.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
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

/// Rows of bumps along x and along y under a touch, as high as its force.
struct BumpsUnderTouches {
  SampleSet samples;
  Eigen::MatrixXd parameters{Eigen::MatrixXd::Zero(7, 400)}, readings{40, 400};
  BumpsUnderTouches() {
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> uniform;
    for (Eigen::Index i = 0; i < parameters.cols(); ++i) {
      parameters.col(i).segment<3>(2) << -1 - 4 * uniform(engine), 4 + 12 * uniform(engine), 4 + 12 * uniform(engine);
      for (int m = 0; m < 40; ++m) readings(m, i) = 100 - parameters(2, i) * std::exp(-off(m, i) * off(m, i));
    }
    samples.touches = Eigen::MatrixXd::Zero(kTouchRows, parameters.cols());
    samples.touches.middleRows<2>(kTouchX_mm) = parameters.middleRows<2>(3);
    samples.forces_N = parameters.topRows<3>();
    samples.area.setZero(parameters.cols());
  }
  [[nodiscard]] double off(int m, Eigen::Index i) const { return (m % 20 - parameters(m < 20 ? 3 : 4, i)) / 3; }
};

TEST(TouchBound, OfLearnedSlopesIsThatOfTheReadingsAtEachTouch) {
  const BumpsUnderTouches bumps;
  Decoder decoder;
  decoder.noise = kTouchNoise;
  decoder.model = fitKernelForwardModel(bumps.readings, bumps.parameters,
                                        (Eigen::VectorXi(7) << 1, 1, 1, 0, 0, 2, 2).finished(), {kTouchNoise, 1})
                      .model;
  const auto bounds = learnedBounds(decoder, bumps.samples, kTouchNoise);
  ASSERT_EQ(bounds.size(), 400U);
  for (Eigen::Index i = 0; i < 400; i += 7) {
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(40, 3);
    for (int m = 0; m < 40; ++m) {
      const double bump = std::exp(-bumps.off(m, i) * bumps.off(m, i));
      slopes(m, 0) = -bump;
      slopes(m, m < 20 ? 1 : 2) = -bumps.parameters(2, i) * bump * 2 * bumps.off(m, i) / 3;
      slopes.row(m) /= kTouchNoise * bumps.readings(m, i);
    }
    const Eigen::VectorXd expected = leastDeviations(slopes);
    const TouchDeviations& found = bounds[static_cast<std::size_t>(i)];
    EXPECT_EQ(found.force_N.head<2>().norm(), 0) << "they never varied";
    EXPECT_NEAR(found.force_N.z(), expected(0), 0.05 * expected(0)) << i;
    EXPECT_NEAR(found.place_mm.norm(), expected.tail<2>().norm(), 0.05 * expected.tail<2>().norm()) << i;
  }
  EXPECT_NEAR(learnedBounds(decoder, bumps.samples, 2 * kTouchNoise)[3].force_N.z(), 2 * bounds[3].force_N.z(), 1e-9);
  decoder.correction.emplace();
  EXPECT_TRUE(learnedBounds(decoder, bumps.samples, kTouchNoise).empty()) << "calibrated";
  EXPECT_TRUE(learnedBounds(Decoder(), bumps.samples, kTouchNoise).empty()) << "of another kind";
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
