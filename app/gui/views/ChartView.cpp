#include "app/gui/views/ChartView.h"

#include "app/gui/views/TextScale.h"

#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextInteractorStyle.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <QEvent>
#include <QPainter>

#include <algorithm>

namespace palp {

struct ChartView::Parts {
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkContextActor> actor;
  vtkNew<vtkChartXY> chart;
  vtkNew<vtkContextInteractorStyle> style;

  Parts() {
    actor->GetScene()->AddItem(chart);
    actor->GetScene()->SetRenderer(renderer);
    renderer->AddActor(actor);
    style->SetScene(actor->GetScene());
  }
};

ChartView::ChartView(QWidget* parent) : ChartView(std::make_unique<Parts>(), parent) {}

ChartView::ChartView(std::unique_ptr<Parts> parts, QWidget* parent)
    : VtkView(parts->renderer, parts->style, parent), parts_(std::move(parts)) {
  connect(this, &VtkView::doubleClicked, this, &ChartView::fill);
  connect(this, &VtkView::sizeChanged, this, &ChartView::fill); // the legend's place
  fill();
}

ChartView::~ChartView() = default;

void ChartView::setChart(const ChartSpec& spec) {
  if (spec == spec_) return;
  spec_ = spec;
  fill();
}

void ChartView::setTheme(Theme theme) {
  theme_ = theme;
  fill();
}

void ChartView::paintEvent(QPaintEvent* event) {
  VtkView::paintEvent(event);
  const bool empty =
      std::all_of(spec_.series.begin(), spec_.series.end(), [](const ChartSeries& series) { return series.x.empty(); });
  if (!empty) return;
  QPainter painter(this);
  painter.setPen(QWidget::palette().color(QPalette::PlaceholderText));
  const QString title = QString::fromStdString(spec_.title);
  painter.drawText(rect(), Qt::AlignCenter, title.isEmpty() ? tr("nothing yet") : title + tr(":\nnothing yet"));
}

void ChartView::fill() {
  const Color& ground = palp::palette(theme_).ground;
  parts_->renderer->SetBackground(ground[0], ground[1], ground[2]);
  const double ratio = devicePixelRatioF();
  fillChart(*parts_->chart, spec_, theme_, ratio * textScale(*this), {ratio * width(), ratio * height()});
  invalidate();
}

void ChartView::changeEvent(QEvent* event) {
  VtkView::changeEvent(event);
  if (event->type() == QEvent::FontChange) fill();
}

} // namespace palp
