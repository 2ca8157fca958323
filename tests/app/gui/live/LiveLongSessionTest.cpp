// A board for hours, in fast time, and everything that comes from outside in a broken twin.

#include "app/gui/live/LiveCalibration.h"
#include "app/study/Resources.h"
#include "app/study/live/SimulatedTouch.h"
#include "io/SampleFile.h"
#include "model/base/NumberText.h"
#include "tests/app/gui/live/LiveOperatorFixture.h"

#include <QFile>
#include <QTabWidget>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <unistd.h>

namespace palp {
namespace {

constexpr double kFramesPerSecond = 50; // 1000 reports/s, 20 of them a frame

/// The virtual board on a clock that runs as fast as it is read.
class FastSource : public ReportSource {
public:
  FastSource() : board_(simulatedBoard(loadSamples(resource("board/paper-samples.csv")), {}, 1000, 3)) {}
  [[nodiscard]] std::string name() const override { return "PALP-FAST"; }
  [[nodiscard]] const BoardInfo& info() const override { return board_.info(); }
  [[nodiscard]] const BoardConfiguration& configuration() const override { return board_.configuration(); }
  Outcome read(RawReport& report, std::chrono::milliseconds) override {
    while (queue_.empty()) {
      clock_us_ += 1000;
      board_.advance(clock_us_, [this](std::span<const std::uint8_t> bytes) {
        queue_.push_back({1e-6 * static_cast<double>(clock_us_), {bytes.begin(), bytes.end()}});
      });
    }
    std::swap(report, queue_.front());
    queue_.pop_front();
    return Outcome::Read;
  }

private:
  VirtualBoard board_;
  std::uint64_t clock_us_ = 1000000;
  std::deque<RawReport> queue_;
};

double residentMegabytes() {
  std::ifstream file("/proc/self/statm");
  double total = 0, resident = 0;
  file >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

class LiveForHours : public Live {
protected:
  LiveForHours()
      : Live({[] {
                return std::vector<HidBoard>{{"/dev/hidraw9", "PALP-FAST", "Palp board", true}};
              },
              [](const std::string&) { return std::make_unique<FastSource>(); }}) {}
};

/// PALP_LIVE_HOURS=3 runs three hours and prints what the process holds each half hour.
TEST_F(LiveForHours, HoldsNoMoreThanTheLastMinute) {
  const char* asked = std::getenv("PALP_LIVE_HOURS");
  const double hours = asked != nullptr ? numberIn(asked).value_or(0) : 0;
  const auto wanted = hours > 0 ? static_cast<std::uint64_t>(hours * 3600 * kFramesPerSecond)
                                : static_cast<std::uint64_t>(3 * LiveHistory::kMostFrames);
  const auto step = hours > 0 ? static_cast<std::uint64_t>(1800 * kFramesPerSecond) : wanted;
  std::uint64_t drained = 0;
  QObject::connect(&page, &LivePage::looked, &page, [&] {
    drained += page.host().fresh().size();
    EXPECT_LE(page.host().history().entries().size(), LiveHistory::kMostFrames);
    EXPECT_LE(page.host().fresh().size(), LiveOptions().ringFrames);
  });
  for (std::uint64_t until = step; until <= wanted; until += step) {
    while (page.host().status().counts.frames < until) QTest::qWait(50);
    if (hours > 0)
      std::cout << page.host().status().counts.frames / kFramesPerSecond / 3600 << " h: " << residentMegabytes()
                << " MB, " << drained << " frames shown" << std::endl;
  }
  EXPECT_GT(drained, LiveHistory::kMostFrames) << "too few came to the window to say anything";
  const auto& entries = page.host().history().entries();
  EXPECT_LE(entries.back().t_s - entries.front().t_s, LiveHistory::kLongest_s);
  EXPECT_EQ(page.host().status().counts.lost, 0U);
}

class LiveInputs : public LiveOperator {
protected:
  static QByteArray bytesOf(const QString& name) {
    QFile file(name);
    EXPECT_TRUE(file.open(QIODevice::ReadOnly));
    return file.readAll();
  }
  QString written(const QString& name, const QByteArray& bytes) const {
    QFile file(folder.filePath(name));
    EXPECT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(bytes);
    return file.fileName();
  }
};

TEST_F(LiveInputs, ABrokenRecordingIsSaidAndTheBoardComesBack) {
  ASSERT_TRUE(waitForFrames());
  const QString good = folder.filePath("good.palprec");
  ASSERT_TRUE(records(good, 10));
  const QByteArray bytes = bytesOf(good);
  QByteArray magic = bytes, length = bytes, head = bytes;
  magic[0] = 'X';
  length[11] = '\x7f';
  head.replace("\"source\"", "\"sourcx\"");
  const QStringList broken{written("empty.palprec", {}),
                           written("text.palprec", "t_s,board_s\n1,2\n"),
                           written("magic.palprec", magic),
                           written("length.palprec", length),
                           written("head.palprec", head),
                           written("cut.palprec", bytes.left(40)),
                           folder.path(),
                           folder.filePath("none.palprec")};
  for (const QString& file : broken) {
    use([&](LiveSettings& live) {
      live.source = LiveSourceKind::Recording;
      live.recording = file.toStdString();
    });
    ASSERT_TRUE(wait([&] {
      const LiveState state = page.host().status().state;
      return state == LiveState::Refused || state == LiveState::Ended;
    })) << file.toStdString();
    EXPECT_TRUE(wait([&] { return banner().contains(QFileInfo(file).fileName()); }))
        << file.toStdString() << ": " << banner().toStdString();
  }
  use([&](LiveSettings& live) {
    live.recording = written("short.palprec", bytes.left(bytes.size() - 7)).toStdString();
  });
  EXPECT_TRUE(wait([&] { return page.host().status().counts.frames > 3; })) << "what is whole of it is played";
  use([](LiveSettings& live) { live.source = LiveSourceKind::Automatic; });
  EXPECT_TRUE(waitForFrames());
}

TEST_F(LiveInputs, ABrokenNetworkLeavesTheOneInUse) {
  ASSERT_TRUE(waitForArrow());
  const QByteArray good = bytesOf(QString::fromStdString(resource("board/paper-network.json").string()));
  QByteArray version = good, text = good;
  version.replace("\"palp_network\": 1", "\"palp_network\": 999").replace("\"palp_network\":1", "\"palp_network\":999");
  text.replace(good.lastIndexOf('['), 1, "[\"a\",");
  ASSERT_NE(text, good);
  const QStringList broken{written("empty.json", {}),         written("cut.json", good.left(good.size() / 2)),
                           written("text.json", text),        written("null.json", "null"),
                           written("list.json", "[1, 2, 3]"), written("deep.json", QByteArray(100000, '[')),
                           folder.filePath("none.json")};
  for (const QString& file : broken) {
    use([&](LiveSettings& live) { live.network = file.toStdString(); });
    ASSERT_TRUE(wait([&] { return find<QLabel>("networkProblem").text().contains(QFileInfo(file).fileName()); }))
        << file.toStdString();
    EXPECT_TRUE(page.host().network().decoder().has_value());
    EXPECT_EQ(workbench.project().live.network, "") << file.toStdString();
  }
  ASSERT_TRUE(waitForFrames());
  EXPECT_TRUE(page.host().history().last()->forces.valid);
}

TEST_F(LiveInputs, BrokenLabelsAreRefusedAndThoseThatAreThereStay) {
  ASSERT_TRUE(waitForArrow());
  page.findChild<QTabWidget*>("curveTabs")->setCurrentIndex(1);
  auto& calibration = find<LiveCalibration>("calibration");
  const QByteArray good = bytesOf(QString::fromStdString(resource("board/paper-samples.csv").string()));
  answerFileDialog(written("good.csv", good));
  click("loadFrames");
  ASSERT_TRUE(wait([&] { return calibration.frames().samples().size() > 8 && !calibration.runner().running(); }));
  const Eigen::Index there = calibration.frames().samples().size();
  const qsizetype last = good.lastIndexOf('\n', -2) + 1;
  const auto lastLine = [&](const QByteArray& line) { return good.left(last) + line + "\n"; };
  const QByteArray line = good.mid(last).trimmed();
  const qsizetype comma = line.indexOf(',');
  const QList<QByteArray> broken{{},
                                 "fx,fy\n1,2\n",
                                 good.left(good.size() - line.size() / 2),
                                 lastLine("nan" + line.mid(comma)),
                                 lastLine("1e999" + line.mid(comma)),
                                 lastLine("-1" + line.mid(comma)),
                                 lastLine(line + ",1"),
                                 lastLine("")};
  for (qsizetype k = 0; k < broken.size(); ++k) {
    const QString name = QString("broken%1.csv").arg(k);
    answerFileDialog(written(name, broken[k]));
    click("loadFrames");
    EXPECT_TRUE(wait([&] { return find<QLabel>("calibrationProblem").text().contains(name); })) << k;
    EXPECT_EQ(calibration.frames().samples().size(), there) << k;
  }
}

} // namespace
} // namespace palp
