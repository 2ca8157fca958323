#include "app/gui/window/SceneCosts.h"

#include "tests/app/gui/WindowFixture.h"

#include <QJsonObject>

#include <gtest/gtest.h>

namespace palp {
namespace {

using SceneCostsTest = WindowFixture;

int sum(const QJsonArray& steps, const QString& key) {
  int total = 0;
  for (const auto& step : steps) total += step.toObject()[key].toInt();
  return total;
}

TEST_F(SceneCostsTest, AnUnchangedDesignIsSolvedOnceThroughAllScenesAndHiddenOnesDrawNothing) {
  ASSERT_TRUE(solved()); // the window opens on Deformation
  const QJsonArray steps = SceneCosts(window, workbench).allScenes();
  EXPECT_EQ(steps.size(), 2 * window.sceneNames().size());
  for (const char* stage : {"mesh", "factorise", "solve", "hidden_pictures"}) EXPECT_EQ(sum(steps, stage), 0) << stage;
  EXPECT_EQ(workbench.touch().stages().runs("solve"), 1);
  EXPECT_GT(sum(steps, "pictures"), window.sceneNames().size()) << "nothing was looked at";
}

TEST_F(SceneCostsTest, AChangeWhileHiddenIsComputedOnceWhenTheSceneIsSeenAgain) {
  const QJsonArray steps = SceneCosts(window, workbench).oneScene("deformation");
  ASSERT_EQ(steps.size(), 9);
  EXPECT_EQ(sum(steps, "hidden_pictures"), 0);
  const QJsonObject alone = steps[1].toObject(), load = steps[2].toObject(), hidden = steps[7].toObject(),
                    again = steps[8].toObject();
  EXPECT_EQ(alone["pictures"].toInt(), 0);
  EXPECT_EQ(load["solve"].toInt(), 1);
  EXPECT_EQ(load["mesh"].toInt(), 0);
  EXPECT_EQ(hidden["event"].toString(), "another load while hidden");
  EXPECT_EQ(hidden["solve"].toInt(), 0);
  EXPECT_EQ(again["solve"].toInt(), 1);
  EXPECT_GT(again["pictures"].toInt(), 0);
}

TEST_F(SceneCostsTest, EveryKindOfPictureIsCounted) {
  const QJsonArray steps = SceneCosts(window, workbench).oneScene("resistance");
  EXPECT_EQ(steps[2].toObject()["event"].toString(), "another load");
  EXPECT_EQ(steps[2].toObject()["pictures"].toInt(), 4) << "the heatmap, its row and column, the block";
}

TEST_F(SceneCostsTest, PaintingsOfASceneThatIsNotSeenAreCounted) {
  ASSERT_TRUE(solved());
  SceneCosts costs(window, workbench);
  QWidget& hidden = *window.currentScene().parentWidget()->findChild<QWidget*>("live");
  const auto timer = QObject::connect(&workbench, &Workbench::projectChanged, &window, [&] {
    QEvent paint(QEvent::Paint); // as a scene that draws behind the others would get
    QApplication::sendEvent(&hidden, &paint);
  });
  const QJsonArray steps = costs.oneScene("design");
  QObject::disconnect(timer);
  EXPECT_GT(sum(steps, "hidden_pictures"), 0);
}

} // namespace
} // namespace palp
