#include "app/scenes/block/current/CurrentLines.h"

#include "app/scenes/block/current/CurrentActor.h"
#include "model/base/Cancelled.h"
#include "solver/SensorMesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace palp {
namespace {

/// 0.75 and 0.25 A from two electrodes into a third, as if there were no walls.
CurrentSources sourcesIn(const Mesh& mesh) {
  CurrentSources sources;
  sources.displacement_mm = Eigen::Matrix3Xd::Zero(3, mesh.nodeCount());
  sources.electrodes_mm.resize(3, 3);
  sources.electrodes_mm << 12, 15, 19, 14, 20, 15, 2.5, 2.5, 2.5;
  sources.electrodes_A = Eigen::Vector3d(0.75, 0.25, -1);
  sources.density.setZero(3, mesh.nodeCount());
  for (int node = 0; node < mesh.nodeCount(); ++node)
    for (Eigen::Index e = 0; e < 3; ++e) {
      const Eigen::Vector3d d = mesh.nodes_mm.col(node) - sources.electrodes_mm.col(e);
      if (d.norm() > sources.electrodeRadius_mm)
        sources.density.col(node) += sources.electrodes_A(e) / (4 * std::numbers::pi * std::pow(d.norm(), 3)) * d;
    }
  return sources;
}

Mesh meshOf(bool mapped) {
  MeshOptions options;
  if (mapped) options.mapped = std::array<int, 3>{30, 30, 6};
  return sensorMesh(paperDesign(), options);
}

Eigen::Vector3d end(const CurrentLines& lines, const std::vector<int>& line) {
  return lines.places_mm.col(line.back());
}

class CurrentLinesOn : public testing::TestWithParam<bool> {};

TEST_P(CurrentLinesOn, BeginAtEveryElectrodeByItsCurrentAndGoToTheOneThatTakesItUp) {
  const Mesh mesh = meshOf(GetParam());
  const CurrentSources sources = sourcesIn(mesh);
  const CurrentLines lines = currentLines(mesh, sources, {});
  ASSERT_GT(lines.lines.size(), 150u);
  EXPECT_NEAR(lines.current_A * static_cast<double>(lines.lines.size()), 1, 0.1) << "all of the current";
  std::array<int, 2> begun{};
  int ended = 0;
  for (const std::vector<int>& line : lines.lines) {
    const Eigen::Vector3d first = lines.places_mm.col(line.front());
    for (std::size_t e = 0; e < 2; ++e)
      if ((first - sources.electrodes_mm.col(static_cast<Eigen::Index>(e))).norm() < 0.6) ++begun[e];
    if ((end(lines, line) - sources.electrodes_mm.col(2)).norm() < 1) ++ended;
  }
  EXPECT_NEAR(static_cast<double>(begun[0]) / static_cast<double>(begun[1]), 3, 0.15);
  // The block ends before all of the field of these points does: some lines leave through its faces.
  EXPECT_GT(ended, static_cast<int>(lines.lines.size()) / 4);
}

TEST_P(CurrentLinesOn, FollowAnEvenFlowStraightOnInTheDeformedBlock) {
  const Mesh mesh = meshOf(GetParam());
  CurrentSources sources = sourcesIn(mesh);
  sources.displacement_mm.row(2).setConstant(0.3);
  sources.density.setZero();
  sources.density.row(0).setConstant(2);
  const CurrentLines lines = currentLines(mesh, sources, {});
  ASSERT_FALSE(lines.lines.empty());
  for (const std::vector<int>& line : lines.lines)
    for (const int point : line) {
      EXPECT_NEAR(lines.places_mm(1, point), lines.places_mm(1, line.front()), 1e-6);
      EXPECT_NEAR(lines.density[static_cast<std::size_t>(point)], 2, 1e-9);
      EXPECT_NEAR(lines.displacement_mm(2, point), 0.3, 1e-9);
    }
}

INSTANTIATE_TEST_SUITE_P(Meshes, CurrentLinesOn, testing::Bool(),
                         [](const auto& mapped) { return mapped.param ? "Hexahedra" : "Tetrahedra"; });

TEST(CurrentLines, StopWhereTheyAreAsked) {
  const Mesh mesh = meshOf(true);
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(currentLines(mesh, sourcesIn(mesh), source.get_token()), Cancelled);
}

TEST(CurrentColors, SpanFactorsAndReachOverThreeDecadesAtMost) {
  CurrentLines lines;
  for (int k = 0; k < 1000; ++k) lines.density.push_back(std::pow(10, -6 + 0.006 * k));
  const ColorScale colors = currentColors(lines);
  EXPECT_TRUE(colors.logarithmic);
  EXPECT_NEAR(colors.high, std::pow(10, -0.12), 0.02);
  EXPECT_NEAR(colors.low / colors.high, 1e-3, 1e-9);
  lines.density.assign(10, 3e-4);
  const ColorScale even = currentColors(lines);
  EXPECT_LT(even.low, even.high);
  EXPECT_TRUE(currentColors({}).low > 0) << "of no lines";
}

} // namespace
} // namespace palp
