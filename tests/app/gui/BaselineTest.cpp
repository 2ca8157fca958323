#include "tests/app/gui/Baseline.h"

#include "app/scenes/block/DeformationPicture.h"
#include "app/scenes/block/LiveScene.h"
#include "app/scenes/charts/Chart.h"
#include "app/scenes/charts/Heatmap.h"
#include "app/scenes/gl/OffscreenWindow.h"
#include "solver/SensorMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace palp {
namespace {

constexpr int kWidth_px = 480;
constexpr int kHeight_px = 320;

/// The paper's block under a smooth field in closed form, so that no change of the solver changes a picture.
class Baseline : public testing::Test {
protected:
  Baseline() {
    MeshOptions coarse;
    coarse.mapped = {9, 8, 2};
    mesh = sensorMesh(design, coarse);
    // A dent of 0.25 mm about the loaded area, sheared by 0.1 mm in x; nothing moves at the bottom.
    const Eigen::Vector2d centre(15, 7.5);
    fields.displacement_mm.setZero(3, mesh.nodeCount());
    for (Eigen::Index k = 0; k < mesh.nodeCount(); ++k) {
      const double bump = std::exp(-(mesh.nodes_mm.col(k).head<2>() - centre).squaredNorm() / 40);
      const double height = mesh.nodes_mm(2, k) / design.block_mm.z();
      fields.displacement_mm.col(k) = Eigen::Vector3d(0.1, 0, -0.25) * bump * height;
    }
    fields.cauchy_MPa.setZero(6, mesh.nodeCount());
    fields.pressure_MPa = fields.displacement_mm.row(2).transpose();
    fields.vonMises_MPa = fields.displacement_mm.colwise().norm().transpose();
    fields.volumeRatio = Eigen::VectorXd::Ones(mesh.nodeCount());
    state.design = &design;
    state.mesh = &mesh;
    state.fields = &fields;
    state.load = &load;
  }

  Picture block(const DeformationOptions& options = {}) {
    return drawDeformation(state, options, kWidth_px, kHeight_px);
  }

  static HeatmapSpec heatmap() {
    HeatmapSpec spec;
    spec.title = "Relative change of the resistances";
    spec.values.resize(10, 30);
    for (int row = 0; row < 10; ++row)
      for (int column = 0; column < 30; ++column)
        spec.values(row, column) = std::cos(0.3 * column) * std::sin(0.5 * row) * (column - 12);
    spec.values(4, 7) = std::nan("");
    spec.colors = fittingScale(ColorMap::Diverging, {-15, 15}, "dR/R", "%");
    spec.selected = {6, 20};
    return spec;
  }

  static ChartSpec chart() {
    ChartSpec spec;
    spec.title = "Error against spread";
    spec.xLabel = "spread";
    spec.yLabel = "error [%]";
    spec.logX = spec.logY = true;
    for (const double factor : {1.0, 4.0}) {
      ChartSeries series{"error of F" + std::string(factor == 1 ? "x" : "z"), {}, {}};
      series.style = factor == 1 ? ChartSeries::Style::LineAndPoints : ChartSeries::Style::Points;
      for (double x = 0.1; x < 100; x *= 1.7) {
        series.x.push_back(x);
        series.y.push_back(factor * (0.3 / x + 0.02 * x));
      }
      spec.series.push_back(series);
    }
    return spec;
  }

  SensorDesign design = paperDesign();
  LoadCase load{{{1, {0.5, 0, -6}}}, {}};
  Mesh mesh;
  NodalFields fields;
  DeformationState state;
};

TEST_F(Baseline, TheBlockUnderALoad) {
  EXPECT_TRUE(matchesBaseline(block(), "block"));
}

TEST_F(Baseline, TheBlockCutOpenInTheDark) {
  DeformationOptions options;
  options.quantity = Quantity::DisplacementZ;
  options.cut = CutPlane{1, 7.5};
  options.theme = Theme::Dark;
  options.litCell = {3, 7};
  EXPECT_TRUE(matchesBaseline(block(options), "block-cut-dark"));
}

TEST_F(Baseline, ARowWire) {
  ElectrodeDisplacements moved = ElectrodeDisplacements::atRest(design);
  moved.upper_mm.row(2).setConstant(-0.1);
  EXPECT_TRUE(matchesBaseline(drawRowWire(design, 4, &moved, 10, kWidth_px, kHeight_px), "row-wire"));
}

TEST_F(Baseline, ForcesLive) {
  LiveScene scene;
  scene.showSensor(design, {});
  scene.showForces({{1, {1, 0, -4}}, {5, {0, -1, -2}}}, false, {"Two presses", "Fz -4.00 N and -2.00 N"});
  scene.resetCamera(double(kWidth_px) / kHeight_px);
  EXPECT_TRUE(matchesBaseline(drawOnce(scene.renderer(), kWidth_px, kHeight_px), "live"));
}

TEST_F(Baseline, AHeatmap) {
  EXPECT_TRUE(matchesBaseline(drawHeatmap(heatmap(), kWidth_px, kHeight_px), "heatmap"));
}

TEST_F(Baseline, AChartWithLogarithmicAxes) {
  EXPECT_TRUE(matchesBaseline(drawChart(chart(), kWidth_px, kHeight_px), "chart"));
}

/// Between the picture and itself moved by a pixel to the right: what half a pixel does to edges and letters.
Picture blurred(const Picture& picture) {
  Picture moved = picture;
  const auto row = static_cast<std::size_t>(3 * picture.width);
  for (std::size_t k = 0; k < picture.rgb.size(); ++k)
    if (k % row >= 3) moved.rgb[k] = static_cast<std::uint8_t>((picture.rgb[k] + picture.rgb[k - 3]) / 2);
  return moved;
}

bool same(const char* what, const Picture& a, const Picture& b) {
  const PictureDifference difference = pictureDifference(a, b);
  std::cout << what << ": worst tile " << difference.worstTile << ", mean " << difference.mean << "\n";
  return looksTheSame(difference);
}

TEST_F(Baseline, ForgivesHalfAPixel) {
  for (const Picture& picture :
       {block(), drawHeatmap(heatmap(), kWidth_px, kHeight_px), drawChart(chart(), kWidth_px, kHeight_px)})
    EXPECT_TRUE(same("half a pixel", picture, blurred(picture)));
}

TEST_F(Baseline, SeesWhatIsMissingOrAnother) {
  const Picture whole = block();
  const auto with = [&](const auto& change) {
    DeformationOptions options;
    change(options);
    return block(options);
  };
  EXPECT_FALSE(same("no arrow", whole, with([](auto& options) { options.forceArrows = false; })));
  EXPECT_FALSE(same("no electrodes", whole, with([](auto& options) { options.electrodes = false; })));
  EXPECT_FALSE(
      same("another quantity", whole, with([](auto& options) { options.quantity = Quantity::DisplacementZ; })));
  EXPECT_FALSE(same("another theme", whole, with([](auto& options) { options.theme = Theme::Dark; })));
  EXPECT_FALSE(same("another warp factor", whole, with([](auto& options) { options.deformationScale = 1; })));

  const Picture cells = drawHeatmap(heatmap(), kWidth_px, kHeight_px);
  HeatmapSpec other = heatmap();
  other.colors.map = ColorMap::Viridis;
  EXPECT_FALSE(same("another colour map", cells, drawHeatmap(other, kWidth_px, kHeight_px)));
  other = heatmap();
  other.values.row(3).swap(other.values.row(9));
  EXPECT_FALSE(same("two rows in each other's place", cells, drawHeatmap(other, kWidth_px, kHeight_px)));

  ChartSpec fewer = chart();
  fewer.series.pop_back();
  EXPECT_FALSE(
      same("a series missing", drawChart(chart(), kWidth_px, kHeight_px), drawChart(fewer, kWidth_px, kHeight_px)));
}

} // namespace
} // namespace palp
