#pragma once

#include "app/gui/views/PictureView.h"
#include "app/scenes/charts/Heatmap.h"

#include <functional>

namespace palp {

/// The row-column matrix as a view of its own: hovering reads a cell, clicking chooses one; so do arrows and space.
class HeatmapView : public PictureView {
  Q_OBJECT

public:
  explicit HeatmapView(QWidget* parent = nullptr);

  void setHeatmap(HeatmapSpec spec);
  void setTheme(Theme theme);
  /// What the tool tip of a cell shows in addition to the value that is drawn; empty: nothing.
  void setCellWords(std::function<QString(const std::array<int, 2>& cell)> words) { cellWords_ = std::move(words); }
  [[nodiscard]] QString table() const override;
  [[nodiscard]] bool hasSvg() const override { return heatmap_.spec.values.size() > 0; }
  [[nodiscard]] std::string svg() const override;
  [[nodiscard]] bool worthSaving() const override { return heatmap_.spec.values.size() > 0; }
  [[nodiscard]] const HeatmapSpec& heatmap() const { return heatmap_.spec; }
  /// The middle of a cell in the widget, as last painted.
  [[nodiscard]] std::optional<std::array<int, 2>> cellAt(const QPointF& place) const;

signals:
  void cellHovered(std::optional<std::array<int, 2>> cell);
  void cellClicked(int row, int column);

protected:
  void keyPressEvent(QKeyEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void changeEvent(QEvent* event) override;
  void render(QImage& image) override;
  [[nodiscard]] Picture renderPicture(int width, int height) override;

private:
  void point(const std::optional<std::array<int, 2>>& cell);
  void walk(int rows, int columns);

  std::function<QString(const std::array<int, 2>&)> cellWords_;
  std::optional<std::array<int, 2>> walked_; ///< cell under the keys
  Heatmap heatmap_;
};

} // namespace palp
