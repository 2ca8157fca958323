#include "app/gui/live/LiveBoards.h"

#include "app/gui/live/LiveCurves.h"
#include "app/gui/live/LiveView.h"
#include "app/gui/project/live/BoardCalibration.h"
#include "app/gui/views/HeatmapView.h"
#include "app/study/Resources.h"
#include "app/study/live/SimulatedTouch.h"
#include "io/SampleFile.h"
#include "io/board/RecordingReader.h"
#include "tests/app/gui/live/LiveOperatorFixture.h"

#include <QListWidget>
#include <QSpinBox>
#include <QToolButton>

namespace palp {
namespace {

/// Boards on a bus: each can be pulled out, and counts how often it is open.
struct FakeBus {
  struct Board {
    std::string serial;
    std::atomic<bool> out{false};
    std::atomic<int> opened{0};
  };
  std::array<Board, 2> boards{{{"PALP-A"}, {"PALP-B"}}};

  [[nodiscard]] static std::string path(std::size_t k) { return "/dev/hidraw" + std::to_string(k); }
};

class BusSource : public SimulatedSource {
public:
  BusSource(VirtualBoard board, std::shared_ptr<FakeBus> bus, std::size_t place)
      : SimulatedSource(std::move(board)), bus_(std::move(bus)), place_(place) {
    ++bus_->boards[place_].opened;
  }
  ~BusSource() override { --bus_->boards[place_].opened; }
  [[nodiscard]] std::string name() const override {
    return bus_->boards[place_].serial + " at " + FakeBus::path(place_);
  }
  Outcome read(RawReport& report, std::chrono::milliseconds timeout) override {
    return bus_->boards[place_].out ? Outcome::Gone : SimulatedSource::read(report, timeout);
  }
  [[nodiscard]] std::string reason() const override { return name() + " was pulled out"; }

private:
  std::shared_ptr<FakeBus> bus_;
  std::size_t place_;
};

BoardAccess accessTo(const std::shared_ptr<FakeBus>& bus) {
  const auto list = [bus] {
    std::vector<HidBoard> boards;
    for (std::size_t k = 0; k < bus->boards.size(); ++k)
      if (!bus->boards[k].out) boards.push_back({FakeBus::path(k), bus->boards[k].serial, "Palp board", true});
    return boards;
  };
  const auto open = [bus](const std::string& device) -> std::unique_ptr<ReportSource> {
    for (std::size_t k = 0; k < bus->boards.size(); ++k) {
      if (bus->boards[k].out || (device != FakeBus::path(k) && device != bus->boards[k].serial)) continue;
      // Each has a touch of its own.
      VirtualBoard board = simulatedBoard(loadSamples(resource("board/paper-samples.csv")), {}, 1000, 3 + k);
      return std::make_unique<BusSource>(std::move(board), bus, k);
    }
    return nullptr;
  };
  return {list, open, [] { return std::vector<std::string>{}; }};
}

class Boards : public testing::Test {
protected:
  explicit Boards(BoardAccess access = noBoards()) : scene(workbench, std::move(access)) {
    QObject::connect(&scene, &LiveBoards::message, &scene, [this](const QString& sentence) { said << sentence; });
    scene.resize(1300, 800);
    scene.show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&scene));
  }
  template <class Condition> static bool wait(const Condition& condition) {
    return QTest::qWaitFor(condition, kPatience_ms);
  }
  template <class Widget> Widget& find(std::size_t board, const char* name) {
    auto* widget = scene.page(board).parentWidget()->findChild<Widget*>(name);
    EXPECT_NE(widget, nullptr) << name;
    return *widget;
  }
  void click(std::size_t board, const char* name) {
    QTest::mouseClick(&find<QPushButton>(board, name), Qt::LeftButton);
  }
  const LiveStatus& status(std::size_t board) { return scene.page(board).host().status(); }
  bool streams(std::size_t board, std::uint64_t more = 5) {
    const std::uint64_t want = status(board).counts.frames + more;
    return wait([&] { return status(board).state == LiveState::Streaming && status(board).counts.frames >= want; });
  }
  bool records(std::size_t board, const QString& file) {
    find<QLineEdit>(board, "recordFile").setText(file);
    click(board, "record");
    return wait([&] { return status(board).recording; });
  }

  Workbench workbench{exampleProject()};
  LiveBoards scene;
  QStringList said;
};

class TwoBoards : public Boards {
protected:
  TwoBoards() : TwoBoards(std::make_shared<FakeBus>()) {}
  explicit TwoBoards(const std::shared_ptr<FakeBus>& shared) : Boards(accessTo(shared)), bus(shared) {}
  bool shown() {
    if (!streams(0) || !wait([&] { return scene.page(0).host().boards().size() == 2; })) return false;
    click(0, "anotherBoard");
    return scene.count() == 2 && streams(1);
  }
  std::shared_ptr<FakeBus> bus;
  QTemporaryDir folder;
};

TEST_F(TwoBoards, AreSeenSideBySideEachWithItsOwnStateForcesAndTare) {
  ASSERT_TRUE(shown());
  EXPECT_EQ(status(0).source, "PALP-A at /dev/hidraw0");
  EXPECT_EQ(status(1).source, "PALP-B at /dev/hidraw1");
  EXPECT_TRUE(wait([&] {
    return find<QLabel>(0, "boardTitle").text() == "Board 0: PALP-A at /dev/hidraw0 — streaming";
  })) << find<QLabel>(0, "boardTitle").text().toStdString();
  EXPECT_TRUE(
      wait([&] { return find<QLabel>(1, "boardTitle").text() == "Board 1: PALP-B at /dev/hidraw1 — streaming"; }));
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_TRUE(wait([&] { return !find<LiveView>(k, "liveBlock").arrows().empty(); })) << k;
    EXPECT_TRUE(scene.page(k).isVisible()) << k;
    EXPECT_EQ(bus->boards[k].opened, 1) << k;
  }
  find<QSpinBox>(1, "tareFrames").setValue(3);
  click(1, "tare");
  EXPECT_TRUE(wait([&] { return status(1).tared; }));
  EXPECT_FALSE(status(0).tared);
  EXPECT_EQ(workbench.project().live.tareFrames, 25) << "each has settings of its own";
}

TEST_F(TwoBoards, AreRecordedEachIntoItsOwnFile) {
  ASSERT_TRUE(shown());
  const QString a = folder.filePath("a.palprec"), b = folder.filePath("b.palprec");
  ASSERT_TRUE(records(0, a));
  EXPECT_FALSE(status(1).recording);
  ASSERT_TRUE(records(1, b));
  ASSERT_TRUE(streams(0) && streams(1));
  for (const std::size_t k : {0, 1}) {
    click(k, "record");
    ASSERT_TRUE(wait([&] { return !status(k).recording; }));
  }
  EXPECT_EQ(RecordingReader(a.toStdString()).head().source, "PALP-A at /dev/hidraw0");
  EXPECT_EQ(RecordingReader(b.toStdString()).head().source, "PALP-B at /dev/hidraw1");
}

TEST_F(TwoBoards, PullingOneOutLeavesTheOtherUntouched) {
  ASSERT_TRUE(shown());
  bus->boards[0].out = true;
  ASSERT_TRUE(wait([&] { return status(0).state == LiveState::Searching; }));
  EXPECT_TRUE(wait([&] { return find<QLabel>(0, "liveBanner").text().contains("PALP-A"); }));
  EXPECT_TRUE(streams(1));
  EXPECT_EQ(status(1).connections, 1U);
  EXPECT_TRUE(find<QLabel>(1, "liveBanner").text().isEmpty());
  EXPECT_EQ(status(0).connections, 1U) << "it has not taken the other's board";
  bus->boards[0].out = false;
  EXPECT_TRUE(wait([&] { return status(0).state == LiveState::Streaming && status(0).connections == 2; }));
  EXPECT_EQ(status(0).source, "PALP-A at /dev/hidraw0");
  EXPECT_EQ(status(1).counts.lost, 0U);
}

TEST_F(TwoBoards, ABoardIsReadByOneAtATime) {
  ASSERT_TRUE(shown());
  auto& list = find<QListWidget>(1, "devices");
  const auto lineOf = [&](const char* serial) -> QListWidgetItem* {
    const auto lines = list.findItems(serial, Qt::MatchStartsWith);
    return lines.isEmpty() ? nullptr : lines[0];
  };
  ASSERT_TRUE(
      wait([&] { return lineOf("PALP-A") != nullptr && lineOf("PALP-A")->text().contains("shown in another view"); }));
  QTest::mouseClick(list.viewport(), Qt::LeftButton, {}, list.visualItemRect(lineOf("PALP-A")).center());
  ASSERT_TRUE(wait([&] { return status(1).state == LiveState::Refused; }));
  EXPECT_TRUE(wait([&] { return find<QLabel>(1, "liveBanner").text().contains("is already open in another view"); }));
  EXPECT_TRUE(streams(0));
  EXPECT_EQ(bus->boards[0].opened, 1);
  click(0, "takeBoardAway"); // the one that reads it
  ASSERT_EQ(scene.count(), 1U);
  EXPECT_TRUE(wait([&] {
    return status(0).source == "PALP-A at /dev/hidraw0" && status(0).state == LiveState::Streaming;
  })) << "by itself";
}

TEST_F(TwoBoards, ABoardThatIsTakenAwayIsLetGoAndTheOtherGoesOn) {
  ASSERT_TRUE(shown());
  const std::uint64_t connections = status(1).connections;
  click(0, "takeBoardAway");
  ASSERT_EQ(scene.count(), 1U);
  EXPECT_EQ(workbench.project().live.device, "PALP-B");
  EXPECT_TRUE(workbench.project().moreBoards.empty());
  EXPECT_TRUE(wait([&] { return bus->boards[0].opened == 0; })) << "it is still read";
  EXPECT_TRUE(streams(0));
  EXPECT_EQ(status(0).source, "PALP-B at /dev/hidraw1");
  EXPECT_EQ(status(0).connections, connections) << "it was opened again";
  EXPECT_FALSE(find<QLabel>(0, "boardTitle").isVisible()) << "one board needs no number";
}

TEST_F(TwoBoards, ARecordingIsEndedOnlyByWhoSaysSo) {
  ASSERT_TRUE(shown());
  ASSERT_TRUE(records(1, folder.filePath("b.palprec")));
  answerQuestion(QMessageBox::No);
  click(1, "takeBoardAway");
  EXPECT_EQ(scene.count(), 2U);
  EXPECT_TRUE(status(1).recording);
  answerQuestion(QMessageBox::Yes);
  click(1, "takeBoardAway");
  EXPECT_EQ(scene.count(), 1U);
  EXPECT_TRUE(wait([&] { return bus->boards[1].opened == 0; }));
  EXPECT_GT(RecordingReader(folder.filePath("b.palprec").toStdString()).head().info.rowWires, 0);
}

TEST_F(TwoBoards, LabelledFramesAndACalibratedNetworkAreNotLostWithTheirBoardWithoutAQuestion) {
  ASSERT_TRUE(shown());
  Project next = workbench.project();
  BoardFrames frames{loadSamples(resource("board/paper-samples.csv")), {}};
  frames.read_N = Eigen::Matrix3Xd::Zero(3, frames.samples.size());
  next.board(1).frames = std::make_shared<const BoardFrames>(frames);
  workbench.edit("frames", next);
  const QString losses = scene.page(1).lossesByClosing().join(' ');
  EXPECT_TRUE(losses.contains("labelled frames of this board are not saved")) << losses.toStdString();
  EXPECT_TRUE(scene.page(0).lossesByClosing().isEmpty()) << "they are the other's";
  answerQuestion(QMessageBox::No);
  click(1, "takeBoardAway");
  EXPECT_EQ(scene.count(), 2U);
  ASSERT_TRUE(wait([&] { return scene.page(0).host().network().decoder().has_value(); }));
  scene.page(0).host().network().refine(*scene.page(0).host().network().decoder(), "calibrated, 8 frames");
  EXPECT_TRUE(scene.page(0).lossesByClosing().join(' ').contains("calibrated, 8 frames"));
}

TEST_F(TwoBoards, CostNothingWhileTheSceneIsHidden) {
  ASSERT_TRUE(shown());
  scene.hide();
  EXPECT_TRUE(wait([&] { return bus->boards[0].opened == 0 && bus->boards[1].opened == 0; })) << "still held open";
  scene.show();
  EXPECT_TRUE(streams(0) && streams(1));
}

TEST_F(Boards, WithoutHardwareTheOtherOneIsSimulatedAndDoesNotDoTheSame) {
  ASSERT_TRUE(streams(0));
  click(0, "anotherBoard");
  ASSERT_EQ(scene.count(), 2U);
  ASSERT_TRUE(streams(1));
  EXPECT_TRUE(scene.page(1).host().simulated());
  EXPECT_NE(workbench.project().board(0).simulation.seed, workbench.project().board(1).simulation.seed);
  click(1, "plug");
  EXPECT_TRUE(wait([&] { return status(1).state == LiveState::Searching; }));
  EXPECT_TRUE(streams(0)) << "one plug is not the other's";
}

TEST_F(Boards, WhatIsBrokenOfOneIsWholeOfTheNext) {
  Project project = workbench.project();
  project.live.simulation.openRow = 2;
  project.live.simulation.openColumn = 3;
  project.live.simulation.dropEvery = 50;
  workbench.edit("broken wires", project);
  ASSERT_TRUE(streams(0));
  click(0, "anotherBoard");
  ASSERT_TRUE(streams(1));
  const SimulationSettings& broken = workbench.project().board(0).simulation;
  const SimulationSettings& whole = workbench.project().board(1).simulation;
  EXPECT_EQ(broken.openRow, 2);
  EXPECT_EQ(whole.openRow, -1);
  EXPECT_EQ(whole.openColumn, -1);
  EXPECT_EQ(whole.dropEvery, 0);
}

TEST_F(Boards, WhereTheyHaveNoRoomForPanelsAButtonBringsEachBack) {
  ASSERT_TRUE(streams(0));
  click(0, "anotherBoard");
  ASSERT_TRUE(streams(1));
  for (std::size_t k = 0; k < 2; ++k) EXPECT_FALSE(find<QLineEdit>(k, "recordFile").isVisible()) << k;
  click(1, "boardPanel");
  EXPECT_TRUE(find<QLineEdit>(1, "recordFile").isVisible());
  EXPECT_FALSE(find<QLineEdit>(0, "recordFile").isVisible()) << "each has its own";
  click(1, "boardPanel");
  EXPECT_FALSE(find<QLineEdit>(1, "recordFile").isVisible());
  QTest::mouseClick(&find<QToolButton>(1, "foldPanel"), Qt::LeftButton);
  EXPECT_TRUE(find<QPushButton>(1, "boardPanel").isChecked()) << "as the strip at its edge does";
}

TEST_F(Boards, APanelThatIsOpenedLeavesTheViewsOfItsBoardInSight) {
  ASSERT_TRUE(streams(0));
  click(0, "anotherBoard");
  ASSERT_TRUE(streams(1));
  click(1, "boardPanel");
  EXPECT_TRUE(wait([&] { return scene.page(1).width() > scene.page(0).width(); })) << "the room for it";
  EXPECT_TRUE(wait([&] { return find<LiveView>(1, "liveBlock").isVisible(); }));
  EXPECT_TRUE(find<LiveView>(0, "liveBlock").isVisible());
  click(1, "boardPanel");
  EXPECT_TRUE(wait([&] { return std::abs(scene.page(1).width() - scene.page(0).width()) < 10; }));
}

TEST_F(Boards, TheProjectKeepsThemAndAnotherProjectHasItsOwn) {
  ASSERT_TRUE(streams(0));
  for (std::size_t k = 1; k < Project::kMostBoards; ++k) click(k - 1, "anotherBoard");
  ASSERT_EQ(scene.count(), Project::kMostBoards);
  for (std::size_t k = 0; k < scene.count(); ++k) EXPECT_FALSE(find<QPushButton>(k, "anotherBoard").isEnabled());
  EXPECT_FALSE(workbench.history().canUndo()) << "boards are no part of the design's history";
  const Project mine = workbench.project();
  workbench.replace(exampleProject());
  EXPECT_EQ(scene.count(), 1U);
  workbench.replace(mine);
  EXPECT_EQ(scene.count(), Project::kMostBoards);
  scene.hide();
  workbench.replace(exampleProject());
  EXPECT_EQ(scene.count(), 1U) << "boards of a project that is not there any more";
}

} // namespace
} // namespace palp
