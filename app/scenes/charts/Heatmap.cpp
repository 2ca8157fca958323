#include "app/scenes/charts/Heatmap.h"

#include "app/scenes/block/Overlay.h"
#include "app/scenes/charts/SvgCanvas.h"
#include "app/scenes/charts/TextStyle.h"

#include <vtkLookupTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace palp {

namespace {

constexpr double kTitle_px = 14, kLeastTitle_px = 9; // of a long title in a narrow view

/// Every how many indices a label is written, so that none touches the next.
int labelStride(double cell_px, double label_px) {
  for (const int stride : {1, 2, 5, 10, 20, 50})
    if (stride * cell_px >= label_px) return stride;
  return 100;
}

Color mapped(vtkLookupTable& table, double value) {
  Color color{};
  table.GetColor(value, color.data());
  return color;
}

/// The label at a cell of an axis.
std::string tick(const std::vector<std::string>& words, int cell) {
  return words.empty() ? std::to_string(cell) : words[static_cast<std::size_t>(cell)];
}

/// Upright words about a place; `justification` as VTK counts: 0 left or bottom, 1 centre, 2 right or top.
void useText(const Canvas& canvas, const Color& color, double size_px, bool bold, int across, int along) {
  vtkTextProperty& text = canvas.textStyle();
  setTextStyle(text, color, size_px, bold);
  text.SetOrientation(0);
  text.SetJustification(across);
  text.SetVerticalJustification(along);
}

double legendWidth_px(Canvas& canvas, const ColorScale& colors, Theme theme, double scale) {
  useText(canvas, palette(theme).text, 12 * scale, false, VTK_TEXT_LEFT, VTK_TEXT_CENTERED);
  double widest = 0;
  for (const std::string& text : tickTexts(legendTicks(colors, 200 * scale, scale)))
    widest = std::max(widest, canvas.wordsWidth_px(text));
  const double numbers = (kLegendBar_px + 2 * kLegendTick_px) * scale + widest;
  useText(canvas, palette(theme).text, 13 * scale, true, VTK_TEXT_LEFT, VTK_TEXT_CENTERED);
  return std::max(numbers, canvas.wordsWidth_px(colors.title()));
}

} // namespace

void Heatmap::paint(std::uint8_t* bgra, std::size_t stride, int width, int height) {
  Canvas canvas(bgra, stride, width, height, written_);
  paint(canvas);
}

void Heatmap::paint(Canvas& canvas) {
  canvas.clear(palette(theme).ground);
  if (spec.values.size() == 0) {
    cellWidth_ = cellHeight_ = 0;
    useText(canvas, palette(theme).text, 14 * scale, true, VTK_TEXT_LEFT, VTK_TEXT_CENTERED);
    canvas.words(12 * scale, canvas.height() - 24 * scale, spec.title);
    return;
  }
  const double margin = 12 * scale;
  const double legend = legendWidth_px(canvas, spec.colors, theme, scale);
  left_ = margin + 46 * scale;
  bottom_ = margin + 36 * scale;
  const double right = canvas.width() - 2 * margin - legend;
  const double top = canvas.height() - margin - 28 * scale;
  cellWidth_ = std::max(right - left_, 1.0) / static_cast<double>(spec.values.cols());
  cellHeight_ = std::max(top - bottom_, 1.0) / static_cast<double>(spec.values.rows());
  const vtkSmartPointer<vtkLookupTable> table = lookupTable(spec.colors);
  paintCells(canvas, *table);
  paintAxes(canvas);
  paintLegend(canvas, *table, right + margin, legend);
}

void Heatmap::paintCells(Canvas& canvas, vtkLookupTable& table) const {
  // All edges on pixels, so that all gaps are equally wide.
  const double gap = std::min(cellWidth_, cellHeight_) > 6 * scale ? std::round(scale) : 0;
  for (Eigen::Index row = 0; row < spec.values.rows(); ++row)
    for (Eigen::Index column = 0; column < spec.values.cols(); ++column)
      canvas.fill(std::round(columnEdge(column)), std::round(rowEdge(row)),
                  std::round(columnEdge(column + 1)) - (column + 1 < spec.values.cols() ? gap : 0),
                  std::round(rowEdge(row + 1)) - (row + 1 < spec.values.rows() ? gap : 0),
                  mapped(table, spec.values(row, column)));
  if (!spec.selected) return;
  const double thickness = std::round(2.5 * scale), outside = std::round(0.5 * thickness);
  const auto [row, column] = *spec.selected;
  canvas.frame(columnEdge(column) - outside, rowEdge(row) - outside, columnEdge(column + 1) + outside,
               rowEdge(row + 1) + outside, thickness, palette(theme).selection);
}

void Heatmap::paintAxes(Canvas& canvas) const {
  const Color& ink = palette(theme).text;
  const double top = rowEdge(spec.values.rows());
  const double centreX = 0.5 * (left_ + columnEdge(spec.values.cols())), centreY = 0.5 * (bottom_ + top);
  useText(canvas, ink, 12 * scale, false, VTK_TEXT_CENTERED, VTK_TEXT_TOP);
  const int columnStride = labelStride(cellWidth_, 24 * scale);
  for (int column = 0; column < spec.values.cols(); column += columnStride)
    canvas.words(columnEdge(column) + 0.5 * cellWidth_, bottom_ - 5 * scale, tick(spec.columnTicks, column));
  canvas.words(centreX, bottom_ - 23 * scale, spec.columnLabel);
  useText(canvas, ink, 12 * scale, false, VTK_TEXT_RIGHT, VTK_TEXT_CENTERED);
  const int rowStride = labelStride(cellHeight_, 16 * scale);
  for (int row = 0; row < spec.values.rows(); row += rowStride)
    canvas.words(left_ - 6 * scale, rowEdge(row) + 0.5 * cellHeight_, tick(spec.rowTicks, row));
  useText(canvas, ink, 12 * scale, false, VTK_TEXT_CENTERED, VTK_TEXT_CENTERED);
  canvas.textStyle().SetOrientation(90);
  canvas.words(18 * scale, centreY, spec.rowLabel);
  const double whole = canvas.width() - 24 * scale;
  double size = kTitle_px;
  const auto width = [&] {
    useText(canvas, ink, size * scale, true, VTK_TEXT_LEFT, VTK_TEXT_CENTERED);
    return canvas.wordsWidth_px(spec.title);
  };
  while (width() > whole && size > kLeastTitle_px) --size;
  const double room = canvas.width() - 12 * scale - width(); // a long one begins further left
  canvas.words(std::clamp(room, 12 * scale, std::max(left_, 12 * scale)), top + 18 * scale, spec.title);
}

void Heatmap::paintLegend(Canvas& canvas, vtkLookupTable& table, double x, double width) const {
  const ColorScale& colors = spec.colors;
  const Color& ink = palette(theme).text;
  const double height = std::max(rowEdge(spec.values.rows()) - bottom_ - kLegendTitle_px * scale, 1.0);
  const double right = x + kLegendBar_px * scale;
  for (double y = 0; y < height; ++y)
    canvas.fill(x, bottom_ + y, right, bottom_ + y + 1,
                mapped(table, colors.low + (colors.high - colors.low) * (y + 0.5) / height));
  useText(canvas, ink, 12 * scale, false, VTK_TEXT_LEFT, VTK_TEXT_CENTERED);
  const std::vector<double> ticks = legendTicks(colors, height, scale);
  const std::vector<std::string> texts = tickTexts(ticks);
  for (std::size_t k = 0; k < ticks.size(); ++k) {
    const double y = std::round(bottom_ + (ticks[k] - colors.low) / (colors.high - colors.low) * height);
    canvas.fill(right, y, right + kLegendTick_px * scale, y + std::max(std::round(scale), 1.0), ink);
    canvas.words(right + 2 * kLegendTick_px * scale, y, texts[k]);
  }
  useText(canvas, ink, 13 * scale, true, VTK_TEXT_LEFT, VTK_TEXT_CENTERED);
  canvas.words(std::min(x, x + width - canvas.wordsWidth_px(colors.title())),
               bottom_ + height + kLegendTitle_px * scale, colors.title());
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

std::optional<std::array<double, 4>> Heatmap::cellBox(const std::array<int, 2>& cell) const {
  if (!(cellWidth_ > 0) || !(cellHeight_ > 0)) return {};
  return std::array{columnEdge(cell[1]), rowEdge(cell[0]), cellWidth_, cellHeight_};
}

std::string Heatmap::svg(int width, int height) const {
  requireDrawable(width, height);
  Heatmap copy = *this; // the cells of cellAt stay those of the view
  SvgCanvas canvas(width, height, copy.written_);
  copy.paint(canvas);
  return canvas.svg();
}

Picture Heatmap::picture(int width, int height) const {
  requireDrawable(width, height);
  std::vector<std::uint8_t> bgra(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  Heatmap(*this).paint(bgra.data(), 4 * static_cast<std::size_t>(width), width,
                       height); // of a copy: the cells of cellAt stay those of the view
  return pictureOfBgra(bgra, width, height);
}

Picture drawHeatmap(const HeatmapSpec& spec, int width, int height, Theme theme) {
  Heatmap heatmap;
  heatmap.spec = spec;
  heatmap.theme = theme;
  return heatmap.picture(width, height);
}

} // namespace palp
