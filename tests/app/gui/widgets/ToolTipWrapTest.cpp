#include "app/gui/widgets/ToolTipWrap.h"

#include <QApplication>
#include <QHelpEvent>
#include <QLabel>
#include <QTest>
#include <QToolTip>

#include <gtest/gtest.h>

namespace palp {
namespace {

TEST(ToolTipWrap, ShowsALongTipInSeveralLinesAndLeavesShortOnes) {
  const QString longTip = QString("words that go on <and> on, ").repeated(12);
  EXPECT_EQ(ToolTipWrap::wrapped("short"), "short");
  EXPECT_EQ(ToolTipWrap::wrapped("<p>" + longTip + "</p>"), "<p>" + longTip + "</p>");
  QObject parent;
  new ToolTipWrap(&parent);
  QLabel widget("here");
  widget.setToolTip(longTip);
  widget.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&widget));
  QHelpEvent event(QEvent::ToolTip, {1, 1}, widget.mapToGlobal(QPoint(1, 1)));
  QApplication::sendEvent(&widget, &event);
  const QWidget* tip = nullptr;
  for (const QWidget* top : QApplication::topLevelWidgets())
    if (top->inherits("QTipLabel") && top->isVisible()) tip = top;
  ASSERT_NE(tip, nullptr);
  EXPECT_LT(tip->width(), 0.6 * tip->fontMetrics().horizontalAdvance(longTip));
  EXPECT_GT(tip->height(), 2 * tip->fontMetrics().lineSpacing());
  EXPECT_EQ(widget.toolTip(), longTip) << "what is read aloud stays as it is";
  QToolTip::hideText();
}

} // namespace
} // namespace palp
