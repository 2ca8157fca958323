#include "app/gui/HeatmapView.h"

#include <QToolTip>

#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkInteractorStyleUser.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

namespace palp {

struct HeatmapView::Parts {
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkContextActor> actor;
  vtkNew<Heatmap> heatmap;
  vtkNew<vtkInteractorStyleUser> still; // a heatmap is not turned or zoomed

  Parts() {
    actor->GetScene()->AddItem(heatmap);
    actor->GetScene()->SetRenderer(renderer);
    renderer->AddActor(actor);
  }
};

HeatmapView::HeatmapView(QWidget* parent) : HeatmapView(std::make_unique<Parts>(), parent) {}

HeatmapView::HeatmapView(std::unique_ptr<Parts> parts, QWidget* parent)
    : VtkView(parts->renderer, parts->still, parent), parts_(std::move(parts)) {
  setTheme(Theme::Light);
  connect(this, &VtkView::hovered, this, [this](const QPointF& place) {
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
  connect(this, &VtkView::clicked, this, [this](const QPointF& place) {
    if (const auto cell = cellAt(place)) emit cellClicked((*cell)[0], (*cell)[1]);
  });
}

HeatmapView::~HeatmapView() = default;

void HeatmapView::setHeatmap(HeatmapSpec spec) {
  parts_->heatmap->spec = std::move(spec);
  parts_->heatmap->scale = devicePixelRatioF();
  parts_->heatmap->Modified();
  invalidate();
}

void HeatmapView::setTheme(Theme theme) {
  const Color& ground = palp::palette(theme).ground;
  parts_->renderer->SetBackground(ground[0], ground[1], ground[2]);
  parts_->heatmap->theme = theme;
  parts_->heatmap->Modified();
  invalidate();
}

const HeatmapSpec& HeatmapView::heatmap() const {
  return parts_->heatmap->spec;
}

std::optional<std::array<int, 2>> HeatmapView::cellAt(const QPointF& place) const {
  if (place.x() < 0) return {};
  const QPointF device = devicePlace(place);
  return parts_->heatmap->cellAt(device.x(), device.y());
}

} // namespace palp
