#include "app/gui/views/BlockView.h"
#include "app/gui/views/ChartView.h"
#include "tests/app/gui/WindowFixture.h"

#include <QMessageBox>
#include <QPushButton>

namespace palp {
namespace {

class Memory : public WindowFixture {
protected:
  void made() {
    window.showScene("network");
    QTest::mouseClick(&find<QPushButton>("generate"), Qt::LeftButton);
    ASSERT_TRUE(QTest::qWaitFor([&] { return network.samples() != nullptr; }, kPatience_ms));
    ASSERT_TRUE(idle());
    QTest::mouseClick(&find<QPushButton>("train"), Qt::LeftButton);
    ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit() != nullptr; }, kPatience_ms));
    ASSERT_TRUE(idle());
  }
};

TEST_F(Memory, ANewProjectLetsGoOfAllThatTheOtherHeld) {
  ASSERT_TRUE(solved());
  made();
  Project other = workbench.project();
  other.design.block_mm.z() = 6; // whose results are kept for an undo
  workbench.edit("height", other);
  made();
  const std::weak_ptr<const NetworkSamples> samples = network.sharedSamples();
  const std::weak_ptr<const NetworkFit> fit = network.results().fit;
  QTimer answer;
  QObject::connect(&answer, &QTimer::timeout, &answer, [] {
    auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (box != nullptr && box->button(QMessageBox::Discard) != nullptr)
      QTest::mouseClick(box->button(QMessageBox::Discard), Qt::LeftButton);
  });
  answer.start(20);
  QTest::keyClick(&window, Qt::Key_N, Qt::ControlModifier);
  ASSERT_EQ(workbench.project().design, paperDesign());
  EXPECT_TRUE(QTest::qWaitFor([&] { return samples.expired() && fit.expired(); }, kPatience_ms));
  EXPECT_TRUE(network.kept().empty());
}

TEST_F(Memory, ManySamplesGetTheMemoryOfWhatIsNotSeenAndItIsDrawnAgain) {
  ASSERT_TRUE(solved());
  settle();
  auto& block = find<BlockView>("block");
  const QImage before = block.image().copy();
  ASSERT_TRUE(block.drawn());
  made();
  auto& error = find<ChartView>("sweepError");
  settle();
  const QImage chart = error.image().copy();
  ASSERT_TRUE(error.drawn());
  Project more = workbench.project();
  more.samples.perArea = 400; // so many that what follows comes first
  workbench.edit("more", more);
  settle();
  QTest::mouseClick(&find<QPushButton>("generate"), Qt::LeftButton);
  EXPECT_FALSE(block.drawn());
  EXPECT_FALSE(error.drawn());
  EXPECT_EQ(error.image().size(), chart.size()) << "its picture serves meanwhile";
  network.cancel();
  ASSERT_TRUE(idle());
  window.showScene("deformation");
  settle();
  EXPECT_EQ(block.image(), before);
  window.showScene("network");
  settle();
  wheel(error, 120); // which acts on what is drawn
  EXPECT_TRUE(error.drawn());
  EXPECT_EQ(error.image(), chart);
}

} // namespace
} // namespace palp
