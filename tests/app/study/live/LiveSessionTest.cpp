#include "app/study/live/LiveSession.h"

#include "tests/app/study/live/PluggedBoard.h"
#include "tests/io/Refusal.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

TEST(LiveSession, StreamsFramesWithForces) {
  LiveOptions options = plugged(std::make_shared<Plug>());
  options.decoder = liveDecoder(5e-6);
  options.tareFrames = 5;
  LiveSession live(std::move(options));
  ASSERT_TRUE(waitForFrames(live, 20));
  live.stop();
  const LiveStatus status = live.status();
  EXPECT_EQ(status.counts.lost + status.counts.bad + status.counts.incompleteFrames, 0U);
  EXPECT_TRUE(status.tared);
  EXPECT_EQ(status.decoderProblem, "");
  EXPECT_NEAR(status.temperature_degC.value_or(0), 23, 0.01);
  const auto frames = live.drain();
  ASSERT_GE(frames.size(), 20U);
  EXPECT_TRUE(frames.back()->forces.valid);
  for (std::size_t i = 1; i < frames.size(); ++i) EXPECT_GT(frames[i]->frame.time_s, frames[i - 1]->frame.time_s);
  EXPECT_TRUE(live.drain().empty());
}

TEST(LiveSession, ShowsRawReadingsWithoutANetworkAndSaysSo) {
  LiveSession live(plugged(std::make_shared<Plug>()));
  ASSERT_TRUE(waitForFrames(live, 3));
  EXPECT_NE(live.status().decoderProblem.find("raw readings only"), std::string::npos);
  EXPECT_FALSE(live.drain().front()->forces.valid);
}

TEST(LiveSession, SaysThatTheNetworkIsOfAnotherBoard) {
  LiveOptions options = plugged(std::make_shared<Plug>());
  options.decoder = liveDecoder(5e-6);
  options.decoder->input.valuesPerRow = 20;
  LiveSession live(std::move(options));
  ASSERT_TRUE(waitForFrames(live, 3));
  EXPECT_NE(live.status().decoderProblem.find("20 column-wires"), std::string::npos);
}

TEST(LiveSession, ComesBackWithItsTareAfterAnUnplug) {
  auto plug = std::make_shared<Plug>();
  LiveOptions options = plugged(plug);
  options.decoder = liveDecoder(5e-6);
  options.tareFrames = 2;
  LiveSession live(std::move(options));
  ASSERT_TRUE(waitFor(live, [](const LiveStatus& status) { return status.tared; }));
  plug->in = false;
  ASSERT_TRUE(waitForState(live, LiveState::Searching));
  EXPECT_EQ(live.status().reason, "pulled out");
  plug->in = true;
  ASSERT_TRUE(waitForState(live, LiveState::Streaming));
  EXPECT_TRUE(live.status().tared);
  EXPECT_EQ(live.status().connections, 2U);
  EXPECT_EQ(live.status().counts.lost, 0U); // a restart is no loss
}

TEST(LiveSession, TellsASilentBoard) {
  auto plug = std::make_shared<Plug>();
  LiveSession live(plugged(plug));
  ASSERT_TRUE(waitForFrames(live, 2));
  plug->silent = true;
  ASSERT_TRUE(waitForState(live, LiveState::Stalled));
  EXPECT_NE(live.status().reason.find("no report received"), std::string::npos);
  plug->silent = false;
  EXPECT_TRUE(waitForState(live, LiveState::Streaming));
}

TEST(LiveSession, TriesAgainWhereABoardIsRefused) {
  auto plug = std::make_shared<Plug>();
  plug->refused = true;
  LiveSession live(plugged(plug));
  ASSERT_TRUE(waitForState(live, LiveState::Refused));
  EXPECT_EQ(live.status().reason, "no permission");
  plug->refused = false;
  EXPECT_TRUE(waitForState(live, LiveState::Streaming));
}

TEST(LiveSession, ForgetsARefusalWhenTheBoardIsGone) {
  auto plug = std::make_shared<Plug>();
  plug->refused = true;
  LiveSession live(plugged(plug));
  ASSERT_TRUE(waitForState(live, LiveState::Refused));
  plug->in = plug->refused = false;
  ASSERT_TRUE(waitForState(live, LiveState::Searching));
  EXPECT_EQ(live.status().reason, "");
}

TEST(LiveSession, LeavesABoardOfAnotherProtocolAloneUntilItIsGone) {
  auto plug = std::make_shared<Plug>();
  auto foreign = std::make_shared<std::atomic<bool>>(true);
  auto opened = std::make_shared<std::atomic<int>>(0);
  LiveOptions options;
  options.open = [=]() -> std::unique_ptr<ReportSource> {
    ++*opened;
    if (!plug->in) return nullptr;
    VirtualBoard board = paperBoard();
    board.faults().wrongMajorEvery = *foreign ? 30 : 0;
    return std::make_unique<PluggedSource>(std::move(board), plug);
  };
  LiveSession live(std::move(options));
  ASSERT_TRUE(waitForState(live, LiveState::Refused));
  const int before = *opened;
  ASSERT_TRUE(waitFor(live, [&](const LiveStatus&) { return *opened >= before + 2; })); // looked for twice more
  EXPECT_EQ(live.status().state, LiveState::Refused);
  EXPECT_NE(live.status().reason.find("another protocol"), std::string::npos);
  EXPECT_EQ(live.status().connections, 1U);
  plug->in = false;
  ASSERT_TRUE(waitForState(live, LiveState::Searching));
  *foreign = false;
  plug->in = true;
  EXPECT_TRUE(waitForState(live, LiveState::Streaming));
}

TEST(LiveSession, StopsAtAnotherProtocolAndSaysSo) {
  LiveOptions options;
  options.reconnect = false;
  options.open = [] {
    VirtualBoard board = paperBoard();
    board.faults().wrongMajorEvery = 30;
    return std::make_unique<SimulatedSource>(std::move(board));
  };
  LiveSession live(std::move(options));
  ASSERT_TRUE(waitForState(live, LiveState::Ended));
  EXPECT_NE(live.status().reason.find("another protocol"), std::string::npos);
}

TEST(LiveSession, FollowsAConfiguration) {
  LiveSession live(plugged(std::make_shared<Plug>()));
  ASSERT_TRUE(waitForFrames(live, 1));
  BoardConfiguration wanted = *live.status().configuration;
  wanted.mode = BoardMode::SingleRow;
  wanted.rowMask = 1U << 4;
  live.configure(wanted);
  ASSERT_TRUE(waitFor(live, [](const LiveStatus& s) { return s.configuration->mode == BoardMode::SingleRow; }));
  live.drain();
  ASSERT_TRUE(waitForFrames(live, live.status().counts.frames + 1)); // what waited in the source was stale, and is past
  const std::uint64_t stale = live.status().counts.stale;
  ASSERT_TRUE(waitForFrames(live, live.status().counts.frames + 5));
  EXPECT_TRUE(live.drain().back()->frame.rowGood(4));
  EXPECT_EQ(live.status().counts.stale, stale);
}

TEST(LiveSession, PausesWithoutCountingALoss) {
  LiveSession live(plugged(std::make_shared<Plug>()));
  ASSERT_TRUE(waitForFrames(live, 2));
  live.pause(true);
  ASSERT_TRUE(waitForState(live, LiveState::Paused));
  const std::uint64_t frames = live.status().counts.frames;
  live.pause(false);
  ASSERT_TRUE(waitForFrames(live, frames + 3));
  EXPECT_EQ(live.status().counts.lost, 0U);
}

/// By a decoder whose forces do not depend on the noise that was measured before the recording began, however long that
/// was.
TEST(LiveSession, RecordingPlaysBackTheSameForces) {
  const TemporaryFolder folder;
  const Decoder decoder = liveDecoder(5e-6, DecoderKind::Linear);
  std::map<double, Eigen::Vector3d> recorded; // by host time of the frame
  {
    LiveOptions options = plugged(std::make_shared<Plug>());
    options.decoder = decoder;
    LiveSession live(std::move(options));
    ASSERT_TRUE(waitForFrames(live, 2));
    live.startRecording(folder / "a", "abc", false);
    live.mark("begin");
    ASSERT_TRUE(waitForFrames(live, 20));
    EXPECT_TRUE(live.status().recording);
    live.stop();
    for (const auto& frame : live.drain()) recorded[frame->frame.hostTime_s] = frame->forces.forces_N.col(0);
  }
  LiveOptions options;
  options.replay = std::make_shared<ReplayControl>();
  options.replay->speed = 0;
  options.reconnect = false;
  options.decoder = decoder;
  auto source =
      std::make_shared<std::unique_ptr<ReportSource>>(std::make_unique<ReplaySource>(folder / "a", options.replay));
  options.open = [source] { return std::move(*source); };
  LiveSession replay(std::move(options));
  ASSERT_TRUE(waitForState(replay, LiveState::Ended));
  int same = 0;
  for (const auto& frame : replay.drain()) {
    if (!frame->forces.valid) continue; // the first and the last may be halves
    ASSERT_TRUE(recorded.contains(frame->frame.hostTime_s));
    EXPECT_EQ(frame->forces.forces_N.col(0), recorded[frame->frame.hostTime_s]); // to the last bit
    EXPECT_EQ(frame->mark, "begin");
    ++same;
  }
  EXPECT_GE(same, 10);
}

TEST(LiveSession, ARecordingOfATaredBoardPlaysBackTheSameForces) {
  const TemporaryFolder folder;
  const Decoder decoder = liveDecoder(5e-6);
  std::map<double, Eigen::Vector3d> recorded; // by host time of the frame
  {
    LiveOptions options = plugged(std::make_shared<Plug>());
    options.decoder = decoder;
    options.tareFrames = 3;
    LiveSession live(std::move(options));
    ASSERT_TRUE(waitFor(live, [](const LiveStatus& status) { return status.tared; }));
    EXPECT_FALSE(live.status().tareOfRecording);
    live.drain();
    live.startRecording(folder / "a", "", false);
    ASSERT_TRUE(waitForFrames(live, live.status().counts.frames + 20));
    live.stop();
    for (const auto& frame : live.drain()) recorded[frame->frame.hostTime_s] = frame->forces.forces_N.col(0);
  }
  LiveOptions options;
  options.replay = std::make_shared<ReplayControl>();
  options.replay->speed = 0;
  options.reconnect = false;
  options.decoder = decoder;
  options.open = [&, control = options.replay] { return std::make_unique<ReplaySource>(folder / "a", control); };
  const std::shared_ptr<ReplayControl> control = options.replay;
  LiveSession replay(std::move(options));
  ASSERT_TRUE(waitForState(replay, LiveState::Ended));
  EXPECT_TRUE(replay.status().tareOfRecording);
  EXPECT_EQ(replay.status().restName, "the tare of the recording");
  int same = 0;
  for (const auto& frame : replay.drain()) {
    if (!frame->forces.valid) continue;
    ASSERT_TRUE(recorded.contains(frame->frame.hostTime_s));
    EXPECT_EQ(frame->forces.forces_N.col(0), recorded[frame->frame.hostTime_s]); // to the last bit
    ++same;
  }
  EXPECT_GE(same, 10);
  replay.clearTare(); // what the user does with it counts more than what stands in the file
  control->seek(0);
  ASSERT_TRUE(waitFor(replay, [](const LiveStatus& status) { return !status.tared; }));
  ASSERT_TRUE(waitForState(replay, LiveState::Ended));
  EXPECT_FALSE(replay.status().tared);
}

TEST(LiveSession, ATareIsTheBoardsWhateverNetworkReadsIt) {
  LiveOptions options = plugged(std::make_shared<Plug>());
  options.decoder = liveDecoder(5e-6);
  options.tareFrames = 2;
  LiveSession live(std::move(options));
  ASSERT_TRUE(waitFor(live, [](const LiveStatus& status) { return status.tared; }));
  const std::shared_ptr<const Tare> tare = live.status().tare;
  ASSERT_TRUE(tare);
  live.clearTare();
  ASSERT_TRUE(waitFor(live, [](const LiveStatus& status) { return !status.tared && !status.tare; }));

  LiveOptions again = plugged(std::make_shared<Plug>());
  again.decoder = liveDecoder(5e-6);
  again.tareOf = [tare](const BoardInfo&) { return tare; };
  LiveSession back(std::move(again));
  ASSERT_TRUE(waitFor(back, [](const LiveStatus& status) { return status.tared; })) << "known from before";
  back.setDecoder(liveDecoder(1e-5), std::nullopt);
  ASSERT_TRUE(waitForFrames(back, back.status().counts.frames + 3));
  EXPECT_TRUE(back.status().tared) << "with another network too";
  EXPECT_EQ(back.status().tare->rest_ohm, tare->rest_ohm);
}

TEST(LiveSession, AnAlarmThatIsSwitchedOffIsOver) {
  LiveOptions options = plugged(std::make_shared<Plug>());
  options.decoder = liveDecoder(5e-6);
  options.alarm = ForceAlarm{ForceQuantity::Fz, AlarmSide::Below, -0.5};
  LiveSession live(std::move(options));
  ASSERT_TRUE(waitFor(live, [](const LiveStatus& status) { return !status.alarm.empty(); }));
  EXPECT_EQ(live.status().alarm.rfind(kAlarmBegins, 0), 0U) << live.status().alarm;
  live.setAlarm({});
  std::string mark;
  const double end_s = hostClock_s() + kPatience_s;
  while (mark != kAlarmOver && hostClock_s() < end_s) {
    for (const auto& frame : live.drain()) mark = frame->mark;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(mark, kAlarmOver);
}

TEST(LiveSession, RefusesToRecordWithoutABoard) {
  const TemporaryFolder folder;
  auto plug = std::make_shared<Plug>();
  plug->in = false;
  LiveSession live(plugged(plug));
  EXPECT_NE(refusal([&] { live.startRecording(folder / "a", "", false); }).find("nothing to record"),
            std::string::npos);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(LiveSession, NeverHoldsMoreFramesThanItsRing) {
  LiveOptions options = plugged(std::make_shared<Plug>());
  options.ringFrames = 3;
  LiveSession live(std::move(options));
  ASSERT_TRUE(waitForFrames(live, 8));
  live.stop();
  EXPECT_EQ(live.drain().size(), 3U);
  EXPECT_EQ(live.status().overflowed, live.status().counts.frames - 3);
}

} // namespace
} // namespace palp
