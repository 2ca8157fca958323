#include "tests/app/gui/network/NetworkSceneFixture.h"

#include <QDir>
#include <QFile>
#include <QLineEdit>
#include <QTemporaryDir>
#include <QToolButton>

#include <gtest/gtest.h>

namespace palp {
namespace {

/// What the files of the Network scene say of themselves.
class NetworkSources : public NetworkScene {
protected:
  void setRidge(const char* value) {
    auto& ridge = find<QLineEdit>("ridge");
    ridge.setFocus();
    ridge.selectAll();
    QTest::keyClicks(&ridge, value);
    QTest::keyClick(&ridge, Qt::Key_Return);
  }
  void exportAll() {
    answerFileDialog(folder.filePath("all"));
    QTest::keyClick(&window, Qt::Key_E, Qt::ControlModifier | Qt::ShiftModifier);
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return window.statusBar()->currentMessage().startsWith("Wrote"); }, kPatience_ms));
  }
  std::string head(const QString& name) {
    QFile in(QDir(folder.filePath("all")).filePath(name));
    if (!in.open(QIODevice::ReadOnly)) return "no " + name.toStdString();
    QByteArray lines;
    for (QByteArray line = in.readLine(); line.startsWith('#'); line = in.readLine()) lines += line;
    return lines.toStdString();
  }
  static bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

  QTemporaryDir folder;
};

TEST_F(NetworkSources, EachFileHoldsTheCommandsOfItsOwnNumbersAndSaysWhetherTheyAreStale) {
  generate();
  QTest::mouseClick(&find<QToolButton>("moreOptions"), Qt::LeftButton);
  setRidge("0.001");
  trained();
  QTest::mouseClick(&find<QPushButton>("sweep"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.sweepPoints().size() == 3; }, kPatience_ms));
  ASSERT_TRUE(idle());
  QTest::mouseClick(&find<QPushButton>("compare"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.trials().size() == decodersWith(&DecoderTraits::ofAreas).size(); },
                              kPatience_ms));
  ASSERT_TRUE(idle());
  const NetworkFit* before = network.fit();
  setRidge("0.25"); // trains at once; sweep and comparison stay
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit() != before; }, kPatience_ms));
  ASSERT_TRUE(idle());
  Project finer = workbench.project();
  finer.mesh.mapped = {12, 8, 2}; // the samples were not made on it
  workbench.edit("mesh", finer);
  ASSERT_TRUE(idle());
  exportAll();
  for (const char* name : {"sweep.csv", "leaveOneOut.csv", "condition.csv", "errorTime.csv"}) {
    const std::string text = head(name);
    EXPECT_TRUE(has(text, "# palp sweep train.csv") && has(text, " --ridge 0.001 ")) << name << '\n' << text;
    EXPECT_FALSE(has(text, "0.25 ") || has(text, "palp train")) << name << '\n' << text;
    EXPECT_TRUE(has(text, "--mapped 9x8x2") && !has(text, "12x8x2")) << text;
    EXPECT_TRUE(has(text, "# stale when it was saved: The sweep belongs to other settings (ridge 0.001, now 0.25)."))
        << text;
  }
  for (const char* name : {"decoders.csv", "trialsTime.csv"}) {
    const std::string text = head(name);
    for (const DecoderTrial& trial : network.trials()) {
      if (trial.kind == DecoderKind::Rbf || !trial.refusal.isEmpty()) continue;
      const std::string option = " --decoder " + palp::name(trial.kind) + " ";
      EXPECT_TRUE(has(text, option.c_str())) << option << text;
    }
    EXPECT_TRUE(has(text, " --ridge 0.001 ") && !has(text, "--ridge 0.25")) << text;
    EXPECT_TRUE(has(text, "The comparison belongs to other settings (ridge 0.001, now 0.25).")) << text;
    EXPECT_FALSE(has(text, "palp sweep") || has(text, "The sweep belongs")) << text;
  }
  EXPECT_TRUE(has(head("trialsError.csv"), "# palp sweep")) << "the swept curve stands in it";
  const std::string fit = head("relativeError.csv");
  EXPECT_TRUE(has(fit, "# palp train") && has(fit, " --ridge 0.25 ") && has(fit, "# palp predict")) << fit;
  EXPECT_TRUE(has(fit, "# up to date when it was saved") && !has(fit, "palp sweep")) << fit;
  const std::string list = head("networks.csv");
  EXPECT_TRUE(has(list, " --ridge 0.25 ") && has(list, " --ridge 0.001 ")) << "one a row\n" << list;
  EXPECT_TRUE(has(list, "# up to date when it was saved") && !has(list, "palp sweep")) << list;
}

} // namespace
} // namespace palp
