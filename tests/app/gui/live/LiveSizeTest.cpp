#include "app/gui/live/LiveBoards.h"
#include "app/gui/widgets/ElidedLabel.h"
#include "app/gui/window/SidePanel.h"
#include "tests/app/gui/WindowFixture.h"

#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QTabWidget>

#include <gtest/gtest.h>

namespace palp {
namespace {

/// What is left of a screen for the window: without frame and title.
struct Room {
  const char* name;
  QSize size;
};
void PrintTo(const Room& room, std::ostream* out) {
  *out << room.name;
}

std::string roomName(const testing::TestParamInfo<Room>& info) {
  return info.param.name;
}

class LiveSize : public WindowFixture, public testing::WithParamInterface<Room> {
protected:
  bool fits() {
    const auto* bar = find<QScrollArea>("sceneRoom").horizontalScrollBar();
    window.resize(GetParam().size);
    settle();
    return QTest::qWaitFor([&] { return window.size() == GetParam().size && !bar->isVisible(); }, kPatience_ms / 6);
  }
};

TEST_P(LiveSize, ABoardIsNoWiderThanTheWindowWithItsPanelAndEveryTab) {
  window.showScene("live");
  auto& page = find<LiveBoards>("live").page();
  EXPECT_TRUE(fits()) << page.minimumSizeHint().width();
  for (const char* tabs : {"curveTabs", "blockTabs"}) {
    page.findChild<QTabWidget*>(tabs)->setCurrentIndex(1);
    EXPECT_TRUE(fits()) << tabs << " " << page.minimumSizeHint().width();
  }
}

INSTANTIATE_TEST_SUITE_P(, LiveSize,
                         testing::Values(Room{"At1280By800", {1272, 764}},
                                         Room{"At1366By768With125Percent", {1085, 585}}),
                         roomName);

class LiveRecordButton : public WindowFixture {
protected:
  /// All of it can be clicked, without scrolling.
  bool seen(const QSize& size) {
    window.resize(size);
    window.showScene("live");
    settle();
    const auto& record = find<QPushButton>("record");
    return QTest::qWaitFor([&] { return record.visibleRegion().boundingRect() == record.rect(); }, kPatience_ms / 6);
  }
};

TEST_F(LiveRecordButton, TheCalibrationScrollsDownAtMost) {
  window.resize({1272, 764});
  window.showScene("live");
  settle();
  auto& tabs = *find<LiveBoards>("live").page().findChild<QTabWidget*>("curveTabs");
  tabs.setCurrentIndex(1);
  const auto* room = qobject_cast<QScrollArea*>(tabs.currentWidget());
  ASSERT_NE(room, nullptr);
  EXPECT_TRUE(QTest::qWaitFor([&] { return room->isVisible() && room->horizontalScrollBar()->maximum() == 0; },
                              kPatience_ms / 6))
      << room->widget()->minimumSizeHint().width() << " in " << room->viewport()->width();
}

TEST_F(LiveRecordButton, StandsOnTopAndIsNeverBelowTheFold) {
  EXPECT_TRUE(seen({1500, 900}));
  EXPECT_TRUE(seen({1272, 764}));
  const int top = find<QPushButton>("record").mapTo(&window, QPoint()).y();
  EXPECT_LT(top, find<QPushButton>("chooseNetwork").mapTo(&window, QPoint()).y());
  EXPECT_LT(top, find<QPushButton>("plug").mapTo(&window, QPoint()).y()) << "of the simulated board";
}

using LiveSizeOfTwo = WindowFixture;

TEST_F(LiveSizeOfTwo, TwoBoardsFitBesideEachOtherAt1280By800) {
  window.resize(1272, 764);
  window.showScene("live");
  auto& live = find<LiveBoards>("live");
  ASSERT_TRUE(QTest::qWaitFor([&] { return live.page().host().status().counts.frames > 3; }, kPatience_ms));
  QTest::mouseClick(live.page().findChild<QPushButton*>("anotherBoard"), Qt::LeftButton);
  ASSERT_EQ(live.count(), 2U);
  const auto* bar = find<QScrollArea>("sceneRoom").horizontalScrollBar();
  settle();
  EXPECT_TRUE(QTest::qWaitFor([&] { return !bar->isVisible(); }, kPatience_ms / 6)) << live.minimumSizeHint().width();
  const auto* down = find<QScrollArea>("sceneRoom").verticalScrollBar();
  EXPECT_TRUE(QTest::qWaitFor([&] { return !down->isVisible(); }, kPatience_ms / 6)) << "all views are seen at once";
  auto& tabs = *live.page().findChild<QTabWidget*>("blockTabs");
  const auto heatmapTab = [&] { return tabs.indexOf(live.page().findChild<QWidget*>("liveHeatmap")); };
  EXPECT_TRUE(QTest::qWaitFor([&] { return heatmapTab() == 2; }, kPatience_ms / 6)) << "low and narrow: a tab";

  // The panel of one gets the room beside its views, and leaves those of the other in sight.
  const auto* block = live.page(0).findChild<QWidget*>("liveBlock");
  QTest::mouseClick(live.page(0).parentWidget()->findChild<QPushButton*>("boardPanel"), Qt::LeftButton);
  EXPECT_TRUE(QTest::qWaitFor([&] { return live.page(0).width() > live.page(1).width(); }, kPatience_ms));
  settle();
  EXPECT_TRUE(block->isVisible());
  EXPECT_FALSE(bar->isVisible()) << live.minimumSizeHint().width();
  EXPECT_TRUE(live.page(0).findChild<QPushButton*>("record")->isVisible());
  EXPECT_TRUE(live.page(1).findChild<QWidget*>("liveBlock")->isVisible());
  QTest::mouseClick(live.page(0).parentWidget()->findChild<QPushButton*>("boardPanel"), Qt::LeftButton);
  EXPECT_TRUE(
      QTest::qWaitFor([&] { return std::abs(live.page(0).width() - live.page(1).width()) < 10; }, kPatience_ms));

  // With room for it the heatmap stands beside the forces again.
  QTest::mouseClick(live.page(1).parentWidget()->findChild<QPushButton*>("takeBoardAway"), Qt::LeftButton);
  ASSERT_EQ(live.count(), 1U);
  EXPECT_TRUE(QTest::qWaitFor([&] { return tabs.count() == 2; }, kPatience_ms));
  EXPECT_TRUE(
      QTest::qWaitFor([&] { return live.page().findChild<QWidget*>("liveHeatmap")->isVisible(); }, kPatience_ms));
}

TEST(ElidedLabel, EndsInDotsWhereItIsTooNarrowAndKeepsItsWords) {
  ElidedLabel label("noise 5e-06, drift 1200 ppm");
  label.resize(label.sizeHint());
  EXPECT_EQ(label.shownWords(), label.text());
  label.resize(label.sizeHint().width() / 2, label.height());
  EXPECT_TRUE(label.shownWords().endsWith(QChar(0x2026))) << label.shownWords().toStdString();
  EXPECT_EQ(label.text(), "noise 5e-06, drift 1200 ppm");
}

} // namespace
} // namespace palp
