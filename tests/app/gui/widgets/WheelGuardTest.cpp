#include "app/gui/widgets/WheelGuard.h"

#include "tests/app/gui/WindowFixture.h"

#include <QAbstractSlider>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QScrollArea>
#include <QScrollBar>
#include <QSpinBox>

#include <gtest/gtest.h>

namespace palp {
namespace {

class WheelTest : public WindowFixture {
protected:
  /// What a box shows; empty for other widgets.
  static QString shown(const QWidget* widget) {
    if (qobject_cast<const QScrollBar*>(widget) != nullptr) return {};
    if (auto* spin = qobject_cast<const QAbstractSpinBox*>(widget)) return spin->text();
    if (auto* list = qobject_cast<const QComboBox*>(widget)) return "item " + QString::number(list->currentIndex());
    if (auto* slider = qobject_cast<const QAbstractSlider*>(widget)) return "at " + QString::number(slider->value());
    return {};
  }
};

/// As from the mouse: what a widget does not take goes to the one around it.
void turnOver(QWidget& widget, int angle) {
  const QPointF place = widget.rect().center(), global = widget.mapToGlobal(place);
  for (QWidget* under = &widget; under != nullptr; under = under->parentWidget()) {
    QWheelEvent event(under->mapFromGlobal(global), global, {}, {0, angle}, Qt::NoButton, {}, Qt::NoScrollPhase, false);
    QApplication::sendEvent(under, &event);
    if (event.isAccepted() || under->isWindow()) return;
  }
}

TEST_F(WheelTest, ChangesNoValueThatHasNotTheFocusInAnyPanel) {
  ASSERT_TRUE(solved());
  for (const QString& scene : window.sceneNames()) {
    window.showScene(scene);
    settle();
    window.setFocus();
    int boxes = 0;
    for (QWidget* box : window.currentScene().findChildren<QWidget*>()) {
      const QString before = shown(box);
      if (before.isEmpty() || !box->isVisible() || !box->isEnabled()) continue;
      if (box->objectName() == "increments") continue; // follows the solution by itself
      turnOver(*box, 120);
      turnOver(*box, -240);
      EXPECT_EQ(shown(box), before) << scene.toStdString() << ": " << box->objectName().toStdString();
      EXPECT_NE(box->focusPolicy(), Qt::WheelFocus) << "a turn would give it the focus";
      ++boxes;
    }
    EXPECT_GT(boxes, 0) << scene.toStdString();
  }
}

TEST_F(WheelTest, TurnsTheBoxThatHasTheFocusAndScrollsThePanelOverAllOthers) {
  ASSERT_TRUE(solved());
  window.resize(1300, 420); // too low for the panel
  settle();
  auto& force = find<QDoubleSpinBox>("force_z");
  QScrollArea* panel = nullptr;
  for (QWidget* up = &force; up != nullptr && panel == nullptr; up = up->parentWidget())
    panel = qobject_cast<QScrollArea*>(up);
  ASSERT_NE(panel, nullptr);
  ASSERT_GT(panel->verticalScrollBar()->maximum(), 0);
  const double before = force.value();
  turnOver(force, -120);
  EXPECT_EQ(force.value(), before);
  EXPECT_GT(panel->verticalScrollBar()->value(), 0);
  window.activateWindow();
  force.setFocus();
  ASSERT_TRUE(QTest::qWaitFor([&] { return force.hasFocus(); }, kPatience_ms));
  turnOver(force, -120);
  EXPECT_LT(force.value(), before);
}

TEST_F(WheelTest, ABoxThatComesUnderThePointerWhileThePanelScrollsKeepsItsValue) {
  ASSERT_TRUE(solved());
  window.resize(1300, 420);
  settle();
  auto& force = find<QDoubleSpinBox>("force_z");
  window.activateWindow();
  force.setFocus();
  ASSERT_TRUE(QTest::qWaitFor([&] { return force.hasFocus(); }, kPatience_ms));
  const QPointF place = force.mapToGlobal(QPointF(force.rect().center()));
  const auto turn = [&](QWidget& over) {
    QWheelEvent event(over.mapFromGlobal(place), place, {}, {0, -120}, Qt::NoButton, {}, Qt::NoScrollPhase, false);
    QApplication::sendEvent(&over, &event);
  };
  const double before = force.value();
  turn(*force.parentWidget()); // which stood there before
  turn(force);
  EXPECT_EQ(force.value(), before);
  QTest::mouseClick(&force, Qt::LeftButton); // it is meant now
  turn(force);
  EXPECT_LT(force.value(), before);
}

} // namespace
} // namespace palp
