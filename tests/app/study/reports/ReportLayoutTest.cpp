#include "app/study/decoding/NoiseBound.h"
#include "app/study/reports/layout/LayoutReport.h"
#include "app/study/reports/layout/LayoutSearch.h"
#include "app/study/reports/map/TouchMap.h"
#include "app/study/touch/SampleGenerator.h"
#include "io/DesignFile.h"

#include <gtest/gtest.h>

#include <cmath>

using palp::LayoutFreedom;
using palp::SensorDesign;

namespace {

constexpr int kLayoutRow = 4;
constexpr double kLayoutNoise = 1e-4;

palp::MeshOptions coarseLayouts() {
  palp::MeshOptions mesh;
  mesh.mapped = std::array<int, 3>{6, 6, 3};
  return mesh;
}

const palp::AreaResponse& layoutResponse() {
  static palp::StageLog stages;
  static const auto solved = palp::AreaResponse::solve(palp::paperDesign(), coarseLayouts(), 1, stages, {}, {});
  return *solved;
}

} // namespace

TEST(LayoutBound, InTheMiddleOfTheRangeIsThatOfNonlinearSamplesOverTheRange) {
  palp::SampleRequest request;
  request.mesh = coarseLayouts();
  request.perArea = 40;
  palp::SampleGenerator generator(palp::paperDesign(), request);
  palp::SampleSet samples;
  generator.generate({0, generator.total()}, [&](const palp::SampleSet& block) { append(samples, block); });
  const palp::NoiseBound sampled = noiseBound(samples, palp::InputKind::Resistance, {kLayoutRow}, kLayoutNoise);
  const palp::LayoutBound bound = layoutBound(palp::paperDesign(), layoutResponse(), kLayoutRow, kLayoutNoise);
  // The block's nonlinearity (1 to 2.5 %) acts on an inversion of condition 1e3, and 40 random forces do not span the
  // whole range that percents are taken of.
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(bound.withPrior()(axis) / sampled.withPriorPercent(axis), 1, 0.1) << axis;
}

TEST(LayoutBound, NeverExceedsKnowingNothingWhereThePriorIsKnown) {
  const palp::LayoutBound bound = layoutBound(palp::paperDesign(), layoutResponse(), kLayoutRow, 0.5);
  EXPECT_LE(bound.withPrior_percent.maxCoeff(), 100 / std::sqrt(12.0) * (1 + 1e-12)); // rounding
}

TEST(LayoutBound, ConditionOfThePapersLayoutIsTheKnownOne) {
  // An independent prototype found 2.1e6, with two digits.
  EXPECT_NEAR(palp::condition(resistanceSingularValues(palp::paperDesign(), kLayoutRow)), 2.1e6, 0.05e6);
}

TEST(LayoutSearch, FindsATenTimesBetterLayoutThatAMakerCanKeep) {
  const palp::MakerLimits limits;
  const auto better = betterLayout(palp::paperDesign(), areaGoal(layoutResponse(), kLayoutRow, kLayoutNoise, 0),
                                   LayoutFreedom::SameOnEveryWire, limits, 1, {});
  ASSERT_TRUE(better);
  EXPECT_EQ(makerProblem(better->layout, limits), std::nullopt);
  EXPECT_TRUE(check(better->layout).empty());
  EXPECT_LT(better->after, better->before / 10);
  EXPECT_EQ(layoutBound(better->layout, layoutResponse(), kLayoutRow, kLayoutNoise).mean(), better->after);
}

/// The goal is what the map says of its worst place, by influence surfaces of the readings in place of the touches'.
TEST(LayoutSearch, ForTouchesLowersTheMapsWorstPlace) {
  const SensorDesign design = palp::paperDesign();
  const palp::HyperelasticProblem problem(design, sensorMesh(design, coarseLayouts()));
  palp::TouchMapRequest request;
  request.touch = {palp::IndenterShape::Sphere, 4, 0, {15, 15}, 0, palp::Press{{0, 0, -2}}};
  request.low_mm = {4, 5};
  request.high_mm = {26, 25};
  request.places = {3, 2};
  std::vector<palp::Indenter> touches;
  const Eigen::Matrix2Xd places_mm = placesOf(request);
  for (Eigen::Index i = 0; i < places_mm.cols(); ++i) {
    touches.push_back(request.touch);
    touches.back().place_mm = places_mm.col(i);
  }
  const auto fields = palp::TouchFields::find(problem, touches, 0);
  ASSERT_TRUE(fields);
  const auto mapped_mm = [&](const SensorDesign& layout) {
    const auto surfaces = palp::InfluenceSurfaces::find(problem, palp::readingsAtRest(layout, 0), 0);
    return touchMap(*surfaces, request, 0).heldPlace_mm.maxCoeff();
  };
  const auto better = betterLayout(design, touchGoal(*fields, request.touch, request.relativeNoise, 0),
                                   LayoutFreedom::SameOnEveryWire, {.grid_mm = 0.5}, 1, {});
  ASSERT_TRUE(better);
  EXPECT_LT(better->after, 0.9 * better->before);
  EXPECT_NEAR(better->before, mapped_mm(design), 1e-6 * better->before);
  EXPECT_NEAR(better->after, mapped_mm(better->layout), 1e-6 * better->after);
}

TEST(LayoutSearch, EqualSeedsGiveEqualLayouts) {
  const auto search = [] {
    return betterLayout(palp::paperDesign(), areaGoal(layoutResponse(), kLayoutRow, kLayoutNoise, 0),
                        LayoutFreedom::SameOnEveryWire, {}, 3, {});
  };
  EXPECT_EQ(search()->layout, search()->layout);
}

TEST(LayoutSearch, SaysWhatAMakerCannotKeep) {
  SensorDesign crooked = palp::paperDesign();
  crooked.lower.z_mm.assign(30, {1, 1, 1.5});
  EXPECT_EQ(makerProblem(crooked, {}), "column-wire 0 is not straight");
  SensorDesign close = palp::paperDesign();
  close.lower.z_mm = {{3.8}};
  EXPECT_EQ(makerProblem(close, {}), "the layers are nearer than 0.5 mm");
  SensorDesign tight = palp::paperDesign();
  tight.lower.along_mm = {{5, 5.5, 25}};
  EXPECT_EQ(makerProblem(tight, {}), "column-wire 0 has electrodes nearer to each other than 1 mm");
}

TEST(LayoutReport, StopsWithoutAResult) {
  palp::ReportRequest request;
  request.mesh = coarseLayouts();
  std::stop_source source;
  source.request_stop();
  EXPECT_EQ(layoutReport(request, {}, source.get_token()), std::nullopt);
}

TEST(LayoutReport, GivesTheBetterDesignsAndEveryPoint) {
  palp::ReportRequest request;
  request.mesh = coarseLayouts();
  request.perArea = 10;
  const auto report = layoutReport(request, {}, {});
  ASSERT_TRUE(report);
  ASSERT_EQ(report->files.size(), 2U);
  for (const palp::ReportFile& file : report->files)
    EXPECT_TRUE(check(palp::parseDesign(file.content, file.name)).empty()) << file.name;
  EXPECT_NE(report->csv.find("\nbound without prior [%],before,4,0,Fx,,"), std::string::npos);
  EXPECT_NE(report->csv.find("\n\"confirmed error [%], ml\",wire by wire,"), std::string::npos);
}
