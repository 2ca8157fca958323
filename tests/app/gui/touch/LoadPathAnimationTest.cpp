#include "app/gui/touch/LoadPathAnimation.h"

#include "app/gui/views/BlockView.h"
#include "tests/app/gui/WindowFixture.h"

#include <QImage>
#include <QSignalSpy>
#include <QTemporaryDir>

#include <gtest/gtest.h>

namespace palp {
namespace {

class LoadPath : public WindowFixture {
protected:
  LoadPathAnimation::Settings settings(int width) {
    LoadPathAnimation::Settings settings;
    settings.frames = 3;
    settings.width = width;
    settings.height = 120;
    settings.folder = folder.path().toStdString();
    return settings;
  }
  QTemporaryDir folder;
};

TEST_F(LoadPath, WritesItsPictures) {
  ASSERT_TRUE(solved());
  LoadPathAnimation animation(workbench.touch(), find<BlockView>("block"));
  QSignalSpy done(&animation, &LoadPathAnimation::done);
  ASSERT_TRUE(animation.start(settings(160)));
  ASSERT_TRUE(QTest::qWaitFor([&] { return done.count() == 1; }, kPatience_ms));
  const QImage first(folder.filePath("load-000.png")), last(folder.filePath("load-002.png"));
  EXPECT_EQ(first.size(), QSize(160, 120));
  EXPECT_EQ(last.size(), QSize(160, 120));
  EXPECT_NE(first, last) << "rest and full load look the same";
}

TEST_F(LoadPath, ADrawingThatFailsIsSaidAndEndsTheJob) {
  ASSERT_TRUE(solved());
  LoadPathAnimation animation(workbench.touch(), find<BlockView>("block"));
  QSignalSpy failed(&animation.runner(), &JobRunner::failed);
  ASSERT_TRUE(animation.start(settings(20000))); // wider than any picture that can be drawn
  ASSERT_TRUE(QTest::qWaitFor([&] { return !animation.runner().running(); }, kPatience_ms));
  ASSERT_EQ(failed.count(), 1);
  EXPECT_TRUE(failed[0][0].toString().contains("20000")) << failed[0][0].toString().toStdString();
}

} // namespace
} // namespace palp
