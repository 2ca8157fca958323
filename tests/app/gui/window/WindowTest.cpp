#include "app/gui/live/LiveBoards.h"
#include "app/gui/live/LiveModelView.h"
#include "app/gui/views/BlockView.h"
#include "app/study/Resources.h"
#include "tests/app/gui/WindowFixture.h"

#include <QDialog>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSplitter>
#include <QStatusBar>
#include <QTabWidget>
#include <QTextBrowser>

namespace palp {
namespace {

class Window : public WindowFixture {};

TEST_F(Window, OpensOnTheDeformationSceneAndSolvesByItself) {
  EXPECT_EQ(window.currentScene().objectName(), "deformation");
  ASSERT_TRUE(solved());
  EXPECT_TRUE(workbench.touch().touch().solution()->converged);
  EXPECT_GT(find<BlockView>("block").deformationScale(), 1);
}

TEST_F(Window, GoesThroughAllScenesAndSolvesOnce) {
  ASSERT_TRUE(solved());
  for (int round = 0; round < 2; ++round)
    for (const QString& name : window.sceneNames()) {
      window.showScene(name);
      settle();
      ASSERT_TRUE(idle());
    }
  EXPECT_EQ(workbench.touch().stages().runs("mesh"), 1);
  EXPECT_EQ(workbench.touch().stages().runs("solve"), 1);
}

TEST_F(Window, ShowsAndCancelsTheWorkOfTheLiveScene) {
  ASSERT_TRUE(solved());
  Project heavy = workbench.project();
  heavy.mesh = {1.2, {}}; // solved for so long that the strip is seen
  workbench.edit("finer", heavy);
  window.showScene("live");
  workbench.touch().cancel();
  auto& page = static_cast<LiveBoards&>(window.currentScene()).page();
  auto& twin = find<LiveModelView>("liveTwin");
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return page.complete() && page.host().history().lastValid() != nullptr; }, kPatience_ms));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window.busy(); }, kPatience_ms));
  twin.solve(heavy.design, heavy.load, heavy.mesh, {});
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        const auto strips = window.statusBar()->findChildren<QPushButton*>("cancel");
        return std::any_of(strips.begin(), strips.end(), [](const QPushButton* cancel) { return cancel->isVisible(); });
      },
      kPatience_ms));
  EXPECT_TRUE(window.busy());
  QTest::keyClick(&window, Qt::Key_Escape);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window.busy(); }, kPatience_ms));
  EXPECT_EQ(twin.touch(), nullptr);
  EXPECT_TRUE(find<QLabel>("twinWords").text().contains("Solve for this force"));
}

TEST_F(Window, GivesTheKeysToTheSceneThatIsChosen) {
  find<QDoubleSpinBox>("force_z").setFocus();
  QTest::keyClick(&window, Qt::Key_5, Qt::ControlModifier);
  ASSERT_EQ(window.currentScene().objectName(), "live");
  auto& page = static_cast<LiveBoards&>(window.currentScene()).page();
  EXPECT_EQ(QApplication::focusWidget(), &page) << "and to none of its fields";
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Space);
  EXPECT_TRUE(page.host().paused());
}

TEST_F(Window, KeepsWhatItSaidInALog) {
  window.showMessage("First.");
  window.showMessage("Second.");
  const QString lines = find<QPlainTextEdit>("messageLines").toPlainText();
  EXPECT_TRUE(lines.contains("First.")) << lines.toStdString();
  EXPECT_LT(lines.indexOf("First."), lines.indexOf("Second."));
}

TEST_F(Window, SaysEveryScenesCommand) {
  for (const QString& name : window.sceneNames()) {
    window.showScene(name);
    EXPECT_TRUE(window.currentScene().commands(workbench.project(), "s.json").startsWith("palp "))
        << name.toStdString();
  }
}

TEST_F(Window, HelpsWithEverySceneAndItsPicture) {
  QTest::keyClick(&window, Qt::Key_F1);
  auto* help = window.findChild<QDialog*>("help");
  ASSERT_NE(help, nullptr);
  auto& text = *help->findChild<QTextBrowser*>();
  EXPECT_EQ(text.source().fileName(), "first-hour.html");
  for (const QString& name : window.sceneNames()) {
    window.showScene(name);
    QTest::keyClick(&window, Qt::Key_F1);
    EXPECT_EQ(text.source().fileName(), name + ".html");
    EXPECT_TRUE(text.toHtml().contains("screenshots/" + name + ".png")) << name.toStdString();
    EXPECT_FALSE(
        QImage(QString::fromStdString(resource(("screenshots/" + name + ".png").toStdString()).string())).isNull());
  }
}

TEST_F(Window, KeepsSplittersAndTabsForTheNextStart) {
  auto& splitter = find<QSplitter>("deformationSplitter");
  settle();
  splitter.setSizes({300, 420});
  find<QTabWidget>("deformationTabs").setCurrentIndex(2);
  const QList<int> sizes = splitter.sizes();
  window.close();
  Workbench again{quickProject()};
  NetworkSession none;
  MainWindow next{again, none};
  next.resize(1300, 800);
  next.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&next));
  EXPECT_EQ(next.findChild<QSplitter*>("deformationSplitter")->sizes(), sizes);
  EXPECT_EQ(next.findChild<QTabWidget*>("deformationTabs")->currentIndex(), 2);
}

} // namespace
} // namespace palp
