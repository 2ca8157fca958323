// What keys do with the block, the size of its words and its tool tips.

#include "app/gui/views/BlockView.h"
#include "app/gui/views/TextScale.h"

#include <QHelpEvent>
#include <QKeyEvent>
#include <QPainter>
#include <QToolTip>

#include <algorithm>
#include <utility>

namespace palp {

namespace {

constexpr double kStep_px = 10; ///< of the cross; with Shift one
constexpr double kArm_px = 9;   ///< of the cross

} // namespace

void BlockView::scaleText() {
  setTextScale(scale_ * textScale(*this));
}

bool BlockView::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    const auto& help = *static_cast<QHelpEvent*>(event);
    if (const QString words = tipAt(help.pos()); !words.isEmpty()) {
      QToolTip::showText(help.globalPos(), words, this);
      return true;
    }
  }
  return VtkView::event(event);
}

void BlockView::changeEvent(QEvent* event) {
  VtkView::changeEvent(event);
  if (event->type() != QEvent::FontChange) return;
  scaleText();
  invalidate();
}

Picture BlockView::renderPicture(int width, int height) {
  setTextScale(scale_ * textScale(*this) * magnification(width, height));
  Picture picture = VtkView::renderPicture(width, height);
  scaleText();
  return picture;
}

void BlockView::keyPressEvent(QKeyEvent* event) {
  const bool fine = event->modifiers().testFlag(Qt::ShiftModifier);
  const bool moves = event->modifiers().testFlag(Qt::ControlModifier);
  const auto move = [&](double x, double y) {
    moveCross(cross_.value_or(QRectF(rect()).center()) + (fine ? 1 : kStep_px) * QPointF(x, y));
  };
  if (moves && event->key() == Qt::Key_Left) return move(-1, 0);
  if (moves && event->key() == Qt::Key_Right) return move(1, 0);
  if (moves && event->key() == Qt::Key_Up) return move(0, -1);
  if (moves && event->key() == Qt::Key_Down) return move(0, 1);
  if (!moves && event->key() == Qt::Key_N) return crossToNextGrip();
  const bool uses = event->key() == Qt::Key_Space || event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
  if (!moves && uses && !event->isAutoRepeat()) return useCross(event->modifiers());
  VtkView::keyPressEvent(event);
}

void BlockView::moveCross(const QPointF& to) {
  cross_ = QPointF(std::clamp(to.x(), 0.0, width() - 1.0), std::clamp(to.y(), 0.0, height() - 1.0));
  if (crossHolds_) dragTo(*cross_, {});
  update();
}

void BlockView::useCross(Qt::KeyboardModifiers modifiers) {
  if (!cross_) moveCross(QRectF(rect()).center());
  if (std::exchange(crossHolds_, false))
    drop();
  else if (grab(*cross_, modifiers))
    crossHolds_ = true;
  else
    emit clicked(*cross_);
  update();
}

std::vector<QPointF> BlockView::grips() const {
  std::vector<QPointF> all;
  if (movable_)
    for (int load = 0; load < loadCount(); ++load)
      if (const auto grip = gripOf(load)) all.push_back(*grip);
  if (const auto knob = cutGrip()) all.push_back(*knob);
  if (height_mm() <= 0) return all;
  for (const PatchLoad& disc : handles()) {
    const Eigen::Vector3d middle(disc.centre_mm.x(), disc.centre_mm.y(), height_mm());
    all.push_back(placeOf(middle));
    all.push_back(placeOf(middle + Eigen::Vector3d(disc.radius_mm, 0, 0)));
  }
  return all;
}

void BlockView::crossToNextGrip() {
  const std::vector<QPointF> all = grips();
  if (all.empty() || crossHolds_) return;
  moveCross(all[nextGrip_++ % all.size()]);
}

void BlockView::paintEvent(QPaintEvent* event) {
  VtkView::paintEvent(event);
  if (!cross_ || !hasFocus()) return;
  QPainter painter(this);
  for (const auto& [color, width] : {std::pair{palette().color(QPalette::Base), 4.0},
                                     std::pair{palette().color(QPalette::WindowText), crossHolds_ ? 2.5 : 1.5}}) {
    painter.setPen(QPen(color, width));
    painter.drawLine(*cross_ - QPointF(kArm_px, 0), *cross_ + QPointF(kArm_px, 0));
    painter.drawLine(*cross_ - QPointF(0, kArm_px), *cross_ + QPointF(0, kArm_px));
    if (crossHolds_) painter.drawEllipse(*cross_, kArm_px, kArm_px);
  }
}

void BlockView::focusOutEvent(QFocusEvent* event) {
  if (std::exchange(crossHolds_, false)) drop();
  VtkView::focusOutEvent(event);
}

} // namespace palp
