#include "app/gui/live/LiveBoards.h"
#include "tests/app/gui/WindowFixture.h"

#include <QDoubleSpinBox>
#include <QMessageBox>
#include <QPushButton>
#include <QSignalSpy>
#include <QStatusBar>
#include <QTemporaryDir>
#include <QToolButton>

#include <gtest/gtest.h>

namespace palp {
namespace {

class StatusLampsTest : public WindowFixture {
protected:
  template <class Condition> static bool wait(const Condition& condition) {
    return QTest::qWaitFor(condition, kPatience_ms);
  }
  LivePage& page() { return find<LiveBoards>("live").page(); }
  bool records(const QString& file) {
    window.showScene("live");
    if (!wait([&] { return page().host().status().state == LiveState::Streaming; })) return false;
    page().findChild<QLineEdit*>("recordFile")->setText(file);
    QTest::mouseClick(page().findChild<QPushButton*>("record"), Qt::LeftButton);
    return wait([&] { return page().host().status().recording; });
  }
  QTemporaryDir folder;
};

TEST_F(StatusLampsTest, ARecordingIsToldInEverySceneLeadsThereAndOutlivesEsc) {
  ASSERT_TRUE(records(folder.filePath("touch.palprec")));
  window.showScene("design");
  auto& lamp = find<QToolButton>("liveLamp");
  ASSERT_TRUE(wait([&] { return lamp.isVisible() && lamp.text().contains("Recording touch.palprec, 0:"); }))
      << lamp.text().toStdString();
  EXPECT_EQ(lamp.property("role"), "records");
  const QString before = lamp.text();
  EXPECT_TRUE(wait([&] { return lamp.text() != before; })) << "its time stands still";
  QTest::keyClick(&window, Qt::Key_Escape);
  const std::uint64_t reports = page().host().status().recordedReports;
  EXPECT_TRUE(wait([&] { return page().host().status().recordedReports > reports + 100; }));
  QTest::mouseClick(&lamp, Qt::LeftButton);
  EXPECT_EQ(window.currentScene().objectName(), "live");
}

TEST_F(StatusLampsTest, ToldIsWhatABoardDoesAndThatLiveWaitsWhereNobodyLooks) {
  window.showScene("live");
  auto& live = find<LiveBoards>("live");
  ASSERT_TRUE(wait([&] { return live.page().host().status().state == LiveState::Streaming; }));
  auto& lamp = find<QToolButton>("liveLamp");
  EXPECT_TRUE(wait([&] { return lamp.isVisible() && lamp.text().contains("simulated board"); }));
  QTest::mouseClick(live.page().findChild<QPushButton*>("plug"), Qt::LeftButton);
  EXPECT_TRUE(wait([&] { return lamp.text().contains("is unplugged"); })) << lamp.text().toStdString();
  EXPECT_TRUE(lamp.isVisible()) << "where one looks for it";
  EXPECT_EQ(lamp.property("role"), "alarm");
  QTest::mouseClick(live.page().findChild<QPushButton*>("plug"), Qt::LeftButton);
  EXPECT_TRUE(wait([&] { return lamp.property("role") == "streams"; }));
  window.showScene("reports");
  EXPECT_TRUE(wait([&] { return lamp.text().contains("Live is waiting"); })) << lamp.text().toStdString();
  EXPECT_TRUE(lamp.isVisible() && lamp.toolTip().contains("Nothing is read while this scene is hidden"));
  EXPECT_EQ(lamp.property("role"), "streams") << "nothing is wrong";
}

TEST_F(StatusLampsTest, QuittingAsksOnceBeforeItEndsARecording) {
  ASSERT_TRUE(records(folder.filePath("touch.palprec")));
  Project next = workbench.project();
  next.design.block_mm.x() = 31;
  workbench.edit("block", next); // not saved
  QStringList asked;
  QMessageBox::StandardButton button = QMessageBox::Cancel;
  QTimer answers;
  QObject::connect(&answers, &QTimer::timeout, &answers, [&] {
    auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (box == nullptr || box->button(button) == nullptr) return;
    asked << box->text();
    QTest::mouseClick(box->button(button), Qt::LeftButton);
  });
  answers.start(20);
  window.close();
  EXPECT_TRUE(window.isVisible());
  EXPECT_TRUE(page().host().status().recording);
  ASSERT_EQ(asked.size(), 1);
  EXPECT_TRUE(asked[0].contains("not saved")) << asked[0].toStdString();
  EXPECT_TRUE(asked[0].contains("touch.palprec is in progress")) << asked[0].toStdString();
  button = QMessageBox::Discard;
  window.close();
  EXPECT_FALSE(window.isVisible());
  EXPECT_EQ(asked.size(), 2);
}

TEST_F(StatusLampsTest, AJobLeadsToItsScene) {
  ASSERT_TRUE(solved());
  Project heavy = workbench.project();
  heavy.mesh = {1.2, {}}; // solved for so long that the strip is seen
  workbench.edit("finer", heavy);
  window.showScene("deformation");
  window.showScene("reports");
  const auto words = [&]() -> QToolButton* {
    for (auto* button : window.statusBar()->findChildren<QToolButton*>("jobWords"))
      if (button->isVisible()) return button;
    return nullptr;
  };
  ASSERT_TRUE(wait([&] { return words() != nullptr; }));
  QTest::mouseClick(words(), Qt::LeftButton);
  EXPECT_EQ(window.currentScene().objectName(), "deformation");
  QTest::keyClick(&window, Qt::Key_Escape);
  EXPECT_TRUE(idle());
}

} // namespace
} // namespace palp
