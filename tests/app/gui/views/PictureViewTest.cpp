#include "app/gui/views/PictureView.h"

#include <QHBoxLayout>
#include <QTest>
#include <QThread>
#include <QTimer>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace palp {
namespace {

/// Takes its time to draw, and notes how often the window's event loop was free before.
class SlowView : public PictureView {
public:
  explicit SlowView(const int& beats) : beats_(beats) {}
  std::vector<int> drawnAt;

protected:
  void render(QImage& image) override {
    QThread::msleep(30);
    image.fill(Qt::white);
    drawnAt.push_back(beats_);
  }
  Picture renderPicture(int, int) override { return {}; }

private:
  const int& beats_;
};

TEST(PictureView, DrawnTogetherTheyLeaveTheWindowFreeInBetween) {
  int beats = 0;
  QTimer beat;
  QObject::connect(&beat, &QTimer::timeout, &beat, [&beats] { ++beats; });
  QWidget window;
  auto* row = new QHBoxLayout(&window);
  std::vector<SlowView*> views;
  for (int k = 0; k < 4; ++k) row->addWidget(views.emplace_back(new SlowView(beats)));
  window.show();
  const auto drawn = [&](std::size_t times) {
    return QTest::qWaitFor([&] {
      return std::all_of(views.begin(), views.end(),
                         [&](const SlowView* view) { return view->drawnAt.size() == times; });
    });
  };
  ASSERT_TRUE(drawn(1));
  QTest::qWait(20);
  beat.start(0);
  for (SlowView* view : views) view->invalidate();
  ASSERT_TRUE(drawn(2));
  for (std::size_t k = 1; k < views.size(); ++k) EXPECT_NE(views[k]->drawnAt[1], views[k - 1]->drawnAt[1]) << k;
  for (SlowView* view : views) view->invalidate();
  windowPicture(window); // as they are now
  ASSERT_TRUE(drawn(3));
}

TEST(PictureView, IsDrawnAPassLaterThanWhatElseTookLongInOne) {
  int beats = 0;
  QTimer beat;
  QObject::connect(&beat, &QTimer::timeout, &beat, [&beats] { ++beats; });
  QWidget window;
  auto* row = new QHBoxLayout(&window);
  auto* view = new SlowView(beats);
  row->addWidget(view);
  window.show();
  ASSERT_TRUE(QTest::qWaitFor([&] { return view->drawnAt.size() == 1; }));
  QTest::qWait(20);
  beat.start(0);
  int filledAt = -1;
  QTimer::singleShot(0, view, [&] { // as panels are filled where a project changes
    QThread::msleep(30);
    view->invalidate();
    filledAt = beats;
  });
  ASSERT_TRUE(QTest::qWaitFor([&] { return view->drawnAt.size() == 2; }));
  EXPECT_GT(view->drawnAt[1], filledAt);
}

} // namespace
} // namespace palp
