// The point of a chart that is read, and what keys do with a chart.

#include "app/gui/views/ChartView.h"

#include <vtkAxis.h>
#include <vtkChartXY.h>

#include <QKeyEvent>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr double kReach_px = 14;  ///< of the pointer
constexpr double kKeyShare = 0.1; ///< of what an axis shows, that a key moves
constexpr double kKeyZoom = 1.25;
constexpr double kRing_px = 5;

/// A value's share of an axis.
double shareOf(vtkAxis& axis, double value) {
  const double low = axis.GetMinimum(), high = axis.GetMaximum(); // logarithms on a logarithmic one
  return ((axis.GetLogScaleActive() ? std::log10(value) : value) - low) / (high - low);
}

QString shortNumber(double value) {
  return QString::number(value, 'g', 5);
}

} // namespace

std::optional<QPointF> ChartView::placeOf(const Point& point) const {
  const ChartSeries& series = spec_.series[point.series];
  vtkAxis& x = axis(vtkAxis::BOTTOM);
  vtkAxis& y = axis(vtkAxis::LEFT);
  const double across = shareOf(x, series.x[point.at]), up = shareOf(y, series.y[point.at]);
  if (!(across >= 0 && across <= 1 && up >= 0 && up <= 1)) return {}; // nor where a logarithm has no value
  const double ratio = devicePixelRatioF();
  const double x_px = x.GetPoint1()[0] + across * (x.GetPoint2()[0] - x.GetPoint1()[0]);
  const double y_px = y.GetPoint1()[1] + up * (y.GetPoint2()[1] - y.GetPoint1()[1]);
  return QPointF(x_px / ratio, height() - y_px / ratio);
}

QString ChartView::reading() const {
  if (!read_) return {};
  const ChartSeries& series = spec_.series[read_->series];
  const QString name = series.name.empty() ? QString() : QString::fromStdString(series.name) + ": ";
  return name + QString("%1, %2").arg(shortNumber(series.x[read_->at]), shortNumber(series.y[read_->at]));
}

void ChartView::readAt(const QPointF& place) {
  const auto before = reading();
  read_.reset();
  double least = kReach_px;
  for (std::size_t k = 0; k < spec_.series.size(); ++k)
    for (std::size_t at = 0; at < std::min(spec_.series[k].x.size(), spec_.series[k].y.size()); ++at) {
      const auto drawn = placeOf({k, at});
      if (!drawn) continue;
      const double away = std::hypot(drawn->x() - place.x(), drawn->y() - place.y());
      if (away >= least) continue;
      least = away;
      read_ = Point{k, at};
    }
  if (reading() != before) update();
}

void ChartView::readNext(int points, int curves) {
  const auto count = [this](std::size_t k) { return std::min(spec_.series[k].x.size(), spec_.series[k].y.size()); };
  const auto curveCount = static_cast<int>(spec_.series.size());
  if (curveCount == 0) return;
  int curve = read_ ? static_cast<int>(read_->series) + curves : 0;
  curve = (curve + curveCount) % curveCount;
  const auto series = static_cast<std::size_t>(curve);
  if (count(series) == 0) return;
  const int last = static_cast<int>(count(series)) - 1;
  const int at = read_ ? std::clamp(static_cast<int>(read_->at) + points, 0, last) : 0;
  read_ = Point{series, static_cast<std::size_t>(at)};
  setAccessibleDescription(reading());
  update();
}

void ChartView::paintReading(QPainter& painter) const {
  const auto place = read_ ? placeOf(*read_) : std::nullopt;
  if (!place) return;
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(QWidget::palette().color(QPalette::WindowText), 1.5));
  painter.drawEllipse(*place, kRing_px, kRing_px);
  const QString words = reading();
  QRectF box = QRectF(painter.fontMetrics().boundingRect(words)).adjusted(-4, -2, 4, 2);
  box.moveBottomLeft(*place + QPointF(8, -8));
  box.moveLeft(std::clamp(box.left(), 0.0, std::max(0.0, width() - box.width())));
  box.moveTop(std::max(box.top(), 0.0));
  painter.fillRect(box, QWidget::palette().color(QPalette::ToolTipBase));
  painter.setPen(QWidget::palette().color(QPalette::ToolTipText));
  painter.drawText(box, Qt::AlignCenter, words);
}

void ChartView::moveAxes(double x, double y, double zoom) {
  for (const auto& [position, share] : {std::pair{vtkAxis::BOTTOM, x}, std::pair{vtkAxis::LEFT, y}}) {
    vtkAxis& moved = axis(position);
    const double low = moved.GetMinimum(), high = moved.GetMaximum();
    const double middle = 0.5 * (low + high) + share * (high - low), half = 0.5 * (high - low) / zoom;
    moved.SetRange(middle - half, middle + half);
  }
  invalidate();
}

void ChartView::keyPressEvent(QKeyEvent* event) {
  const bool reads = event->modifiers().testFlag(Qt::ControlModifier);
  switch (event->key()) {
  case Qt::Key_Left:
    return reads ? readNext(-1, 0) : moveAxes(-kKeyShare, 0, 1);
  case Qt::Key_Right:
    return reads ? readNext(1, 0) : moveAxes(kKeyShare, 0, 1);
  case Qt::Key_Up:
    return reads ? readNext(0, -1) : moveAxes(0, kKeyShare, 1);
  case Qt::Key_Down:
    return reads ? readNext(0, 1) : moveAxes(0, -kKeyShare, 1);
  case Qt::Key_Plus:
  case Qt::Key_Equal:
    if (reads) break;
    return moveAxes(0, 0, kKeyZoom);
  case Qt::Key_Minus:
    if (reads) break;
    return moveAxes(0, 0, 1 / kKeyZoom);
  case Qt::Key_Home:
    return fill();
  default:
    break;
  }
  VtkView::keyPressEvent(event);
}

} // namespace palp
