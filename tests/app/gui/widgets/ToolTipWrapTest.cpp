#include "app/gui/widgets/ToolTipWrap.h"

#include "app/gui/widgets/ElidedLabel.h"

#include <QApplication>
#include <QHelpEvent>
#include <QLabel>
#include <QListWidget>
#include <QTest>
#include <QTextDocument>
#include <QToolTip>

#include <gtest/gtest.h>

namespace palp {
namespace {

TEST(ToolTipWrap, ShowsALongTipInSeveralLinesAndLeavesShortOnes) {
  const QString longTip = QString("words that go on <and> on, ").repeated(12);
  EXPECT_EQ(ToolTipWrap::wrapped("short"), "short");
  EXPECT_EQ(ToolTipWrap::wrapped("<qt>" + longTip + "</qt>"), "<qt>" + longTip + "</qt>") << "means markup";
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

QString shownTip() {
  for (QWidget* top : QApplication::topLevelWidgets())
    if (auto* tip = top->isVisible() && top->inherits("QTipLabel") ? qobject_cast<QLabel*>(top) : nullptr) {
      QTextDocument shown; // as the tip's label draws it
      if (Qt::mightBeRichText(tip->text()))
        shown.setHtml(tip->text());
      else
        shown.setPlainText(tip->text());
      return shown.toPlainText();
    }
  return {};
}

TEST(ToolTipWrap, ShowsNamesThatLookLikeMarkupAsTheyAreWritten) {
  const QString name = "<b>x</b> & <i>y.json";
  QObject parent;
  new ToolTipWrap(&parent);
  QListWidget list;
  auto* row = new QListWidgetItem("row", &list);
  row->setToolTip(name);
  ElidedLabel narrow(name + name);
  narrow.resize(20, 20);
  QLabel plain("here");
  plain.setToolTip(name);
  for (QWidget* widget : std::initializer_list<QWidget*>{&list, &narrow, &plain}) {
    widget->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(widget));
  }
  const auto tipOf = [](QWidget& widget, const QPoint& at) {
    QToolTip::hideText();
    QHelpEvent event(QEvent::ToolTip, at, widget.mapToGlobal(at));
    QApplication::sendEvent(&widget, &event);
    return shownTip();
  };
  EXPECT_EQ(tipOf(*list.viewport(), list.visualItemRect(row).center()), name);
  EXPECT_EQ(tipOf(narrow, {1, 1}), name + name);
  EXPECT_EQ(tipOf(plain, {1, 1}), name);
  QToolTip::hideText();
}

} // namespace
} // namespace palp
