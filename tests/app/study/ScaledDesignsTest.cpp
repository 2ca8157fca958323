// The same sensor in other units of length and force: what is a share of its own size must not change.

#include "app/study/decoding/KnownTouches.h"
#include "app/study/reports/MeshShare.h"
#include "app/study/reports/layout/DesignBounds.h"
#include "app/study/reports/layout/LayoutSweeps.h"
#include "app/study/touch/SampleGenerator.h"
#include "app/study/touch/Touch.h"

#include <gtest/gtest.h>

#include <ostream>

namespace palp {
namespace {

struct Units {
  const char* name;
  double length, modulus;
  [[nodiscard]] double force() const { return modulus * length * length; }
};

void PrintTo(const Units& units, std::ostream* out) {
  *out << units.name;
}

void scale(std::vector<std::vector<double>>& lists, double factor) {
  for (std::vector<double>& list : lists)
    for (double& value : list) value *= factor;
}

SensorDesign scaled(SensorDesign design, const Units& units) {
  design.block_mm *= units.length;
  for (ElectrodeLayer* layer : {&design.upper, &design.lower}) {
    for (double& place : layer->wire_mm) place *= units.length;
    scale(layer->along_mm, units.length);
    scale(layer->z_mm, units.length);
  }
  design.material.law = timesStress(design.material.law, units.modulus);
  if (auto* field = std::get_if<FieldLaw>(&design.resistance)) field->electrodeRadius_mm *= units.length;
  design.forceRange.low_N *= units.force();
  design.forceRange.high_N *= units.force();
  return design;
}

MeshOptions fewCells() {
  MeshOptions mesh;
  mesh.mapped = std::array<int, 3>{4, 4, 2};
  return mesh;
}

Eigen::VectorXd boundsOf(const SensorDesign& design) {
  const auto bounds = designBounds(design, fewCells(), 1e-4, 1, {}, {});
  return bounds->allRows.withoutPrior_percent.reshaped();
}

SampleSet samplesOf(const SensorDesign& design, const SampleRequest& request) {
  SampleGenerator generator(design, request);
  SampleSet all;
  (void)generator.generate({0, generator.total()}, [&](const SampleSet& block) { append(all, block); });
  return all;
}

void expectSame(const Eigen::MatrixXd& found, const Eigen::MatrixXd& wanted, double tolerance) {
  ASSERT_EQ(found.size(), wanted.size());
  EXPECT_LE((found - wanted).norm(), tolerance * wanted.norm());
}

constexpr double kSolver = 1e-5; // of two solves to 1e-6 each, whose steps round otherwise

class OtherUnits : public testing::TestWithParam<Units> {};

TEST_P(OtherUnits, ChangeNoBoundAndNoSweep) {
  SensorDesign design = paperDesign();
  expectSame(boundsOf(scaled(design, GetParam())), boundsOf(design), kSolver);
  const auto sweep = [](const SensorDesign& of) {
    StageLog stages;
    const auto response = AreaResponse::solve(of, fewCells(), 1, stages, {}, {});
    return layoutSweeps(of, *response, -1, 1e-4, 1).front();
  };
  const LayoutSweep small = sweep(scaled(design, GetParam())), own = sweep(design);
  ASSERT_EQ(small.points.size(), own.points.size());
  for (std::size_t i = 0; i < own.points.size(); ++i) {
    EXPECT_NEAR(small.points[i].at / GetParam().length / own.points[i].at, 1, 1e-12);
    expectSame(small.points[i].withoutPrior_percent, own.points[i].withoutPrior_percent, kSolver);
  }
  if (GetParam().length == 10 || GetParam().modulus == 1000) return; // the field takes a second each
  design.resistance = FieldLaw{};
  expectSame(boundsOf(scaled(design, GetParam())), boundsOf(design), kSolver);
}

TEST_P(OtherUnits, ScaleSamples) {
  const SensorDesign design = paperDesign(), other = scaled(design, GetParam());
  SampleRequest request;
  request.perArea = 2;
  request.mesh = fewCells();
  request.threads = 1;
  for (const bool surrogate : {false, true}) {
    request.surrogate = surrogate;
    const SampleSet own = samplesOf(design, request), theirs = samplesOf(other, request);
    expectSame(theirs.forces_N / GetParam().force(), own.forces_N, 1e-12);
    expectSame(theirs.displacements_mm / GetParam().length, own.displacements_mm, kSolver);
    expectSame(theirs.resistances_ohm / GetParam().length, own.resistances_ohm, kSolver);
  }
}

TEST_P(OtherUnits, ScaleTouches) {
  const SensorDesign design = paperDesign(), other = scaled(design, GetParam());
  SampleRequest request;
  request.perArea = 4;
  request.mesh.mapped = std::array<int, 3>{12, 12, 3};
  request.threads = 1;
  request.touches = touchesOf(design);
  SampleGenerator own(design, request);
  request.touches = touchesOf(other);
  SampleGenerator theirs(other, request);
  SampleSet ownSet, theirSet;
  (void)own.generate({0, 4}, [&](const SampleSet& block) { append(ownSet, block); });
  (void)theirs.generate({0, 4}, [&](const SampleSet& block) { append(theirSet, block); });
  expectSame(theirSet.displacements_mm / GetParam().length, ownSet.displacements_mm, kSolver);
  EXPECT_EQ(theirs.leftToNewton(), own.leftToNewton()) << "as fast as well";
}

TEST_P(OtherUnits, ScaleOneTouchAndItsMesh) {
  const SensorDesign design = paperDesign(), other = scaled(design, GetParam());
  EXPECT_EQ(leastPress_N(design.forceRange), 1e-6);
  EXPECT_NEAR(leastPress_N(other.forceRange) / leastPress_N(design.forceRange) / GetParam().force(), 1, 1e-12);
  EXPECT_NEAR(meshShare(other), GetParam().length, 1e-12);
  const auto moved = [](const SensorDesign& of, const Units& units) {
    LoadCase load;
    load.indenters = {{IndenterShape::Sphere, 5 * units.length, 0, Eigen::Vector2d(15, 12) * units.length, 0.3,
                       Press{Eigen::Vector3d(0.3, 0, -3) * units.force()}}};
    MeshOptions mesh;
    mesh.mapped = std::array<int, 3>{12, 12, 3};
    Touch touch(of, load, mesh);
    EXPECT_TRUE(touch.advance(Stage::Displacements)) << touch.solution()->stopReason;
    return Eigen::MatrixXd(touch.displacements()->upper_mm / units.length);
  };
  expectSame(moved(other, GetParam()), moved(design, {"own", 1, 1}), kSolver);
}

INSTANTIATE_TEST_SUITE_P(Each, OtherUnits,
                         testing::Values(Units{"TenthOfTheLength", 0.1, 1}, Units{"TenTimesTheLength", 10, 1},
                                         Units{"ThousandthOfTheModuli", 1, 1e-3},
                                         Units{"ThousandTimesTheModuli", 1, 1e3}),
                         [](const auto& one) { return std::string(one.param.name); });

} // namespace
} // namespace palp
