#include "app/study/live/LiveHistory.h"

#include "app/study/live/LabelledFrames.h"
#include "model/base/Error.h"
#include "tests/app/study/live/LiveFixture.h"
#include "tests/io/Refusal.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <sstream>

namespace palp {
namespace {

std::shared_ptr<LiveFrame> frame(double device_s, double host_s, bool restarted = false) {
  auto live = std::make_shared<LiveFrame>();
  live->frame.time_s = device_s;
  live->frame.hostTime_s = host_s;
  live->frame.restarted = restarted;
  return live;
}

TEST(LiveHistory, TakesTheDevicesClockNotTheArrival) {
  LiveHistory history;
  history.add(frame(1.00, 500.0));
  history.add(frame(1.02, 500.9)); // late
  history.add(frame(1.04, 500.9));
  EXPECT_NEAR(history.entries()[1].t_s - history.entries()[0].t_s, 0.02, 1e-9);
  EXPECT_NEAR(history.entries()[2].t_s - history.entries()[1].t_s, 0.02, 1e-9);
}

TEST(LiveHistory, GoesOnInHostTimeWhereTheBoardBeginsAnew) {
  LiveHistory history;
  history.add(frame(100, 500));
  history.add(frame(0, 507, true));
  EXPECT_DOUBLE_EQ(history.entries()[1].t_s - history.entries()[0].t_s, 7);
}

TEST(LiveHistory, HoldsNothingOfBeforeAJumpInARecording) {
  LiveHistory history;
  for (const double t_s : {10.0, 10.02, 10.04}) history.add(frame(t_s, t_s));
  auto jumped = frame(10.06, 4);
  jumped->jumps = 1;
  history.add(jumped);
  ASSERT_EQ(history.entries().size(), 1U);
  EXPECT_DOUBLE_EQ(history.entries()[0].t_s, 4);
}

TEST(LiveHistory, WritesAMarkOnceWhereItBegins) {
  const TemporaryFolder folder;
  LiveHistory history;
  for (int k = 0; k < 4; ++k) {
    history.add(frame(k, k));
    if (k >= 1) std::const_pointer_cast<LiveFrame>(history.entries().back().frame)->mark = "poke";
  }
  writeLiveCsv(folder / "a.csv", history);
  std::ifstream file(folder / "a.csv");
  std::string line;
  std::vector<bool> marked;
  std::getline(file, line);
  while (std::getline(file, line)) marked.push_back(line.find("poke") != std::string::npos);
  EXPECT_EQ(marked, (std::vector<bool>{false, true, false, false}));
}

TEST(LiveHistory, KnowsWhereAMarkBeginsAlsoAtTheFirstFrameButNotAfterAJumpBehindIt) {
  LiveHistory history;
  const auto add = [&](double t_s, const char* mark, std::uint64_t jumps) {
    auto next = frame(t_s, t_s);
    next->mark = mark;
    next->jumps = jumps;
    history.add(next);
    return history.entries().back().newMark;
  };
  EXPECT_TRUE(add(0, "poke", 0));
  EXPECT_FALSE(add(0.02, "poke", 0));
  EXPECT_TRUE(add(0.04, "push", 0));
  EXPECT_FALSE(add(0.01, "poke", 1));
  EXPECT_TRUE(add(0.04, "push", 1));
  history.clear();
  EXPECT_FALSE(add(1, "", 1));
}

TEST(LiveHistory, AMarkThatAJumpLeadsToBeginsThere) {
  LiveHistory history;
  const auto add = [&](double t_s, std::uint64_t jumps, bool follows) {
    auto next = frame(t_s, t_s);
    next->mark = "poke";
    next->jumps = jumps;
    next->markFollowsJump = follows;
    history.add(next);
    return history.entries().back().newMark;
  };
  add(7, 0, true);
  EXPECT_TRUE(add(3, 1, true));
  EXPECT_FALSE(add(3.02, 1, true)) << "once";
  EXPECT_FALSE(add(5, 2, false)) << "it began before the place that was gone to";
}

TEST(LiveHistory, NeverRunsBackwardsNorGrowsWithoutEnd) {
  LiveHistory history;
  for (std::size_t k = 0; k < LiveHistory::kMostFrames + 500; ++k)
    history.add(frame(1e-3 * static_cast<double>(k), 1e-3 * static_cast<double>(k)));
  EXPECT_EQ(history.entries().size(), LiveHistory::kMostFrames);
  history.add(frame(0.5, 0.5));
  EXPECT_GE(history.entries().back().t_s, history.entries()[history.entries().size() - 2].t_s);
  history.add(frame(1000, 1000));
  EXPECT_LE(history.entries().back().t_s - history.entries().front().t_s, LiveHistory::kLongest_s);
}

TEST(LiveHistory, KnowsWhereFramesAreMissing) {
  LiveHistory history;
  history.add(frame(1.00, 1.00));
  history.add(frame(1.02, 1.02));
  history.add(frame(2.00, 2.00)); // held for a second
  history.add(frame(2.02, 2.02));
  auto again = frame(2.04, 2.04);
  again->connection = 1; // pulled out and put in again at once
  history.add(again);
  std::vector<bool> gaps;
  for (const LiveHistory::Entry& entry : history.entries()) gaps.push_back(entry.gap);
  EXPECT_EQ(gaps, (std::vector<bool>{false, false, true, false, true}));
  LiveHistory slow;
  for (int k = 0; k < 5; ++k) slow.add(frame(0.5 * k, 0.5 * k)); // a slow board misses nothing
  EXPECT_FALSE(slow.entries().back().gap);
}

TEST(LiveHistory, HoldsNoMoreAfterThreeHoursThanAfterAMinute) {
  constexpr double kRate_Hz = 100;
  LiveHistory history;
  std::weak_ptr<const LiveFrame> first;
  const auto feed = [&](int from, int to) {
    for (int k = from; k < to; ++k) {
      auto live = frame(k / kRate_Hz, k / kRate_Hz);
      live->forces.valid = true;
      live->change = Eigen::MatrixXd::Zero(10, 30);
      if (k == 0) first = live;
      history.add(live);
    }
  };
  feed(0, 60 * 100);
  const std::size_t minute = history.entries().size();
  feed(60 * 100, 3 * 3600 * 100);
  EXPECT_LE(history.entries().size(), minute);
  EXPECT_LE(history.entries().size(), LiveHistory::kMostFrames);
  EXPECT_TRUE(first.expired()) << "an old frame is still held";
}

TEST(LiveHistory, WritesATimeThatNeverJumpsBackWithTheBoardsOwnBesideIt) {
  const TemporaryFolder folder;
  LiveHistory history;
  history.add(frame(100, 500));
  history.add(frame(100.5, 500.5));
  history.add(frame(0.3, 507, true)); // plugged in again: the board counts from 0
  writeLiveCsv(folder / "a.csv", history);
  std::ifstream file(folder / "a.csv");
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line.rfind("t_s,board_s,frame,", 0), 0U) << line;
  std::vector<double> time_s, board_s;
  while (std::getline(file, line)) {
    EXPECT_EQ(line.find("0.29999999999999999"), std::string::npos) << "numbers are as short as they can be";
    std::istringstream cells(line);
    char comma = 0;
    time_s.emplace_back();
    board_s.emplace_back();
    cells >> time_s.back() >> comma >> board_s.back();
  }
  EXPECT_EQ(time_s, (std::vector<double>{500, 500.5, 507}));
  EXPECT_EQ(board_s, (std::vector<double>{100, 100.5, 0.3}));
}

TEST(LiveHistory, IsWrittenAsATableWithNothingWhereThereIsNothing) {
  const TemporaryFolder folder;
  LiveHistory history;
  auto good = frame(1, 1);
  good->forces.valid = true;
  good->forces.forces_N = Eigen::Vector3d(0.25, 0, -2);
  good->forces.standardDeviation_N = Eigen::Vector3d(0.5, 0.5, 0.5);
  good->change = Eigen::MatrixXd::Constant(1, 2, 0.125);
  good->mark = "a \"b\"";
  auto bad = frame(2, 2);
  bad->forces.reason = "column-wire 1: open";
  bad->change = good->change;
  bad->change(0, 1) = std::numeric_limits<double>::quiet_NaN();
  history.add(good);
  history.add(bad);
  writeLiveCsv(folder / "a.csv", history);
  std::ifstream file(folder / "a.csv");
  std::string head, first, second;
  std::getline(file, head);
  std::getline(file, first);
  std::getline(file, second);
  EXPECT_NE(head.find("a0_fz_N"), std::string::npos);
  EXPECT_NE(head.find("dR_r0_c1_relative"), std::string::npos);
  EXPECT_NE(first.find(",0.25,0,-2,0.5,0.5,0.5,0.125,0.125,"), std::string::npos) << first;
  EXPECT_NE(first.find("\"a \"\"b\"\"\""), std::string::npos) << first;
  EXPECT_NE(second.find(",,,,,,,0.125,,\"column-wire 1: open\""), std::string::npos) << second;
  EXPECT_THROW(writeLiveCsv("/no/such/folder/a.csv", history), Error);
}

TEST(LiveHistory, LeavesTheCellsOfWhatIsNotMeasuredEmpty) {
  const TemporaryFolder folder;
  LiveHistory history;
  auto live = frame(1, 1);
  live->forces.valid = true;
  live->forces.forces_N = Eigen::Vector3d(0, 0, -4.5);
  live->forces.standardDeviation_N = Eigen::Vector3d(0, 0, 0.25);
  live->forces.measured.resize(3, 1);
  live->forces.measured << false, false, true;
  history.add(live);
  writeLiveCsv(folder / "a.csv", history);
  std::ifstream file(folder / "a.csv");
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  EXPECT_NE(text.find(",,,-4.5,,,0.25,"), std::string::npos) << text;
}

TEST(LabelledFrames, RefuseALoadThatMovesAndKeepWhatTheNetworkSaid) {
  const Decoder decoder = liveDecoder(5e-6);
  LabelledFrames frames;
  DecodedForces forces;
  forces.valid = true;
  forces.resistances_ohm = Eigen::MatrixXd::Constant(10, 30, 300);
  const auto collect = [&](double slope_N) {
    frames.begin(decoder, paperDesign(), {{0, {0, 0, -2}}}, 20);
    for (int k = 0; k < 20; ++k) {
      forces.forces_N = Eigen::Vector3d(0, 0, -2 + slope_N * k + (k % 2 == 0 ? 0.005 : -0.005));
      frames.add(forces);
    }
  };
  collect(0);
  ASSERT_EQ(frames.samples().size(), 1);
  EXPECT_NEAR(frames.predicted_N()(2, 0), -2, 1e-12);
  const std::string why = refusal([&] { collect(0.02); });
  EXPECT_NE(why.find("moved"), std::string::npos) << why;
  EXPECT_NE(why.find("Fz"), std::string::npos) << why;
  EXPECT_EQ(frames.samples().size(), 1);
  EXPECT_FALSE(frames.collecting());
}

TEST(LabelledFrames, SayWhenALabelCanHardlyBeTheLoad) {
  Decoder decoder;
  decoder.low_N = Eigen::Vector3d(-1, -1, -6);
  decoder.high_N = Eigen::Vector3d(1, 1, 0);
  DecodedForces reads;
  reads.valid = true;
  reads.standardDeviation_N = Eigen::Vector3d::Constant(0.01);
  const auto said = [&](double label_N, double read_N) {
    reads.forces_N = Eigen::Vector3d(0, 0, read_N);
    return labelAgainstReading({0, 0, label_N}, reads, 0, decoder);
  };
  EXPECT_NE(said(-4.9, 0).find("as at rest"), std::string::npos);
  EXPECT_NE(said(-4.9, -0.3).find("as at rest"), std::string::npos) << "a small share";
  EXPECT_NE(said(0, -2).find("check that the sensor is at rest"), std::string::npos);
  EXPECT_EQ(said(-4.9, -2), "") << "a wrong gain is what calibration is for";
  EXPECT_NE(said(-4.9, -1).find("check that this load is on the sensor"), std::string::npos)
      << "a gain that hardly any sensor has";
  EXPECT_NE(said(-1, -4.9).find("check that this load is on the sensor"), std::string::npos);
  EXPECT_NE(said(3, -3).find("other sign of Fz"), std::string::npos);
  EXPECT_EQ(said(0.2, -0.2), "") << "an offset may turn a small force round";
  EXPECT_EQ(said(0, -0.2), "") << "so is an offset";
  EXPECT_EQ(said(-0.04, 0), "") << "it hides in the noise";
  EXPECT_EQ(said(0, 0), "");
  reads.standardDeviation_N.setConstant(1);
  EXPECT_EQ(said(-4.9, 0), "") << "noise hides every load";
  reads.valid = false;
  EXPECT_EQ(said(-4.9, 0), "");
}

TEST(LabelledFrames, CollectsUnderALoadAndTakesFramesAway) {
  const TemporaryFolder folder;
  const Decoder decoder = liveDecoder(5e-6);
  LabelledFrames frames;
  DecodedForces forces;
  forces.valid = true;
  for (int k = 0; k < 3; ++k) {
    forces.resistances_ohm = Eigen::MatrixXd::Constant(10, 30, 300 + k);
    frames.begin(decoder, paperDesign(), {{k, {0, 0, -1.0 * k}}}, 2);
    EXPECT_FALSE(frames.add(forces));
    EXPECT_FALSE(frames.add({})); // not valid: does not count
    EXPECT_TRUE(frames.add(forces));
    EXPECT_FALSE(frames.collecting());
  }
  frames.remove(1);
  EXPECT_EQ(frames.samples().area, Eigen::Vector2i(0, 2));
  EXPECT_EQ(frames.samples().resistances_ohm(0, 1), 302);
  frames.save(folder / "frames.csv");
  LabelledFrames again;
  again.load(folder / "frames.csv");
  EXPECT_EQ(again.samples().forces_N, frames.samples().forces_N);
  EXPECT_NE(refusal([&] {
              frames.begin(decoder, paperDesign(), {{6, {0, 0, -1}}}, 2);
            }).find("area"),
            std::string::npos);
}

} // namespace
} // namespace palp
