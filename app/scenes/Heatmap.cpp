#include "app/scenes/Heatmap.h"

#include "app/scenes/OffscreenWindow.h"
#include "app/scenes/Overlay.h"
#include "app/scenes/TextStyle.h"

#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace palp {

vtkStandardNewMacro(Heatmap)

    namespace {

  /// Every how many indices a label is written, so that none touches the next.
  int labelStride(double cell_px, double label_px) {
    for (const int stride : {1, 2, 5, 10, 20, 50})
      if (stride * cell_px >= label_px) return stride;
    return 100;
  }

} // namespace

bool Heatmap::Paint(vtkContext2D* painter) {
  if (spec.values.size() == 0) return true;
  const double width = GetScene()->GetSceneWidth();
  const double height = GetScene()->GetSceneHeight();
  const double margin = 12 * scale;
  const double legend = legendWidth_px(*painter, spec.colors, theme, scale);
  left_ = margin + 46 * scale;
  bottom_ = margin + 36 * scale;
  const double right = width - 2 * margin - legend;
  const double top = height - margin - 28 * scale;
  cellWidth_ = std::max(right - left_, 1.0) / static_cast<double>(spec.values.cols());
  cellHeight_ = std::max(top - bottom_, 1.0) / static_cast<double>(spec.values.rows());
  paintCells(*painter);
  paintAxes(*painter);
  paintLegend(*painter, spec.colors, {right + margin, bottom_, 16 * scale, std::max(top - bottom_ - 18 * scale, 1.0)},
              theme, scale, width - margin);
  return true;
}

// One image, a pixel a cell, and one call for the gaps: 300 rectangles are 300 calls of the graphics library.
void Heatmap::paintCells(vtkContext2D& painter) const {
  const Eigen::Index rows = spec.values.rows(), columns = spec.values.cols();
  const auto left = static_cast<float>(left_), bottom = static_cast<float>(bottom_);
  const auto width = static_cast<float>(cellWidth_ * static_cast<double>(columns));
  const auto height = static_cast<float>(cellHeight_ * static_cast<double>(rows));
  paintColors(painter, {left_, bottom_, width, height}, columns, rows,
              [&](Eigen::Index column, Eigen::Index row) { return spec.colors.color(spec.values(row, column)); });
  if (std::min(cellWidth_, cellHeight_) > 6 * scale) {
    const double gap = std::round(scale);
    std::vector<float> ends;
    // In the middle of whole pixels, so that all gaps are equally wide.
    const auto place = [&](double edge) { return static_cast<float>(std::round(edge) - 0.5 * gap); };
    for (Eigen::Index column = 1; column < columns; ++column) {
      const float x = place(left_ + static_cast<double>(column) * cellWidth_);
      ends.insert(ends.end(), {x, bottom, x, bottom + height});
    }
    for (Eigen::Index row = 1; row < rows; ++row) {
      const float y = place(bottom_ + static_cast<double>(row) * cellHeight_);
      ends.insert(ends.end(), {left, y, left + width, y});
    }
    const Color& ground = palette(theme).ground;
    painter.GetPen()->SetLineType(vtkPen::SOLID_LINE);
    painter.GetPen()->SetColorF(ground[0], ground[1], ground[2], 1);
    painter.GetPen()->SetWidth(static_cast<float>(gap));
    painter.DrawLines(ends.data(), static_cast<int>(ends.size() / 2));
  }
  if (!spec.selected) return;
  const Color& ink = palette(theme).selection;
  painter.GetBrush()->SetOpacityF(0);
  painter.GetPen()->SetLineType(vtkPen::SOLID_LINE);
  painter.GetPen()->SetColorF(ink[0], ink[1], ink[2], 1);
  painter.GetPen()->SetWidth(static_cast<float>(2.5 * scale));
  painter.DrawRect(static_cast<float>(left_ + (*spec.selected)[1] * cellWidth_),
                   static_cast<float>(bottom_ + (*spec.selected)[0] * cellHeight_), static_cast<float>(cellWidth_),
                   static_cast<float>(cellHeight_));
  painter.GetBrush()->SetOpacityF(1);
}

void Heatmap::paintAxes(vtkContext2D& painter) const {
  const Palette& ink = palette(theme);
  vtkTextProperty& text = *painter.GetTextProp();
  setTextStyle(text, ink.text, 12 * scale);
  text.SetOrientation(0);
  text.SetJustificationToCentered();
  text.SetVerticalJustificationToTop();
  const int columnStride = labelStride(cellWidth_, 24 * scale);
  for (int column = 0; column < spec.values.cols(); column += columnStride)
    drawText(painter, left_ + (column + 0.5) * cellWidth_, bottom_ - 5 * scale, std::to_string(column));
  const double centreX = left_ + 0.5 * cellWidth_ * static_cast<double>(spec.values.cols());
  const double centreY = bottom_ + 0.5 * cellHeight_ * static_cast<double>(spec.values.rows());
  drawText(painter, centreX, bottom_ - 23 * scale, spec.columnLabel);
  text.SetJustificationToRight();
  text.SetVerticalJustificationToCentered();
  const int rowStride = labelStride(cellHeight_, 16 * scale);
  for (int row = 0; row < spec.values.rows(); row += rowStride)
    drawText(painter, left_ - 6 * scale, bottom_ + (row + 0.5) * cellHeight_, std::to_string(row));
  text.SetJustificationToCentered();
  text.SetOrientation(90);
  drawText(painter, 18 * scale, centreY, spec.rowLabel);
  setTextStyle(text, ink.text, 14 * scale, true);
  text.SetOrientation(0);
  text.SetJustificationToLeft();
  drawText(painter, left_, bottom_ + static_cast<double>(spec.values.rows()) * cellHeight_ + 18 * scale, spec.title);
}

std::optional<std::array<int, 2>> Heatmap::cellAt(double x_px, double y_px) const {
  if (!(cellWidth_ > 0) || !(cellHeight_ > 0)) return {};
  const double column = std::floor((x_px - left_) / cellWidth_);
  const double row = std::floor((y_px - bottom_) / cellHeight_);
  if (row < 0 || column < 0 || row >= static_cast<double>(spec.values.rows()) ||
      column >= static_cast<double>(spec.values.cols()))
    return {};
  return std::array{static_cast<int>(row), static_cast<int>(column)};
}

Picture drawHeatmap(const HeatmapSpec& spec, int width, int height, Theme theme) {
  vtkNew<Heatmap> heatmap;
  heatmap->spec = spec;
  heatmap->theme = theme;
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(heatmap);
  vtkNew<vtkRenderer> renderer;
  const Color& ground = palette(theme).ground;
  renderer->SetBackground(ground[0], ground[1], ground[2]);
  actor->GetScene()->SetRenderer(renderer);
  renderer->AddActor(actor);
  return drawOnce(renderer, width, height);
}

} // namespace palp
