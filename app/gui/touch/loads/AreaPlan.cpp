#include "app/gui/touch/loads/AreaPlan.h"

#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>

#include <algorithm>

namespace palp {

namespace {

constexpr int kHighest_px = 150;
constexpr int kLowest_px = 60;
constexpr double kRim_px = 1;          ///< around the face
constexpr double kLargestGrip_px = 14; ///< of an indenter
constexpr double kSmallestDisc_px = 4; ///< radius, so that a small disc can still be clicked

QString forceWords(const Eigen::Vector3d& force_N) {
  return QString("(%1, %2, %3) N").arg(force_N.x()).arg(force_N.y()).arg(force_N.z());
}

} // namespace

AreaPlan::AreaPlan(QWidget* parent) : QWidget(parent) {
  setObjectName("areaPlan");
  setAccessibleName(tr("Plan of the load areas"));
  setFocusPolicy(Qt::StrongFocus);
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  setMinimumHeight(kLowest_px);
}

void AreaPlan::display(const SensorDesign& design, const LoadCase& load, const LoadPlace& chosen) {
  design_ = design;
  load_ = load;
  chosen_ = chosen;
  fit();
  update();
}

void AreaPlan::fit() {
  const double wanted = (width() - 2 * kRim_px) * design_.block_mm.y() / design_.block_mm.x() + 2 * kRim_px;
  setFixedHeight(static_cast<int>(std::clamp(wanted, double(kLowest_px), double(kHighest_px))));
}

void AreaPlan::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  fit();
}

double AreaPlan::scale() const {
  return std::min((width() - 2 * kRim_px) / design_.block_mm.x(), (height() - 2 * kRim_px) / design_.block_mm.y());
}

QPointF AreaPlan::place(const Eigen::Vector2d& xy_mm) const {
  const Eigen::Vector2d off = scale() * (xy_mm - 0.5 * design_.block_mm.head<2>());
  return {0.5 * width() + off.x(), 0.5 * height() - off.y()}; // y up, as seen from above
}

QRectF AreaPlan::box(const Rectangle& rectangle) const {
  return QRectF(place({rectangle.low_mm.x(), rectangle.high_mm.y()}),
                place({rectangle.high_mm.x(), rectangle.low_mm.y()}));
}

QPoint AreaPlan::placeOf(const LoadPlace& load) const {
  const auto k = static_cast<std::size_t>(load.number);
  if (load.kind == LoadKind::Disc) return place(load_.patches[k].centre_mm).toPoint();
  if (load.kind == LoadKind::Indenter) return place(load_.indenters[k].place_mm).toPoint();
  return box(design_.areaRectangle(load.number)).center().toPoint();
}

const AreaLoad* AreaPlan::loadOn(int area) const {
  const auto its =
      std::find_if(load_.areas.begin(), load_.areas.end(), [&](const AreaLoad& l) { return l.area == area; });
  return its == load_.areas.end() ? nullptr : &*its;
}

QPainterPath AreaPlan::outline(const Indenter& indenter) const {
  QPainterPath path;
  const QRectF face = box({Eigen::Vector2d::Zero(), design_.block_mm.head<2>()});
  const QPointF middle = place(indenter.place_mm);
  const double radius = std::max(kSmallestDisc_px, scale() * indenter.radius_mm);
  switch (indenter.shape) {
  case IndenterShape::Sphere:
  case IndenterShape::Pin:
  case IndenterShape::Flat:
    path.addEllipse(middle, radius, radius);
    break;
  case IndenterShape::CylinderX:
    path.addRect(QRectF(face.left(), middle.y() - radius, face.width(), 2 * radius));
    break;
  case IndenterShape::CylinderY:
    path.addRect(QRectF(middle.x() - radius, face.top(), 2 * radius, face.height()));
    break;
  case IndenterShape::Plane:
    path.addRect(face.adjusted(3, 3, -3, -3));
    break;
  }
  return path;
}

std::optional<LoadPlace> AreaPlan::at(const QPointF& where) const {
  for (std::size_t k = load_.indenters.size(); k-- > 0;) {
    // A body that covers much of the face is selected at its middle: areas and discs around it stay selectable.
    const QPointF way = where - place(load_.indenters[k].place_mm);
    const double reach = std::clamp(scale() * load_.indenters[k].radius_mm, kSmallestDisc_px, kLargestGrip_px);
    if (std::hypot(way.x(), way.y()) <= reach) return LoadPlace{LoadKind::Indenter, static_cast<int>(k)};
  }
  for (std::size_t k = load_.patches.size(); k-- > 0;) {
    const QPointF way = where - place(load_.patches[k].centre_mm);
    if (std::hypot(way.x(), way.y()) <= std::max(kSmallestDisc_px, scale() * load_.patches[k].radius_mm))
      return LoadPlace{LoadKind::Disc, static_cast<int>(k)};
  }
  for (int area = 0; area < design_.areas.count(); ++area)
    if (box(design_.areaRectangle(area)).contains(where)) return LoadPlace{LoadKind::Area, area};
  return {};
}

void AreaPlan::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QPalette& colors = palette();
  const QColor loaded = colors.color(QPalette::Highlight);
  for (int area = 0; area < design_.areas.count(); ++area) {
    const QRectF cell = box(design_.areaRectangle(area));
    const bool bears = loadOn(area) != nullptr, now = chosen_ == LoadPlace{LoadKind::Area, area};
    painter.setPen(QPen(colors.color(QPalette::Mid), 1));
    painter.setBrush(bears ? loaded : colors.color(QPalette::Button));
    painter.drawRect(cell);
    if (now) {
      painter.setPen(QPen(colors.color(QPalette::WindowText), 2, hasFocus() ? Qt::DotLine : Qt::SolidLine));
      painter.setBrush(Qt::NoBrush);
      painter.drawRect(cell.adjusted(1.5, 1.5, -1.5, -1.5));
    }
    const QString words = QString::number(area);
    if (cell.width() < painter.fontMetrics().horizontalAdvance(words) + 4 || cell.height() < 14) continue;
    painter.setPen(colors.color(bears ? QPalette::HighlightedText : QPalette::ButtonText));
    painter.drawText(cell, Qt::AlignCenter, words);
  }
  for (std::size_t k = 0; k < load_.patches.size(); ++k) {
    const double radius = std::max(kSmallestDisc_px, scale() * load_.patches[k].radius_mm);
    const bool now = chosen_ == LoadPlace{LoadKind::Disc, static_cast<int>(k)};
    QColor ground = colors.color(QPalette::Base);
    ground.setAlpha(190);
    painter.setBrush(ground);
    painter.setPen(QPen(loaded, now ? 3 : 1.5));
    painter.drawEllipse(place(load_.patches[k].centre_mm), radius, radius);
  }
  painter.setClipRect(box({Eigen::Vector2d::Zero(), design_.block_mm.head<2>()}).adjusted(-1, -1, 1, 1));
  for (std::size_t k = 0; k < load_.indenters.size(); ++k) {
    const bool now = chosen_ == LoadPlace{LoadKind::Indenter, static_cast<int>(k)};
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(colors.color(QPalette::WindowText), now ? 3 : 1.5));
    painter.drawPath(outline(load_.indenters[k]));
    const QPointF middle = place(load_.indenters[k].place_mm);
    painter.drawLine(middle - QPointF(3, 0), middle + QPointF(3, 0));
    painter.drawLine(middle - QPointF(0, 3), middle + QPointF(0, 3));
  }
}

void AreaPlan::mousePressEvent(QMouseEvent* event) {
  const auto load = at(event->position());
  if (!load || event->button() != Qt::LeftButton) return;
  if (event->modifiers().testFlag(Qt::ShiftModifier))
    emit removed(*load);
  else
    emit chosen(*load);
}

void AreaPlan::keyPressEvent(QKeyEvent* event) {
  const LoadAreas& areas = design_.areas;
  const bool onArea = chosen_.kind == LoadKind::Area;
  const int column = !onArea ? 0 : chosen_.number % areas.columns;
  const int row = !onArea ? 0 : chosen_.number / areas.columns;
  const auto walk = [&](int dx, int dy) {
    chosen_ = {LoadKind::Area,
               std::clamp(row + dy, 0, areas.rows - 1) * areas.columns + std::clamp(column + dx, 0, areas.columns - 1)};
    update();
  };
  switch (event->key()) {
  case Qt::Key_Left:
    return walk(-1, 0);
  case Qt::Key_Right:
    return walk(1, 0);
  case Qt::Key_Up:
    return walk(0, 1);
  case Qt::Key_Down:
    return walk(0, -1);
  case Qt::Key_Space:
  case Qt::Key_Return:
    emit chosen(chosen_);
    return;
  case Qt::Key_Delete:
  case Qt::Key_Backspace:
    emit removed(chosen_);
    return;
  default:
    QWidget::keyPressEvent(event);
  }
}

bool AreaPlan::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  const auto& help = static_cast<const QHelpEvent&>(*event);
  const auto load = at(help.pos());
  QString words;
  if (load && load->kind == LoadKind::Indenter) {
    const Indenter& its = load_.indenters[static_cast<std::size_t>(load->number)];
    words = tr("indenter %1: %2").arg(load->number).arg(QString::fromStdString(shapeName(its.shape)));
  } else if (load && load->kind == LoadKind::Disc) {
    const PatchLoad& disc = load_.patches[static_cast<std::size_t>(load->number)];
    words = tr("disc %1: %2").arg(load->number).arg(forceWords(disc.force_N));
  } else if (load) {
    const AreaLoad* its = loadOn(load->number);
    words = tr("area %1: %2").arg(load->number).arg(its != nullptr ? forceWords(its->force_N) : tr("no load"));
  }
  QToolTip::showText(help.globalPos(), words, this);
  return true;
}

} // namespace palp
