#include "io/board/replay/ReplayClock.h"

#include "io/board/Protocol.h"
#include "io/board/RecordingWriter.h"
#include "io/board/ReplaySource.h"
#include "tests/io/TemporaryFolder.h"
#include "tests/io/board/SmallBoard.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

/// Reports at 1000/s of which the host got those from the hundredth on `stall_s` late at most, all at once.
void recordStalled(const std::filesystem::path& path, double stall_s, std::size_t count = 4000) {
  VirtualBoard board = boardWith(smallBoard());
  const std::vector<Bytes> reports = reportsOf(board, count);
  RecordingHead head;
  head.info = smallBoard().info;
  head.configuration = smallBoard().configuration;
  RecordingWriter writer(path, head, true);
  for (std::size_t i = 0; i < count; ++i) {
    const double measured_s = 100 + 1e-3 * static_cast<double>(i);
    writer.append(RecordingEntry::Kind::Raw, i < 100 ? measured_s : std::max(measured_s, 100.1 + stall_s), reports[i]);
  }
}

TEST(ReplayClock, WhatAHostGotLateIsPlayedWhenItWasMeasured) {
  const TemporaryFolder folder;
  for (const double stall_s : {0.7, 1.3, 2.9}) {
    recordStalled(folder / "a", stall_s);
    auto control = std::make_shared<ReplayControl>();
    control->speed = 0;
    ReplaySource source(folder / "a", control);
    EXPECT_NEAR(control->length_s, 3.999, 1e-9);
    RawReport report;
    for (const double place_s : {3.5, 0.05, 0.4, 0.1 + 0.5 * stall_s, 0.1 + stall_s, 0.11}) {
      control->seek(place_s);
      ASSERT_EQ(source.read(report, std::chrono::milliseconds(1)), ReportSource::Outcome::Read);
      const auto decoded = decodeInput(report.bytes, smallBoard().info);
      const double measured_s = 1e-6 * (std::get<Readings>(decoded).deviceClock_us - 1000);
      EXPECT_NEAR(measured_s, place_s, 0.023)
          << stall_s; // the board's clock by whole reports, late ones from 0.02 s on
      EXPECT_NEAR(control->position_s, place_s, 0.023) << stall_s;
      EXPECT_NEAR(report.hostTime_s - 100, control->position_s, 1e-9);
    }
  }
}

TEST(ReplayClock, TheTimesOfARecordingNeverGoBackAcrossAStall) {
  const TemporaryFolder folder;
  recordStalled(folder / "a", 1.3);
  auto control = std::make_shared<ReplayControl>();
  control->speed = 0;
  ReplaySource source(folder / "a", control);
  RawReport report;
  double before_s = 0;
  while (source.read(report, std::chrono::milliseconds(1)) == ReportSource::Outcome::Read) {
    EXPECT_GE(report.hostTime_s, before_s);
    if (before_s > 0) {
      EXPECT_LT(report.hostTime_s - before_s, 0.03) << "no gap where the board measured";
    }
    before_s = report.hostTime_s;
  }
}

} // namespace
} // namespace palp
