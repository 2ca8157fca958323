#include "app/gui/widgets/ToolTipWrap.h"

#include "app/gui/widgets/Markup.h"

#include <QAbstractItemView>
#include <QApplication>
#include <QHelpEvent>
#include <QTextDocument>
#include <QToolTip>
#include <QWidget>

namespace palp {

namespace {

constexpr qsizetype kLongestLine = 70; // letters

/// Of the row there, in a list; else the widget's own.
QString tipAt(const QWidget& widget, const QPoint& place) {
  const auto* view = qobject_cast<const QAbstractItemView*>(widget.parentWidget());
  const bool list = view != nullptr && view->viewport() == &widget;
  const QString ofRow = list ? view->indexAt(place).data(Qt::ToolTipRole).toString() : QString();
  return ofRow.isEmpty() ? widget.toolTip() : ofRow;
}

} // namespace

ToolTipWrap::ToolTipWrap(QObject* parent) : QObject(parent) {
  qApp->installEventFilter(this);
}

QString ToolTipWrap::wrapped(const QString& tip) {
  if (tip.startsWith("<qt>") || (tip.size() <= kLongestLine && !Qt::mightBeRichText(tip))) return tip;
  return "<p>" + asWritten(tip) + "</p>"; // Qt wraps what is markup
}

bool ToolTipWrap::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::ToolTip || !watched->isWidgetType()) return false;
  auto& widget = static_cast<QWidget&>(*watched);
  const auto& help = static_cast<const QHelpEvent&>(*event);
  const QString given = tipAt(widget, help.pos()), tip = wrapped(given);
  if (tip == given) return false; // also where parts of it have tips of their own
  QToolTip::showText(help.globalPos(), tip, &widget, {}, widget.toolTipDuration());
  return true;
}

} // namespace palp
