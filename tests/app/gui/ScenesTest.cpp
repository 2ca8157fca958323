#include "app/scenes/ColorScale.h"
#include "app/scenes/VtuFile.h"
#include "app/scenes/block/DeformationPicture.h"
#include "app/scenes/block/MeshSurface.h"
#include "app/scenes/charts/Canvas.h"
#include "app/scenes/charts/Chart.h"
#include "app/scenes/charts/ChartLegend.h"
#include "app/scenes/charts/Heatmap.h"
#include "app/scenes/charts/TextStyle.h"
#include "model/base/Error.h"
#include "solver/SensorMesh.h"

#include <QImage>
#include <QTemporaryDir>

#include <vtkTextProperty.h>

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

namespace palp {
namespace {

MeshOptions coarse() {
  MeshOptions options;
  options.mapped = {6, 6, 2};
  return options;
}

/// A smooth field that vanishes at the bottom.
NodalFields pushedIn(const Mesh& mesh, double depth_mm) {
  NodalFields fields;
  fields.displacement_mm = Eigen::Matrix3Xd::Zero(3, mesh.nodeCount());
  fields.displacement_mm.row(2) = -depth_mm / 5 * mesh.nodes_mm.row(2);
  fields.cauchy_MPa.setZero(6, mesh.nodeCount());
  fields.pressure_MPa = Eigen::VectorXd::LinSpaced(mesh.nodeCount(), -1, 1);
  fields.vonMises_MPa = fields.pressure_MPa.cwiseAbs();
  fields.volumeRatio = Eigen::VectorXd::Ones(mesh.nodeCount());
  fields.principalStretches = Eigen::Matrix3Xd::Ones(3, mesh.nodeCount());
  return fields;
}

TEST(ColorScale, OfSignedValuesIsCentredOnZero) {
  const ColorScale scale = fittingScale(ColorMap::Diverging, {-1, 3}, "ux", "mm");
  EXPECT_EQ(scale.low, -3);
  EXPECT_EQ(scale.high, 3);
  EXPECT_EQ(scale.title(), "ux [mm]");
}

TEST(ColorScale, OfAConstantOrEmptyFieldStillHasARange) {
  for (const std::vector<double>& values :
       {std::vector<double>{}, {0, 0}, {2, 2}, {std::numeric_limits<double>::quiet_NaN()}})
    for (const ColorMap map : {ColorMap::Viridis, ColorMap::Diverging}) {
      const ColorScale scale = fittingScale(map, values, "q", "");
      EXPECT_LT(scale.low, scale.high);
    }
}

TEST(ColorScale, TicksAreRoundAndToldApart) {
  EXPECT_EQ(tickTexts(roundTicks(0, 0.1, 5)),
            (std::vector<std::string>{"0.00", "0.02", "0.04", "0.06", "0.08", "0.10"}));
  const std::vector<std::string> fine = tickTexts(roundTicks(1000, 1000.4, 5));
  EXPECT_EQ(std::set<std::string>(fine.begin(), fine.end()).size(), fine.size());
}

TEST(Chart, DrawsInBothThemesAndLeavesOutWhatALogAxisCannotShow) {
  ChartSpec spec;
  spec.title = "title";
  spec.xLabel = "x [mm]";
  spec.yLabel = "y [N]";
  spec.logX = spec.logY = true;
  spec.series.push_back({"curve", {0, 0.1, 1, 10}, {1, -1, std::numeric_limits<double>::quiet_NaN(), 100}});
  for (const Theme theme : {Theme::Light, Theme::Dark}) {
    const Picture picture = drawChart(spec, 400, 300, theme);
    EXPECT_EQ(picture.width, 400);
    // Without the two pairs that a logarithmic axis cannot show it is the same picture.
    ChartSpec shown = spec;
    shown.series[0] = {"curve", {10}, {100}};
    EXPECT_EQ(picture.rgb, drawChart(shown, 400, 300, theme).rgb);
  }
}

TEST(ChartLegend, StandsWhereItCoversNothing) {
  const LegendShare share{0.3, 0.3};
  std::vector<std::vector<std::array<double, 2>>> rising{{}};
  addBetween(rising[0], {0, 0}, {1, 1});
  const LegendCorner beside = freestCorner(rising, share);
  EXPECT_EQ(beside.covered, 0);
  EXPECT_TRUE(beside.left && !beside.bottom) << "a rising curve leaves the upper left corner free";
  addBetween(rising[0], {0, 1}, {1, 0});
  EXPECT_GT(freestCorner(rising, share).covered, 0) << "a cross reaches every corner";
}

/// Pixels of exactly this colour.
std::ptrdiff_t pixelsOf(const Picture& picture, const Color& color) {
  std::ptrdiff_t count = 0;
  for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3) {
    bool same = true;
    for (std::size_t c = 0; c < 3; ++c) same = same && picture.rgb[i + c] == std::lround(255 * color[c]);
    count += same ? 1 : 0;
  }
  return count;
}

TEST(ChartLegend, OfManyNamesLeavesEveryPointInSight) {
  ChartSpec spec;
  for (int k = 0; k < 10; ++k) {
    ChartSeries series{"decoder " + std::to_string(k), {0, 0.5 + 0.03 * k, 1}, {0.1 * k, 0.1 * k, 1 - 0.1 * k}};
    series.style = ChartSeries::Style::Points;
    spec.series.push_back(series);
  }
  ChartSpec bare = spec;
  for (ChartSeries& series : bare.series) series.legend = "";
  const Picture with = drawChart(spec, 520, 300, Theme::Light), without = drawChart(bare, 520, 300, Theme::Light);
  for (int k = 0; k < 10; ++k)
    EXPECT_GE(pixelsOf(with, seriesColor(k, Theme::Light)), 0.95 * pixelsOf(without, seriesColor(k, Theme::Light)))
        << k << ": a legend only adds its symbol";
}

TEST(Picture, IsWrittenAsAPngThatOthersRead) {
  const QTemporaryDir folder;
  const std::string file = folder.filePath("a.png").toStdString();
  writePng({2, 1, {255, 0, 0, 0, 0, 255}}, file);
  const QImage image(QString::fromStdString(file));
  EXPECT_EQ(image.pixelColor(0, 0), QColor(255, 0, 0));
  EXPECT_EQ(image.pixelColor(1, 0), QColor(0, 0, 255));
  EXPECT_THROW(writePng({1, 1, {0, 0, 0}}, "/no/such/folder/a.png"), Error);
}

TEST(Deformation, DrawsEveryQuantity) {
  const SensorDesign design = paperDesign();
  const Mesh mesh = sensorMesh(design, coarse());
  const NodalFields fields = pushedIn(mesh, 0.1);
  const LoadCase load{{{1, {0.5, 0, -6}}}, {}};
  DeformationState state;
  state.design = &design;
  state.mesh = &mesh;
  state.fields = &fields;
  state.load = &load;
  std::vector<Picture> pictures;
  for (const Quantity quantity : allQuantities()) {
    DeformationOptions options;
    options.quantity = quantity;
    const Picture picture = drawDeformation(state, options, 320, 240);
    for (const Picture& other : pictures) EXPECT_NE(picture.rgb, other.rgb) << quantityName(quantity);
    pictures.push_back(picture);
  }
}

TEST(Deformation, LightsUpTheElectrodesOfACellInsideTheBlock) {
  const SensorDesign design = paperDesign();
  const Mesh mesh = sensorMesh(design, coarse());
  DeformationState state;
  state.design = &design;
  state.mesh = &mesh;
  DeformationOptions options;
  const Picture plain = drawDeformation(state, options, 640, 480);
  options.litCell = {3, 7};
  const Picture lit = drawDeformation(state, options, 640, 480);
  std::size_t changed = 0;
  for (std::size_t k = 0; k + 2 < plain.rgb.size(); k += 3)
    if (!std::equal(&plain.rgb[k], &plain.rgb[k + 3], &lit.rgb[k])) ++changed;
  // 13 electrodes of some 80 pixels each, where nothing hides them.
  EXPECT_GT(changed, 500u);
  EXPECT_LT(changed, 4000u);
}

TEST(Deformation, WarpsByARoundFactorThatNeverShrinks) {
  const SensorDesign design = paperDesign();
  const Eigen::Matrix3Xd small = Eigen::Matrix3Xd::Constant(3, 4, 0.01);
  const Eigen::Matrix3Xd large = Eigen::Matrix3Xd::Constant(3, 4, 3);
  EXPECT_EQ(automaticDeformationScale(design, small), 50);
  EXPECT_EQ(automaticDeformationScale(design, large), 1);
  EXPECT_EQ(automaticDeformationScale(design, Eigen::Matrix3Xd::Zero(3, 4)), 1);
}

TEST(Canvas, FillsWholePixelsFromTheLowerLeftAndNothingOutside) {
  QImage image(4, 3, QImage::Format_RGB32);
  WrittenWords written;
  Canvas canvas(image.bits(), static_cast<std::size_t>(image.bytesPerLine()), 4, 3, written);
  canvas.clear({1, 1, 1});
  canvas.fill(0.6, -5, 3.4, 1.2, {1, 0, 0});
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x)
      EXPECT_EQ(image.pixelColor(x, y), y == 2 && (x == 1 || x == 2) ? QColor(255, 0, 0) : QColor(255, 255, 255))
          << x << ", " << y;
}

TEST(Canvas, WritesWordsAboutTheirPlaceAndCutsThemAtTheEdges) {
  QImage image(60, 20, QImage::Format_RGB32);
  WrittenWords written;
  Canvas canvas(image.bits(), static_cast<std::size_t>(image.bytesPerLine()), 60, 20, written);
  const auto inked = [&](int from, int to) {
    int count = 0;
    for (int y = 0; y < 20; ++y)
      for (int x = from; x < to; ++x) count += image.pixelColor(x, y) == QColor(255, 255, 255) ? 0 : 1;
    return count;
  };
  canvas.clear({1, 1, 1});
  setTextStyle(canvas.textStyle(), {0, 0, 0}, 12);
  canvas.textStyle().SetJustificationToRight();
  canvas.textStyle().SetVerticalJustificationToCentered();
  canvas.words(30, 10, "888");
  EXPECT_GT(inked(0, 30), 20);
  EXPECT_EQ(inked(31, 60), 0);
  const QImage first = image.copy();
  canvas.clear({1, 1, 1});
  canvas.words(30, 10, "888");
  EXPECT_EQ(image, first) << "words that were kept";
  EXPECT_NEAR(canvas.wordsWidth_px("888"), 22, 8);
  for (const double x : {-300.0, -5.0, 0.0, 59.0, 300.0})
    for (const double y : {-300.0, 0.0, 19.0, 300.0}) canvas.words(x, y, "[dR/R]");
}

TEST(Heatmap, PaintsEachCellInTheColourOfItsValueWhereItSaysThatTheCellIs) {
  Heatmap heatmap;
  heatmap.spec.values = (Eigen::MatrixXd(2, 3) << -1, 0, 1, 0.5, -0.5, std::nan("")).finished();
  heatmap.spec.colors = {ColorMap::Diverging, -1, 1, "dR/R", "%"};
  QImage image(300, 200, QImage::Format_RGB32);
  heatmap.paint(image.bits(), static_cast<std::size_t>(image.bytesPerLine()), 300, 200);
  std::array<std::array<int, 3>, 2> seen{};
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 300; ++x) {
      const auto cell = heatmap.cellAt(x + 0.5, 199 - y + 0.5);
      const auto edge = [&](double dx, double dy) { return heatmap.cellAt(x + 0.5 + dx, 199 - y + 0.5 + dy) != cell; };
      if (!cell || edge(2, 0) || edge(-2, 0) || edge(0, 2) || edge(0, -2)) continue;
      ++seen.at(static_cast<std::size_t>((*cell)[0])).at(static_cast<std::size_t>((*cell)[1]));
      const Color wanted = heatmap.spec.colors.color(heatmap.spec.values((*cell)[0], (*cell)[1]));
      const QColor is = image.pixelColor(x, y);
      // A table of 256 colours: half a step of it changes a part by less than 4 of 255.
      ASSERT_NEAR(is.red(), 255 * wanted[0], 4) << x << ", " << y;
      ASSERT_NEAR(is.blue(), 255 * wanted[2], 4) << x << ", " << y;
    }
  for (const auto& row : seen)
    for (const int pixels : row) EXPECT_GT(pixels, 100);
}

TEST(MeshSurface, OfABlockIsClosed) {
  for (const MeshOptions& options : {coarse(), MeshOptions{4.0, {}}}) {
    const Mesh mesh = sensorMesh(paperDesign(), options);
    const MeshSurface surface = meshSurface(mesh);
    // Twice the area vectors of a closed surface add up to nothing; all its area is that of the box.
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double area = 0;
    for (const std::array<int, 3>& triangle : surface.triangles) {
      const auto point = [&](int k) -> Eigen::Vector3d {
        return mesh.nodes_mm.col(surface.nodes[static_cast<std::size_t>(triangle[static_cast<std::size_t>(k)])]);
      };
      const Eigen::Vector3d twice = (point(1) - point(0)).cross(point(2) - point(0));
      sum += twice;
      area += twice.norm() / 2;
    }
    EXPECT_LT(sum.norm(), 1e-9) << "rounding of a sum of thousands of terms of size 1";
    EXPECT_NEAR(area, 2 * 30 * 30 + 4 * 30 * 5, 1e-6);
  }
}

TEST(MeshSurface, FindsTheTopFaceUnderAPoint) {
  const Mesh mesh = sensorMesh(paperDesign(), coarse());
  const TopPoint point = topPoint(mesh, {12.3, 4.5});
  EXPECT_LT((point.of(mesh.nodes_mm) - Eigen::Vector3d(12.3, 4.5, 5)).norm(), 1e-9);
}

TEST(VtuFile, HoldsTheMeshAndItsFields) {
  const QTemporaryDir folder;
  const std::string file = folder.filePath("a.vtu").toStdString();
  const Mesh mesh = sensorMesh(paperDesign(), coarse());
  writeVtu(file, mesh, nodalArrays(pushedIn(mesh, 0.1)));
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  EXPECT_NE(text.str().find("NumberOfPoints=\"" + std::to_string(mesh.nodeCount())), std::string::npos);
  for (const char* name : {"displacement_mm", "cauchy_MPa", "pressure_MPa", "von_mises_MPa", "volume_ratio"})
    EXPECT_NE(text.str().find(name), std::string::npos) << name;
  EXPECT_THROW(writeVtu("/no/such/folder/a.vtu", mesh), Error);
}

} // namespace
} // namespace palp
