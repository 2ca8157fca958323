#include "app/gui/views/ChartView.h"

#include "app/gui/views/CsvExport.h"
#include "app/gui/views/TextScale.h"
#include "app/scenes/charts/ChartSvg.h"

#include <vtkAxis.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextInteractorStyle.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkPlot.h>
#include <vtkRenderer.h>

#include <QEvent>
#include <QPainter>

#include <algorithm>
#include <utility>

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
  connect(this, &VtkView::doubleClicked, this, qOverload<>(&ChartView::fill));
  connect(this, &VtkView::sizeChanged, this, qOverload<>(&ChartView::fill)); // the legend's place
  connect(this, &VtkView::hovered, this, &ChartView::readAt);
  fill();
}

ChartView::~ChartView() = default;

void ChartView::setChart(const ChartSpec& spec) {
  if (spec == spec_) return;
  spec_ = spec;
  read_.reset();
  fill();
}

void ChartView::setTheme(Theme theme) {
  theme_ = theme;
  fill();
}

bool ChartView::empty() const {
  return std::all_of(spec_.series.begin(), spec_.series.end(),
                     [](const ChartSeries& series) { return series.x.empty(); });
}

QColor ChartView::ground() const {
  const Color& color = palp::palette(theme_).ground;
  return QColor::fromRgbF(static_cast<float>(color[0]), static_cast<float>(color[1]), static_cast<float>(color[2]));
}

void ChartView::render(QImage& image) {
  if (empty())
    image.fill(ground()); // nothing that is worth a context of its own
  else
    VtkView::render(image);
}

bool ChartView::drawPart(int part) {
  if (part > 2) return false;
  vtkChartXY& chart = *parts_->chart;
  const bool legend = chart.GetShowLegend(), automatic = chart.GetAutoAxes();
  const vtkStdString title = chart.GetTitle();
  // Hidden and shown again, not filled anew: the axes stay where the user has moved them.
  const auto show = [&](bool curves, bool words) {
    for (vtkIdType k = 0; k < chart.GetNumberOfPlots(); ++k) chart.GetPlot(k)->SetVisible(curves);
    chart.SetShowLegend(curves && legend);
    chart.SetAutoAxes(curves && automatic); // which hides axes that no curve belongs to
    chart.SetTitle(words ? title : vtkStdString());
    for (const int position : {vtkAxis::LEFT, vtkAxis::BOTTOM, vtkAxis::RIGHT, vtkAxis::TOP}) {
      axis(position).SetLabelsVisible(words);
      axis(position).SetTitleVisible(words);
    }
  };
  chart.SetRenderEmpty(part > 0);
  show(false, part == 2);
  renderUnseen(deviceSize());
  show(true, true);
  return true;
}

void ChartView::paintEvent(QPaintEvent* event) {
  VtkView::paintEvent(event);
  QPainter painter(this);
  if (faint_ && !empty()) {
    QColor veil = ground();
    veil.setAlphaF(0.6F);
    painter.fillRect(rect(), veil);
  }
  if (!empty()) return paintReading(painter);
  painter.setPen(QWidget::palette().color(QPalette::PlaceholderText));
  const QString title = QString::fromStdString(spec_.title);
  painter.drawText(rect(), Qt::AlignCenter, title.isEmpty() ? tr("no data yet") : title + tr(":\nno data yet"));
}

void ChartView::fill() {
  const double ratio = devicePixelRatioF();
  fill(ratio * textScale(*this), ratio * QSizeF(size()));
}

void ChartView::fill(double scale, const QSizeF& size) {
  const Color& color = palp::palette(theme_).ground;
  parts_->renderer->SetBackground(color[0], color[1], color[2]);
  fillChart(*parts_->chart, spec_, theme_, scale, {size.width(), size.height()});
  invalidate();
}

Picture ChartView::renderPicture(int width, int height) {
  fill(devicePixelRatioF() * textScale(*this) * magnification(width, height), QSizeF(width, height));
  Picture picture = VtkView::renderPicture(width, height);
  fill();
  return picture;
}

vtkAxis& ChartView::axis(int position) const {
  return *parts_->chart->GetAxis(position);
}

void ChartView::setFaint(bool faint) {
  if (std::exchange(faint_, faint) != faint) update();
}

QString ChartView::table() const {
  return spec_.series.empty() ? QString() : chartCsv(spec_);
}

std::string ChartView::svg() const {
  const QSize shown = size().expandedTo({600, 400}); // a tab that was never seen has no size yet
  return chartSvg(spec_, shown.width(), shown.height(), theme_, textScale(*this));
}

void ChartView::changeEvent(QEvent* event) {
  VtkView::changeEvent(event);
  if (event->type() == QEvent::FontChange) fill();
}

} // namespace palp
