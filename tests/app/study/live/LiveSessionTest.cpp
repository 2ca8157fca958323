#include "app/study/live/LiveSession.h"

#include "app/study/live/BoardCheck.h"
#include "app/study/live/BoardWatch.h"
#include "io/board/SimulatedSource.h"
#include "tests/app/study/live/LiveFixture.h"
#include "tests/io/Refusal.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <array>
#include <ostream>

namespace palp {
namespace {

constexpr double kPatience_s = 10;

VirtualBoard paperBoard(int rate_Hz = 1000) {
  return simulatedBoard(shippedSamples(), {}, rate_Hz, 3);
}

/// A board that can be pulled out, silenced or refused from the test.
struct Plug {
  std::atomic<bool> in{true}, silent{false}, refused{false};
};

class PluggedSource : public SimulatedSource {
public:
  PluggedSource(VirtualBoard board, std::shared_ptr<Plug> plug)
      : SimulatedSource(std::move(board)), plug_(std::move(plug)) {}
  Outcome read(RawReport& report, std::chrono::milliseconds timeout) override {
    if (!plug_->in) return Outcome::Gone;
    if (!plug_->silent) return SimulatedSource::read(report, timeout);
    std::this_thread::sleep_for(timeout / 10);
    return Outcome::Nothing;
  }
  [[nodiscard]] std::string reason() const override { return "pulled out"; }

private:
  std::shared_ptr<Plug> plug_;
};

LiveOptions plugged(const std::shared_ptr<Plug>& plug) {
  LiveOptions options;
  options.open = [plug]() -> std::unique_ptr<ReportSource> {
    if (plug->refused) throw BoardPermissionError("no permission");
    if (!plug->in) return nullptr;
    return std::make_unique<PluggedSource>(paperBoard(), plug);
  };
  return options;
}

template <class Condition> bool waitFor(const LiveSession& live, const Condition& condition) {
  const double end_s = hostClock_s() + kPatience_s;
  while (hostClock_s() < end_s) {
    if (condition(live.status())) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

bool waitForState(const LiveSession& live, LiveState state) {
  return waitFor(live, [state](const LiveStatus& status) { return status.state == state; });
}

bool waitForFrames(const LiveSession& live, std::uint64_t frames) {
  return waitFor(live, [frames](const LiveStatus& status) { return status.counts.frames >= frames; });
}

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
  EXPECT_NE(live.status().reason.find("nothing has come"), std::string::npos);
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

/// Where a source fails, and with what.
enum class FailingCall { Open, Name, Info, Configuration, Read, Configure, ReadConfiguration };
enum class Thrown { BoardGone, Refusal, Standard, Foreign };
/// In the names of the tests.
void PrintTo(FailingCall call, std::ostream* out) {
  constexpr std::array words{"open", "name", "info", "configuration", "read", "configure", "readConfiguration"};
  *out << words.at(static_cast<std::size_t>(call));
}
void PrintTo(Thrown thrown, std::ostream* out) {
  constexpr std::array words{"board gone", "refusal", "a standard exception", "a foreign exception"};
  *out << words.at(static_cast<std::size_t>(thrown));
}

/// Throws at one of its calls while it is armed.
struct Trap {
  FailingCall call;
  Thrown thrown;
  std::atomic<bool> armed{false};
  std::atomic<int> sprung{0};

  void at(FailingCall now) {
    if (!armed || now != call) return;
    ++sprung;
    switch (thrown) {
    case Thrown::BoardGone:
      throw BoardError("trapped");
    case Thrown::Refusal:
      throw Error("trapped");
    case Thrown::Standard:
      throw std::out_of_range("trapped");
    case Thrown::Foreign:
      throw 7; // NOLINT(hicpp-exception-baseclass): what no handler of a kind catches
    }
  }
};

class TrappedSource : public SimulatedSource {
public:
  explicit TrappedSource(std::shared_ptr<Trap> trap) : SimulatedSource(paperBoard()), trap_(std::move(trap)) {}
  [[nodiscard]] std::string name() const override {
    trap_->at(FailingCall::Name);
    return SimulatedSource::name();
  }
  [[nodiscard]] const BoardInfo& info() const override {
    trap_->at(FailingCall::Info);
    return SimulatedSource::info();
  }
  [[nodiscard]] const BoardConfiguration& configuration() const override {
    trap_->at(FailingCall::Configuration);
    return SimulatedSource::configuration();
  }
  void readConfiguration() override { trap_->at(FailingCall::ReadConfiguration); }
  Outcome read(RawReport& report, std::chrono::milliseconds timeout) override {
    trap_->at(FailingCall::Read);
    if (trap_->armed && trap_->call == FailingCall::ReadConfiguration) { // makes the session read it again
      BoardEvent changed;
      changed.code = EventCode::ConfigurationChanged;
      const Report bytes = encode(changed);
      report = {hostClock_s(), {bytes.begin(), bytes.end()}};
      return Outcome::Read;
    }
    return SimulatedSource::read(report, timeout);
  }
  bool configure(const BoardConfiguration& configuration) override {
    trap_->at(FailingCall::Configure);
    return SimulatedSource::configure(configuration);
  }

private:
  std::shared_ptr<Trap> trap_;
};

class LiveSessionFailure : public testing::TestWithParam<std::tuple<FailingCall, Thrown>> {};

TEST_P(LiveSessionFailure, EndsTheConnectionAndSaysWhyNeverTheProgram) {
  auto trap = std::make_shared<Trap>();
  std::tie(trap->call, trap->thrown) = GetParam();
  const bool opening = trap->call == FailingCall::Open;
  const bool whileConnecting = trap->call <= FailingCall::Configuration;
  trap->armed = whileConnecting;
  LiveOptions options;
  options.open = [trap] {
    trap->at(FailingCall::Open);
    return std::make_unique<TrappedSource>(trap);
  };
  LiveSession live(std::move(options));
  if (!whileConnecting) {
    ASSERT_TRUE(waitForFrames(live, 2));
    trap->armed = true;
    BoardConfiguration wanted = *live.status().configuration;
    wanted.rate_Hz = 500;
    live.configure(wanted);
  }
  const auto words = [&](const LiveStatus& now) { return opening ? now.reason : now.lastEvent; };
  ASSERT_TRUE(waitFor(live, [&](const LiveStatus& now) { return trap->sprung > 0 && !words(now).empty(); }));
  const std::string why = words(live.status());
  EXPECT_NE(why.find(trap->thrown == Thrown::Foreign ? "internal error" : "trapped"), std::string::npos) << why;
  trap->armed = false;
  EXPECT_TRUE(waitForState(live, LiveState::Streaming)); // and goes on when all is well again
}

INSTANTIATE_TEST_SUITE_P(AtEachCall, LiveSessionFailure,
                         testing::Combine(testing::Values(FailingCall::Open, FailingCall::Name, FailingCall::Info,
                                                          FailingCall::Configuration, FailingCall::Read,
                                                          FailingCall::Configure, FailingCall::ReadConfiguration),
                                          testing::Values(Thrown::BoardGone, Thrown::Refusal, Thrown::Standard,
                                                          Thrown::Foreign)));

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

TEST(BoardWatch, SeesABoardThatIsPluggedInWhileAnotherStreams) {
  std::mutex mutex;
  std::vector<HidBoard> boards{{"/dev/hidraw0", "A", "", true}};
  std::atomic<int> lists{0};
  BoardAccess access;
  access.list = [&] {
    ++lists;
    const std::lock_guard lock(mutex);
    return boards;
  };
  access.nodes = [&] {
    const std::lock_guard lock(mutex);
    std::vector<std::string> names;
    for (const HidBoard& board : boards) names.push_back(board.path);
    return names;
  };
  BoardWatch watch(access);
  const auto until = [](const auto& condition) {
    while (!condition()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  };
  until([&] { return watch.looked(); });
  watch.setQuiet(true);
  {
    const std::lock_guard lock(mutex);
    boards.push_back({"/dev/hidraw1", "B", "", true});
  }
  until([&] { return watch.boards().size() == 2; });
  const int before = lists;
  std::this_thread::sleep_for(std::chrono::milliseconds(1500)); // longer than it is between two looks at the devices
  EXPECT_EQ(lists, before) << "a board that streams is disturbed though nothing has changed";
}

TEST(BoardWatch, SaysWhyALookFailedAndLooksAgain) {
  auto broken = std::make_shared<std::atomic<bool>>(true);
  BoardAccess access;
  access.list = [broken]() -> std::vector<HidBoard> {
    if (*broken) throw std::runtime_error("no list");
    return {{"/dev/hidraw0", "A", "", true}};
  };
  const BoardWatch watch(access);
  const auto waitUntil = [](const auto& condition) {
    const double end_s = hostClock_s() + kPatience_s;
    while (!condition() && hostClock_s() < end_s) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return condition();
  };
  ASSERT_TRUE(waitUntil([&] { return watch.looked(); }));
  EXPECT_NE(watch.problem().find("no list"), std::string::npos);
  *broken = false;
  EXPECT_TRUE(waitUntil([&] { return watch.boards().size() == 1; }));
  EXPECT_EQ(watch.problem(), "");
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

TEST(LiveSession, RecordingPlaysBackTheSameForces) {
  const TemporaryFolder folder;
  const Decoder decoder = liveDecoder(5e-6);
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

TEST(BoardCheck, PassesAGoodBoardAndFindsABadOne) {
  for (const int corruptEvery : {0, 50}) {
    LiveOptions options;
    options.reconnect = false;
    options.open = [corruptEvery] {
      VirtualBoard board = paperBoard();
      board.faults().corruptEvery = corruptEvery;
      return std::make_unique<SimulatedSource>(std::move(board));
    };
    LiveSession live(std::move(options));
    ASSERT_TRUE(waitFor(live, [](const LiveStatus& status) { return status.counts.reports >= 500; }));
    live.stop();
    const LiveStatus status = live.status();
    const std::vector<std::uint8_t> descriptor(reportDescriptor().begin(), reportDescriptor().end());
    const auto results = checkBoard(status, static_cast<double>(status.counts.reports) / 1000, descriptor);
    EXPECT_EQ(std::all_of(results.begin(), results.end(), [](const auto& result) { return result.passed; }),
              corruptEvery == 0);
  }
}

} // namespace
} // namespace palp
