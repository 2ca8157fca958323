#include "app/gui/widgets/ElidedLabel.h"

#include "app/gui/widgets/ToolTipWrap.h"

#include <QHelpEvent>
#include <QPainter>
#include <QStyle>
#include <QToolTip>

namespace palp {

namespace {

constexpr int kLeastLabel_px = 10; // it widens no window

} // namespace

ElidedLabel::ElidedLabel(const QString& words, QWidget* parent) : QLabel(words, parent) {
  setTextFormat(Qt::PlainText);
  setMinimumWidth(kLeastLabel_px);
  setProperty("mayBeCut", true);
}

QString ElidedLabel::shownWords() const {
  return fontMetrics().elidedText(text(), Qt::ElideRight, contentsRect().width());
}

void ElidedLabel::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  style()->drawItemText(&painter, contentsRect(), Qt::AlignLeft | Qt::AlignVCenter, palette(), isEnabled(),
                        shownWords(), foregroundRole());
}

bool ElidedLabel::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip || shownWords() == text()) return QLabel::event(event);
  QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(), ToolTipWrap::wrapped(text()), this);
  return true;
}

} // namespace palp
