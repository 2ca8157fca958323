#include "app/study/touch/DesignMirror.h"

#include "app/study/touch/SymmetryReduction.h"
#include "model/FieldAtRest.h"
#include "model/RowColumnResistance.h"
#include "solver/HyperelasticProblem.h"
#include "solver/SensorMesh.h"

#include <gtest/gtest.h>

#include <vector>

namespace palp {
namespace {

TEST(DesignMirror, OfThePaperExchangesItsWiresAlongBothAxes) {
  const SensorDesign design = paperDesign();
  const auto x = mirrorOf(design, 0), y = mirrorOf(design, 1);
  ASSERT_TRUE(x && y);
  for (int row = 0; row < design.rowWires(); ++row) {
    EXPECT_EQ(x->row[static_cast<std::size_t>(row)], row);
    EXPECT_EQ(y->row[static_cast<std::size_t>(row)], design.rowWires() - 1 - row);
  }
  for (int column = 0; column < design.columnWires(); ++column) {
    EXPECT_EQ(x->column[static_cast<std::size_t>(column)], design.columnWires() - 1 - column);
    EXPECT_EQ(y->column[static_cast<std::size_t>(column)], column);
  }
}

TEST(DesignMirror, LeavesTheResistancesAtRestAsTheyAre) {
  SensorDesign design = paperDesign(); // with uneven steps, and wires that differ along z
  design.lower.wire_mm[3] += 0.2;
  design.lower.wire_mm[static_cast<std::size_t>(design.columnWires()) - 4] -= 0.2;
  design.upper.z_mm.assign(10, std::vector<double>(10, 4)); // of ten row-wires with ten electrodes each
  design.upper.z_mm[2] = design.upper.z_mm[7] = std::vector<double>(10, 3.8);
  for (int axis = 0; axis < 2; ++axis) {
    const auto mirror = mirrorOf(design, axis);
    ASSERT_TRUE(mirror) << axis;
    const auto isImage = [&](const Eigen::MatrixXd& resistances_ohm) {
      const Eigen::MatrixXd image_ohm = resistances_ohm(mirror->row, mirror->column);
      return image_ohm.isApprox(resistances_ohm, 1e-9);
    };
    EXPECT_TRUE(isImage(rowColumnResistances(design, ElectrodeDisplacements::atRest(design)))) << axis;
    FieldLaw law;
    law.readout = Readout::VirtualGround;
    EXPECT_TRUE(isImage(NetworkReading(networkAtRest(design, law), law.readout).resistances_ohm())) << axis;
  }
}

// A mapped mesh is its own image too.
TEST(DesignMirror, WhatTheImageOfALoadDoesIsTheImage) {
  SensorDesign design = paperDesign();
  design.lowerFollowsRubber = true;
  const HyperelasticProblem problem(design, sensorMesh(design, {.meshSize_mm = {}, .mapped = {{6, 6, 2}}}));
  LoadCase load{{{3, {0.3, -0.4, -1.5}}}, {{{8, 21}, 3, {-0.2, 0.1, -0.4}}}};
  load.indenters.push_back({IndenterShape::Sphere, 5, 0, {20, 10}, 0, Press{{0, 0, -2}}});
  const auto answer = [&](const LoadCase& to) { return problem.electrodes(problem.solve(to).state()); };
  const ElectrodeDisplacements moved = answer(load);
  for (const int axis : {0, 1}) {
    const auto mirror = mirrorOf(design, axis);
    ASSERT_TRUE(mirror) << axis;
    EXPECT_NE(mirror->image(load), load);
    EXPECT_EQ(mirror->image(mirror->image(load)), load);
    const ElectrodeDisplacements found = answer(mirror->image(load)), expected = mirror->image(moved);
    EXPECT_TRUE(found.upper_mm.isApprox(expected.upper_mm, 1e-7)) << axis;
    EXPECT_TRUE(found.lower_mm.isApprox(expected.lower_mm, 1e-7)) << axis;
    EXPECT_TRUE(rowColumnResistances(design, found).isApprox(mirror->image(rowColumnResistances(design, moved)), 1e-9))
        << axis;
    EXPECT_GT((found.upper_mm - moved.upper_mm).norm(), 0.1 * moved.upper_mm.norm()) << axis;
  }
}

TEST(SymmetryReduction, HoldsATouchOrItsImage) {
  const SensorDesign design = paperDesign();
  TouchRange range = touchesOf(design);
  range.low_mm = {2, 14};
  range.high_mm = {20, 27};
  const SymmetryReduction side(design, range);
  const TouchRange low = side.of(range);
  EXPECT_EQ(low.low_mm, Eigen::Vector2d(2, 3));
  EXPECT_EQ(low.high_mm, Eigen::Vector2d(15, 15));
  std::vector<LoadCase> loads;
  ConductionBatch::Answers answers;
  for (std::size_t i = 0; i < 40; ++i) {
    loads.push_back({.areas = {}, .patches = {}, .indenters = {touchAt(range, 1, i)}});
    ElectrodeDisplacements zero = ElectrodeDisplacements::atRest(design);
    zero.upper_mm.col(0) << 1, 2, 3; // of the corner x = y = 1.5
    answers.displacements.push_back(zero);
    answers.resistances_ohm.push_back(Eigen::MatrixXd::Zero(10, 30));
    answers.resistances_ohm.back()(0, 0) = 1;
  }
  answers.displacements[7] = {}; // left out
  for (const LoadCase& load : side.of(loads)) {
    const Eigen::Vector2d place_mm = load.indenters[0].place_mm;
    EXPECT_TRUE((place_mm.array() >= low.low_mm.array()).all() && (place_mm.array() <= 15).all());
  }
  side.mapBack(loads, answers);
  for (std::size_t i = 0; i < 40; ++i) {
    if (i == 7) continue;
    const bool right = loads[i].indenters[0].place_mm.x() > 15, back = loads[i].indenters[0].place_mm.y() > 15;
    const Eigen::Index electrode = (back ? 90 : 0) + (right ? 9 : 0);
    EXPECT_EQ(answers.displacements[i].upper_mm.col(electrode), Eigen::Vector3d(right ? -1 : 1, back ? -2 : 2, 3));
    EXPECT_EQ(answers.resistances_ohm[i](back ? 9 : 0, right ? 29 : 0), 1);
  }
  EXPECT_EQ(answers.displacements[7].upper_mm.size(), 0);
}

TEST(SymmetryReduction, IsAllOfADesignWithoutMirrorsAndOfTouchesOnOneSide) {
  SensorDesign design = paperDesign();
  TouchRange range = touchesOf(design);
  range.high_mm.x() = 15;
  EXPECT_EQ(SymmetryReduction(design, range).of(range).low_mm, range.low_mm);
  EXPECT_EQ(SymmetryReduction(design, range).of(range).high_mm, Eigen::Vector2d(15, 15));
  design.upper.along_mm[0][0] += 0.1;
  design.lower.along_mm[0][0] += 0.1;
  EXPECT_TRUE(SymmetryReduction(design, range).empty());
  EXPECT_TRUE(SymmetryReduction(design).empty());
}

TEST(SymmetryReduction, OfAreasKeepsThoseThatOthersAreImagesOf) {
  SensorDesign design = paperDesign(); // three columns, two rows
  const std::vector<int> all{0, 1, 2, 3, 4, 5}, last{5};
  EXPECT_EQ(SymmetryReduction(design).of(all), (std::vector{0, 1}));
  EXPECT_EQ(SymmetryReduction(design).of(last), std::vector{0});
  design.forceRange.low_N.x() = -0.5; // its image is another range
  EXPECT_EQ(SymmetryReduction(design).of(all), (std::vector{0, 1, 2}));
}

TEST(DesignMirror, IsNoneWhereAnElectrodeHasNoImage) {
  SensorDesign design = paperDesign();
  design.upper.along_mm[0][0] += 0.1; // of all row-wires: y is reflected as before
  EXPECT_FALSE(mirrorOf(design, 0));
  EXPECT_TRUE(mirrorOf(design, 1));
  design = paperDesign();
  design.lower.wire_mm.back() -= 0.1;
  EXPECT_FALSE(mirrorOf(design, 0));
  EXPECT_TRUE(mirrorOf(design, 1));
  design = paperDesign();
  design.upper.z_mm.assign(10, std::vector<double>(10, 4)); // of ten row-wires with ten electrodes each
  design.upper.z_mm[2] = std::vector<double>(10, 3.8);
  EXPECT_TRUE(mirrorOf(design, 0));
  EXPECT_FALSE(mirrorOf(design, 1));
}

} // namespace
} // namespace palp
