#pragma once

#include "app/gui/VtkView.h"
#include "app/scenes/Heatmap.h"

namespace palp {

/// The row-column matrix as a view of its own: hovering reads a cell, clicking chooses one.
class HeatmapView : public VtkView {
  Q_OBJECT

public:
  explicit HeatmapView(QWidget* parent = nullptr);
  ~HeatmapView() override;

  void setHeatmap(HeatmapSpec spec);
  void setTheme(Theme theme);
  [[nodiscard]] const HeatmapSpec& heatmap() const;
  /// The middle of a cell in the widget, as last painted.
  [[nodiscard]] std::optional<std::array<int, 2>> cellAt(const QPointF& place) const;

signals:
  void cellHovered(std::optional<std::array<int, 2>> cell);
  void cellClicked(int row, int column);

private:
  struct Parts;
  HeatmapView(std::unique_ptr<Parts> parts, QWidget* parent);

  std::unique_ptr<Parts> parts_;
};

} // namespace palp
