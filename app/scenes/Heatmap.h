#pragma once

#include "app/scenes/ColorScale.h"
#include "app/scenes/Picture.h"

#include <vtkContextItem.h>

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>

namespace palp {

/// A matrix as coloured cells: row 0 at the bottom, as the row-wires lie along y.
struct HeatmapSpec {
  std::string title;
  Eigen::MatrixXd values; ///< rows x columns
  ColorScale colors;
  std::string rowLabel = "row-wire";
  std::string columnLabel = "column-wire";
  std::optional<std::array<int, 2>> selected; ///< row, column outlined
};

/// The heatmap as an item of a VTK scene, for a view that stays.
class Heatmap : public vtkContextItem {
public:
  static Heatmap* New();
  vtkTypeMacro(Heatmap, vtkContextItem)

      bool Paint(vtkContext2D* painter) override;
  /// Row and column of the cell at a point of the view [px from the lower left], as last painted.
  [[nodiscard]] std::optional<std::array<int, 2>> cellAt(double x_px, double y_px) const;

  HeatmapSpec spec;
  Theme theme = Theme::Light;
  double scale = 1;

private:
  void paintCells(vtkContext2D& painter) const;
  void paintAxes(vtkContext2D& painter) const;

  double left_ = 0, bottom_ = 0, cellWidth_ = 0, cellHeight_ = 0; ///< [px], as last painted
};

Picture drawHeatmap(const HeatmapSpec& spec, int width = 900, int height = 400, Theme theme = Theme::Light);

} // namespace palp
