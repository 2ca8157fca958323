#pragma once

#include "app/gui/views/PictureView.h"
#include "app/scenes/charts/Heatmap.h"

namespace palp {

/// The row-column matrix as a view of its own: hovering reads a cell, clicking chooses one.
class HeatmapView : public PictureView {
  Q_OBJECT

public:
  explicit HeatmapView(QWidget* parent = nullptr);

  void setHeatmap(HeatmapSpec spec);
  void setTheme(Theme theme);
  [[nodiscard]] const HeatmapSpec& heatmap() const { return heatmap_.spec; }
  /// The middle of a cell in the widget, as last painted.
  [[nodiscard]] std::optional<std::array<int, 2>> cellAt(const QPointF& place) const;

signals:
  void cellHovered(std::optional<std::array<int, 2>> cell);
  void cellClicked(int row, int column);

protected:
  void render(QImage& image) override;
  [[nodiscard]] Picture renderPicture(int width, int height) override;

private:
  Heatmap heatmap_;
};

} // namespace palp
