#pragma once

#include "app/scenes/ColorScale.h"
#include "app/scenes/Picture.h"
#include "app/scenes/charts/Canvas.h"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <vector>

class vtkLookupTable;

namespace palp {

/// A matrix as coloured cells: row 0 at the bottom, as the row-wires lie along y.
struct HeatmapSpec {
  std::string title;
  Eigen::MatrixXd values; ///< rows x columns
  ColorScale colors;
  std::string rowLabel = "row-wire";
  std::string columnLabel = "column-wire";
  std::optional<std::array<int, 2>> selected;         ///< row, column outlined
  std::vector<std::string> rowTicks{}, columnTicks{}; ///< words at the cells; empty: their numbers
};

/// The heatmap with axes and legend, for a view that stays. VTK's colours and letters, painted by the processor: some
/// 300 cells need no graphics context.
class Heatmap {
public:
  /// Onto pixels as Canvas takes them.
  void paint(std::uint8_t* bgra, std::size_t stride, int width, int height);
  /// The same as the text of an SVG file: rectangles and letters.
  [[nodiscard]] std::string svg(int width, int height) const;
  /// The same in a picture of its own.
  [[nodiscard]] Picture picture(int width, int height) const;
  /// Row and column of the cell at a point of the picture [px from the lower left], as last painted.
  [[nodiscard]] std::optional<std::array<int, 2>> cellAt(double x_px, double y_px) const;

  /// The same cell's lower left corner and size [px]; empty before it was painted.
  [[nodiscard]] std::optional<std::array<double, 4>> cellBox(const std::array<int, 2>& cell) const;

  HeatmapSpec spec;
  Theme theme = Theme::Light;
  double scale = 1;

private:
  /// Right sides and tops of cells; their left and lower sides are those of the cell before.
  [[nodiscard]] double columnEdge(Eigen::Index column) const {
    return left_ + cellWidth_ * static_cast<double>(column);
  }
  [[nodiscard]] double rowEdge(Eigen::Index row) const { return bottom_ + cellHeight_ * static_cast<double>(row); }
  void paint(Canvas& canvas);
  void paintCells(Canvas& canvas, vtkLookupTable& table) const;
  void paintAxes(Canvas& canvas) const;
  void paintLegend(Canvas& canvas, vtkLookupTable& table, double x, double width) const;

  WrittenWords written_;
  double left_ = 0, bottom_ = 0, cellWidth_ = 0, cellHeight_ = 0; ///< [px], as last painted
};

Picture drawHeatmap(const HeatmapSpec& spec, int width = 900, int height = 400, Theme theme = Theme::Light);

} // namespace palp
