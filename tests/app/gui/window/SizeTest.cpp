#include "app/gui/window/Layout.h"
#include "app/gui/window/SidePanel.h"
#include "app/gui/window/Style.h"
#include "tests/app/gui/WindowFixture.h"

#include <QAbstractButton>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QAccessible>
#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QListWidget>
#include <QSettings>
#include <QSplitter>

#include <gtest/gtest.h>

namespace palp {
namespace {

constexpr int kSettled_ms = 5000; ///< for layouts that follow texts which come later

/// What the window shows cut: labels, buttons and boxes that are narrower or lower than their text.
QStringList cutTexts(const QWidget& root) {
  QStringList cut;
  const auto note = [&](const QWidget& widget, const QString& text) {
    cut << QString("%1 '%2' at %3 x %4")
               .arg(widget.objectName(), text.left(40))
               .arg(widget.width())
               .arg(widget.height());
  };
  for (const auto* label : root.findChildren<QLabel*>()) {
    if (!label->isVisible() || label->text().isEmpty() || !label->property("mayBeCut").isNull()) continue;
    const bool low = label->wordWrap() ? label->heightForWidth(label->width()) > label->height()
                                       : label->sizeHint().width() > label->width();
    if (low) note(*label, label->text());
  }
  for (const auto* button : root.findChildren<QAbstractButton*>())
    if (button->isVisible() && !button->text().isEmpty() &&
        button->fontMetrics().horizontalAdvance(QString(button->text()).remove('&')) > button->width() - 6)
      note(*button, button->text());
  for (const auto* box : root.findChildren<QComboBox*>())
    if (box->isVisible() && box->fontMetrics().horizontalAdvance(box->currentText()) > box->width() - 24)
      note(*box, box->currentText());
  return cut;
}

class WindowSize : public WindowFixture {
protected:
  ~WindowSize() override { QSettings().clear(); }
  /// Every scene keeps the size that is left of such a screen, and cuts no text in it.
  void expectRoom(QSize screen) {
    const QSize asked = screen - QSize(8, 36); // frame and title
    for (const QString& name : window.sceneNames()) {
      window.showScene(name);
      window.resize(asked);
      QStringList cut;
      const bool whole = QTest::qWaitFor([&] { return (cut = cutTexts(window)).isEmpty(); }, kSettled_ms);
      EXPECT_EQ(window.size(), asked) << name.toStdString() << " needs " << window.minimumSizeHint().width() << " x "
                                      << window.minimumSizeHint().height();
      EXPECT_TRUE(whole) << name.toStdString() << ": " << cut.join("; ").toStdString();
    }
  }
};

TEST_F(WindowSize, IsNoLargerThanTheScreenThatItOpensOn) {
  window.setGeometry(300, 400, 1500, 900);
  fitToScreen(window, QRect(0, 0, 1280, 800));
  EXPECT_TRUE(QRect(0, 0, 1280, 800).contains(window.geometry()));
  EXPECT_GE(window.geometry().top(), 20) << "its title would be above the screen";
  window.setGeometry(2000, 100, 900, 500); // from a screen that is not there any more
  fitToScreen(window, QRect(0, 0, 1280, 800));
  EXPECT_TRUE(QRect(0, 0, 1280, 800).contains(window.geometry()));
  EXPECT_EQ(window.size(), QSize(900, 500)) << "a window that fits keeps its size";
}

TEST_F(WindowSize, CutsNoTextAt1280By800) {
  ASSERT_TRUE(solved());
  expectRoom({1280, 800});
}

TEST_F(WindowSize, CutsNoTextUnderTheFieldEither) {
  Project field = workbench.project();
  field.design.resistance = FieldLaw{.electrodeRadius_mm = 0.4, .readout = Readout::OthersAtHalf}; // with its warning
  workbench.edit("field", field);
  ASSERT_TRUE(solved());
  expectRoom({1280, 800});
  for (int k = 0; k < 3; ++k) QTest::keyClick(&window, Qt::Key_Plus, Qt::ControlModifier);
  expectRoom({1280, 800});
}

TEST_F(WindowSize, CutsNoTextAt1366By768With125Percent) {
  ASSERT_TRUE(solved());
  expectRoom({1092, 614});
}

TEST_F(WindowSize, CutsNoTextAt1280By800With150Percent) {
  ASSERT_TRUE(solved());
  expectRoom({853, 533});
}

TEST_F(WindowSize, CutsNoTextThatWasMadeLarger) {
  ASSERT_TRUE(solved());
  for (int k = 0; k < 3; ++k) QTest::keyClick(&window, Qt::Key_Plus, Qt::ControlModifier);
  EXPECT_EQ(textPercent(), 130);
  expectRoom({1280, 800});
}

TEST_F(WindowSize, PanelsFoldAwayByTheirStripAndByKeyAndStayFolded) {
  window.showScene("network");
  auto& panel = *window.currentScene().findChild<SidePanel*>();
  auto& chart = *window.currentScene().findChild<QWidget*>("networkTabs");
  ASSERT_TRUE(QTest::qWaitFor([&] { return panel.width() > 300; }, kPatience_ms));
  settle();
  QTest::mouseClick(panel.findChild<QAbstractButton*>("foldPanel"), Qt::LeftButton);
  EXPECT_TRUE(QTest::qWaitFor([&] { return panel.width() < 20 && chart.width() > 1000; }, kPatience_ms));
  saveLayout(window);
  MainWindow second(workbench, network);
  second.showScene("network");
  EXPECT_TRUE(second.currentScene().findChild<SidePanel*>()->folded());
  QTest::keyClick(&window, Qt::Key_F9);
  EXPECT_FALSE(panel.folded());
  EXPECT_TRUE(QTest::qWaitFor([&] { return panel.width() > 300 && chart.width() < 900; }, kPatience_ms));
}

TEST_F(WindowSize, PanelsThatHadNoRoomBesideAnotherBoardAreThereAtTheNextStart) {
  window.showScene("live");
  ASSERT_TRUE(QTest::qWaitFor([&] { return find<QAbstractButton>("anotherBoard").isEnabled(); }, kPatience_ms));
  QTest::mouseClick(&find<QAbstractButton>("anotherBoard"), Qt::LeftButton);
  const auto panels = window.currentScene().findChildren<SidePanel*>();
  ASSERT_EQ(panels.size(), 2);
  EXPECT_TRUE(panels[0]->folded()) << "two boards in 1300";
  saveLayout(window);
  Workbench fresh{quickProject()};
  NetworkSession none;
  MainWindow second(fresh, none);
  second.showScene("live");
  EXPECT_FALSE(second.currentScene().findChild<SidePanel*>()->folded());
}

TEST_F(WindowSize, TextGrowsAndShrinksByKeysAndStaysSo) {
  auto& rail = find<QListWidget>("rail");
  const int width = rail.width();
  const double size = QFontInfo(window.font()).pointSizeF();
  for (int k = 0; k < 5; ++k) QTest::keyClick(&window, Qt::Key_Plus, Qt::ControlModifier);
  EXPECT_NEAR(QFontInfo(window.font()).pointSizeF(), 1.5 * size, 0.5);
  settle();
  EXPECT_GT(rail.width(), width);
  MainWindow second(workbench, network); // reads the settings
  EXPECT_NEAR(QFontInfo(second.font()).pointSizeF(), 1.5 * size, 0.5);
  QTest::keyClick(&window, Qt::Key_Minus, Qt::ControlModifier);
  EXPECT_EQ(textPercent(), 140);
  QTest::keyClick(&window, Qt::Key_0, Qt::ControlModifier);
  EXPECT_NEAR(QFontInfo(window.font()).pointSizeF(), size, 0.1);
}

TEST_F(WindowSize, FillsTheScreenAndComesBack) {
  QTest::keyClick(&window, Qt::Key_F11);
  EXPECT_TRUE(QTest::qWaitFor([&] { return window.isFullScreen(); }, kPatience_ms));
  QTest::keyClick(&window, Qt::Key_F11);
  EXPECT_TRUE(QTest::qWaitFor([&] { return !window.isFullScreen(); }, kPatience_ms));
}

TEST_F(WindowSize, HighContrastIsBlackAndWhiteAndKept) {
  QTest::keyClick(&window, Qt::Key_T, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(window.theme(), Theme::Contrast);
  EXPECT_EQ(window.palette().color(QPalette::Window), QColor(Qt::black));
  EXPECT_EQ(window.palette().color(QPalette::WindowText), QColor(Qt::white));
  const MainWindow second(workbench, network);
  EXPECT_EQ(second.theme(), Theme::Contrast);
  QTest::keyClick(&window, Qt::Key_T, Qt::ControlModifier);
  EXPECT_EQ(window.theme(), Theme::Dark);
  QTest::keyClick(&window, Qt::Key_T, Qt::ControlModifier);
  EXPECT_EQ(window.theme(), Theme::Light);
}

TEST_F(WindowSize, SplittersAreSeen) {
  window.showScene("network");
  settle();
  const auto& splitter = find<QSplitter>("networkSweep");
  const QWidget* handle = splitter.handle(1);
  const QImage picture = window.grab(QRect(handle->mapTo(&window, QPoint(0, 0)), handle->size())).toImage();
  const QColor ground = window.palette().color(QPalette::Window);
  const QColor middle = picture.pixelColor(picture.width() / 2, picture.height() / 2);
  EXPECT_GT(std::abs(middle.lightness() - ground.lightness()), 30);
}

TEST_F(WindowSize, HighContrastOutlinesABoxThatIsNotChecked) {
  window.showScene("network");
  QTest::keyClick(&window, Qt::Key_T, Qt::ControlModifier | Qt::ShiftModifier);
  settle();
  const QImage box = find<QCheckBox>("automaticSpread").grab().toImage().copy(0, 0, 16, 24);
  int white = 0;
  for (int y = 0; y < box.height(); ++y)
    for (int x = 0; x < box.width(); ++x) white += box.pixelColor(x, y).lightness() > 200 ? 1 : 0;
  EXPECT_GT(white, 30);
}

TEST_F(WindowSize, EveryControlHasANameForScreenReaders) {
  QStringList nameless;
  for (const auto* widget : window.findChildren<QWidget*>()) {
    if (widget->focusPolicy() == Qt::NoFocus || widget->objectName().startsWith("qt_")) continue;
    const bool control = qobject_cast<const QAbstractButton*>(widget) != nullptr ||
                         qobject_cast<const QAbstractSpinBox*>(widget) != nullptr ||
                         qobject_cast<const QComboBox*>(widget) != nullptr ||
                         qobject_cast<const QAbstractSlider*>(widget) != nullptr;
    const QAccessibleInterface* seen = QAccessible::queryAccessibleInterface(const_cast<QWidget*>(widget));
    if (control && (seen == nullptr || seen->text(QAccessible::Name).isEmpty()))
      nameless << QString(widget->metaObject()->className()) + " " + widget->objectName();
  }
  EXPECT_TRUE(nameless.isEmpty()) << nameless.join("; ").toStdString();
}

} // namespace
} // namespace palp
