#include "app/gui/widgets/ToolTipWrap.h"

#include <QApplication>
#include <QHelpEvent>
#include <QTextDocument>
#include <QToolTip>
#include <QWidget>

namespace palp {

namespace {

constexpr qsizetype kLongestLine = 70; // letters

} // namespace

ToolTipWrap::ToolTipWrap(QObject* parent) : QObject(parent) {
  qApp->installEventFilter(this);
}

QString ToolTipWrap::wrapped(const QString& tip) {
  if (tip.size() <= kLongestLine || Qt::mightBeRichText(tip)) return tip;
  return "<p>" + tip.toHtmlEscaped().replace('\n', "<br>") + "</p>"; // Qt wraps what is rich text
}

bool ToolTipWrap::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::ToolTip || !watched->isWidgetType()) return false;
  auto& widget = static_cast<QWidget&>(*watched);
  const QString tip = wrapped(widget.toolTip());
  if (tip == widget.toolTip()) return false; // also where parts of it have tips of their own
  QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(), tip, &widget, {}, widget.toolTipDuration());
  return true;
}

} // namespace palp
