// A recording in a live session: each of its frames is seen, whatever changed in it and however fast it is played.

#include "io/board/RecordingReader.h"
#include "io/board/RecordingWriter.h"
#include "tests/app/study/live/PluggedBoard.h"
#include "tests/io/TemporaryFolder.h"
#include "tests/io/board/SmallBoard.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

constexpr int kReportsOfEach = 180;

/// All rows, one alone, all at another rate, two rows: 20, 60, 20 and 30 frames within a tenth of a second or so.
void recordChanges(const std::filesystem::path& path) {
  BoardSettings settings = smallBoard();
  RecordingWriter writer(path, {settings.info, settings.configuration, "SMALL-1", "", 1}, true);
  double time_s = 100;
  for (const auto& [mode, rowMask, rate_Hz] :
       {std::tuple{BoardMode::Stream, 0b111U, 8000}, std::tuple{BoardMode::SingleRow, 0b10U, 8000},
        std::tuple{BoardMode::Stream, 0b111U, 4000}, std::tuple{BoardMode::Stream, 0b101U, 4000}}) {
    settings.configuration.mode = mode;
    settings.configuration.rowMask = rowMask;
    settings.configuration.rate_Hz = rate_Hz;
    VirtualBoard board = boardWith(settings);
    writer.append(RecordingEntry::Kind::Configuration, time_s, encode(settings.configuration));
    for (const Bytes& report : reportsOf(board, kReportsOfEach, static_cast<std::uint64_t>(1e6 * (time_s - 99))))
      writer.append(RecordingEntry::Kind::Raw, time_s += 1.0 / rate_Hz, report);
    ++settings.configuration.generation;
  }
}

TEST(ReplayedLiveSession, EveryFrameIsSeenAtAnySpeedAlsoByAReaderThatIsLate) {
  const TemporaryFolder folder;
  recordChanges(folder / "a");
  for (const double speed : {0.0, 1.0, 100.0}) {
    LiveOptions options;
    options.replay = std::make_shared<ReplayControl>();
    options.replay->speed = speed;
    options.reconnect = false;
    options.ringFrames = 4; // the reader is always late
    options.waitForReader = true;
    options.open = [&, control = options.replay] { return std::make_unique<ReplaySource>(folder / "a", control); };
    LiveSession live(std::move(options));
    std::size_t whole = 0, all = 0;
    const auto look = [&] {
      for (const auto& frame : live.drain()) {
        ++all;
        whole += frame->frame.complete;
      }
    };
    ASSERT_TRUE(waitFor(live, [&](const LiveStatus& status) {
      look();
      return status.state == LiveState::Ended;
    })) << speed;
    look();
    EXPECT_EQ(all, 130U) << speed;
    EXPECT_EQ(whole, 130U) << speed;
    EXPECT_EQ(live.status().counts.stale, 0U) << speed;
    EXPECT_EQ(live.status().overflowed, 0U) << speed;
  }
}

TEST(ReplayedLiveSession, APlaceBehindAChangeIsShownThere) {
  const TemporaryFolder folder;
  recordChanges(folder / "a");
  LiveOptions options;
  auto control = options.replay = std::make_shared<ReplayControl>();
  options.reconnect = false;
  control->paused = true;
  options.open = [&, control] { return std::make_unique<ReplaySource>(folder / "a", control); };
  LiveSession live(std::move(options));
  ASSERT_TRUE(waitForState(live, LiveState::Paused));
  control->seek(0.08); // in the third part
  std::vector<std::shared_ptr<const LiveFrame>> seen;
  ASSERT_TRUE(waitFor(live, [&](const LiveStatus&) {
    for (auto& frame : live.drain()) seen.push_back(std::move(frame));
    return !seen.empty();
  }));
  EXPECT_NEAR(seen.front()->frame.hostTime_s - 100, 0.083, 0.004);
  EXPECT_TRUE(seen.front()->frame.complete);
}

TEST(ReplayedLiveSession, ACopyOfWhatIsPlayedHasItsTimesAndItsChanges) {
  const TemporaryFolder folder;
  recordChanges(folder / "a");
  LiveOptions options;
  options.replay = std::make_shared<ReplayControl>();
  options.replay->speed = 0;
  options.reconnect = false;
  options.waitForRecording = true;
  options.open = [&, control = options.replay] { return std::make_unique<ReplaySource>(folder / "a", control); };
  LiveSession live(std::move(options));
  ASSERT_TRUE(waitForState(live, LiveState::Streaming));
  live.startRecording(folder / "b", "", false);
  ASSERT_TRUE(waitForState(live, LiveState::Ended));
  live.stop();
  EXPECT_EQ(live.status().recordedReports, 4U * kReportsOfEach) << "also those of the last half second";
  std::size_t changes = 0;
  double before_s = 0;
  RecordingReader reader(folder / "b");
  for (RecordingEntry entry; reader.next(entry); before_s = entry.hostTime_s) {
    EXPECT_GE(entry.hostTime_s, before_s);
    EXPECT_LT(entry.hostTime_s, 101);
    changes += entry.kind == RecordingEntry::Kind::Configuration;
  }
  EXPECT_GE(changes, 4U);
}

} // namespace
} // namespace palp
