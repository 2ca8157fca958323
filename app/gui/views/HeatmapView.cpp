#include "app/gui/views/HeatmapView.h"

namespace palp {

HeatmapView::HeatmapView(QWidget* parent) : PictureView(parent) {
  connect(this, &PictureView::hovered, this, [this](const QPointF& place) {
    const auto cell = cellAt(place);
    if (cell) {
      const HeatmapSpec& spec = heatmap();
      const QString value = QString::number(spec.values((*cell)[0], (*cell)[1]), 'g', 6);
      setToolTip(
          QString("row-wire %1, column-wire %2: %3 = %4 %5")
              .arg((*cell)[0])
              .arg((*cell)[1])
              .arg(QString::fromStdString(spec.colors.quantity), value, QString::fromStdString(spec.colors.unit)));
    } else {
      setToolTip({});
    }
    emit cellHovered(cell);
  });
  connect(this, &PictureView::clicked, this, [this](const QPointF& place) {
    if (const auto cell = cellAt(place)) emit cellClicked((*cell)[0], (*cell)[1]);
  });
}

void HeatmapView::setHeatmap(HeatmapSpec spec) {
  heatmap_.spec = std::move(spec);
  invalidate();
}

void HeatmapView::setTheme(Theme theme) {
  heatmap_.theme = theme;
  invalidate();
}

void HeatmapView::render(QImage& image) {
  heatmap_.scale = devicePixelRatioF();
  heatmap_.paint(image.bits(), static_cast<std::size_t>(image.bytesPerLine()), image.width(), image.height());
}

Picture HeatmapView::renderPicture(int width, int height) {
  return heatmap_.picture(width, height);
}

std::optional<std::array<int, 2>> HeatmapView::cellAt(const QPointF& place) const {
  if (place.x() < 0) return {};
  const QPointF device = devicePlace(place);
  return heatmap_.cellAt(device.x(), device.y());
}

} // namespace palp
