#include "app/gui/widgets/FoldingRow.h"

#include <QEvent>

#include <algorithm>

namespace palp {

namespace {

constexpr int kGap_px = 8;

} // namespace

FoldingRow::FoldingRow(QWidget* left, QWidget* right, QWidget* parent) : QWidget(parent), left_(left), right_(right) {
  left_->setParent(this);
  right_->setParent(this);
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  arrange();
}

QSize FoldingRow::minimumSizeHint() const {
  return {std::max(left_->sizeHint().width(), right_->sizeHint().width()), height()};
}

QSize FoldingRow::sizeHint() const {
  return {left_->sizeHint().width() + kGap_px + right_->sizeHint().width(), height()};
}

void FoldingRow::arrange() {
  const QSize left = left_->sizeHint(), right = right_->sizeHint();
  const int line = std::max(left.height(), right.height());
  const bool folded = width() < left.width() + kGap_px + right.width();
  left_->setGeometry(0, 0, left.width(), line);
  right_->setGeometry(folded ? 0 : width() - right.width(), folded ? line : 0, right.width(), line);
  setFixedHeight(folded ? 2 * line : line);
}

void FoldingRow::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  arrange();
}

bool FoldingRow::event(QEvent* event) {
  if (event->type() == QEvent::LayoutRequest || event->type() == QEvent::StyleChange) arrange(); // larger text
  return QWidget::event(event);
}

} // namespace palp
