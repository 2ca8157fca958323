#include "io/board/FrameAssembler.h"

#include "tests/io/board/SmallBoard.h"

#include <gtest/gtest.h>

#include <random>

namespace palp {
namespace {

constexpr std::size_t kFrameReports = 9; // 3 row-wires, 3 reports each

struct Assembled {
  std::vector<BoardFrame> frames;
  ReportCounts counts;
};

Assembled assemble(const std::vector<Bytes>& reports) {
  FrameAssembler assembler(smallBoard().info, smallBoard().configuration);
  std::vector<BoardFrame> frames = framesOf(assembler, reports);
  return {std::move(frames), assembler.counts()};
}

std::vector<Bytes> smallReports(std::size_t count) {
  VirtualBoard board = boardWith(smallBoard());
  return reportsOf(board, count);
}

Readings readingsOf(const Bytes& report) {
  return std::get<Readings>(decodeInput(report, smallBoard().info));
}

template <class Change> void change(Bytes& report, Change&& how) {
  Readings readings = readingsOf(report);
  how(readings);
  const Report encoded = encode(readings);
  report.assign(encoded.begin(), encoded.end());
}

TEST(FrameAssembler, PutsEveryReadingInItsPlace) {
  const auto [frames, counts] = assemble(smallReports(5 * kFrameReports));
  ASSERT_EQ(frames.size(), 5U);
  for (const BoardFrame& frame : frames) {
    EXPECT_TRUE(frame.complete);
    EXPECT_TRUE((frame.state.array() == ReadingState::Good).all());
    // half a code step at 300 ohm of a 300 ohm reference
    EXPECT_LT((frame.resistances_ohm - placeResistances()).cwiseAbs().maxCoeff(), 300 * 4.0 / (1 << 24));
  }
  EXPECT_EQ(frames[4].number, 4);
  EXPECT_NEAR(frames[1].time_s - frames[0].time_s, 9e-3, 1e-9); // 9 reports at 1000/s
  EXPECT_EQ(counts.frames, 5U);
  EXPECT_EQ(counts.lost + counts.bad + counts.duplicates + counts.backwards + counts.incompleteFrames, 0U);
}

TEST(FrameAssembler, AMissingReportMakesTheFrameIncompleteAndCounts) {
  for (std::size_t missing = 0; missing < kFrameReports; ++missing) {
    std::vector<Bytes> reports = smallReports(3 * kFrameReports);
    reports.erase(reports.begin() + static_cast<std::ptrdiff_t>(kFrameReports + missing));
    const auto [frames, counts] = assemble(reports);
    ASSERT_EQ(frames.size(), 3U);
    EXPECT_TRUE(frames[0].complete);
    EXPECT_FALSE(frames[1].complete);
    EXPECT_TRUE(frames[2].complete);
    EXPECT_TRUE((frames[1].state.array() == ReadingState::Missing).any()); // nothing is filled in
    EXPECT_FALSE(wireFaults(frames[1]).empty());
    EXPECT_EQ(counts.lost, 1U);
    EXPECT_EQ(counts.incompleteFrames, 1U);
  }
}

TEST(FrameAssembler, HalvesOfTwoScansAreNeverMixed) {
  std::vector<Bytes> reports = smallReports(2 * kFrameReports);
  reports.erase(reports.begin() + 5, reports.begin() + static_cast<std::ptrdiff_t>(kFrameReports) + 5);
  const auto [frames, counts] = assemble(reports); // first half of frame 0, second half of frame 1
  EXPECT_EQ(counts.lost, kFrameReports);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_FALSE(frames[0].complete);
  EXPECT_EQ(frames[0].number, 0);
  EXPECT_EQ((frames[0].state.array() == ReadingState::Good).count(), 32 + 15 + 15);
}

TEST(FrameAssembler, BadReportsAreCountedAndDropped) {
  std::vector<Bytes> reports = smallReports(2 * kFrameReports);
  reports[3][30] ^= 1;        // checksum
  reports[12].resize(40);     // length
  reports[14].resize(100, 7); // length
  const auto [frames, counts] = assemble(reports);
  EXPECT_EQ(counts.bad, 3U);
  EXPECT_EQ(counts.reports, 2 * kFrameReports);
  EXPECT_EQ(counts.lost, 3U); // what was bad is missing in the sequence too
  EXPECT_TRUE(std::none_of(frames.begin(), frames.end(), [](const BoardFrame& f) { return f.complete; }));
}

TEST(FrameAssembler, DuplicatesAndLateReportsAreDropped) {
  std::vector<Bytes> reports = smallReports(2 * kFrameReports);
  reports.insert(reports.begin() + 4, reports[3]); // the same again
  reports.insert(reports.begin() + 9, reports[5]); // three late
  const auto [frames, counts] = assemble(reports);
  EXPECT_EQ(counts.duplicates, 1U);
  EXPECT_EQ(counts.backwards, 1U);
  EXPECT_EQ(counts.lost, 0U);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_TRUE(frames[0].complete && frames[1].complete);
}

TEST(FrameAssembler, TheSequenceMayWrap) {
  std::vector<Bytes> reports = smallReports(3 * kFrameReports);
  for (Bytes& report : reports)
    change(report, [](Readings& r) { r.sequence = static_cast<std::uint16_t>(r.sequence + 0xFFF5); });
  const auto [frames, counts] = assemble(reports);
  EXPECT_EQ(counts.lost + counts.backwards + counts.restarts, 0U);
  EXPECT_EQ(frames.size(), 3U);
}

TEST(FrameAssembler, TheFrameCounterMayWrap) {
  std::vector<Bytes> reports = smallReports(3 * kFrameReports);
  for (Bytes& report : reports)
    change(report, [](Readings& r) { r.frame = static_cast<std::uint16_t>(r.frame + 0xFFFF); });
  const auto [frames, counts] = assemble(reports);
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0].number, 0xFFFF);
  EXPECT_EQ(frames[1].number, 0);
  EXPECT_EQ(counts.incompleteFrames, 0U);
}

TEST(FrameAssembler, TheClockMayWrap) {
  std::vector<Bytes> reports = smallReports(3 * kFrameReports);
  for (Bytes& report : reports) change(report, [](Readings& r) { r.deviceClock_us += 0xFFFFFFFF - 12'345; });
  const auto [frames, counts] = assemble(reports);
  EXPECT_EQ(counts.restarts, 0U);
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_NEAR(frames[2].time_s - frames[0].time_s, 18e-3, 1e-9);
}

TEST(FrameAssembler, ARestartOfTheBoardIsNoLossAndBreaksTheFrame) {
  VirtualBoard board = boardWith(smallBoard());
  std::vector<Bytes> reports = reportsOf(board, 12 * kFrameReports + 4); // more than can be late
  board.restart();
  for (const Bytes& report : reportsOf(board, 2 * kFrameReports)) reports.push_back(report);
  const auto [frames, counts] = assemble(reports);
  EXPECT_EQ(counts.restarts, 1U);
  EXPECT_EQ(counts.lost, 0U);
  ASSERT_EQ(frames.size(), 14U);
  EXPECT_TRUE(frames[12].restarted);
  EXPECT_TRUE(frames[12].complete);
  EXPECT_FALSE(frames[13].restarted);
  for (std::size_t i = 1; i < frames.size(); ++i) EXPECT_GT(frames[i].time_s, frames[i - 1].time_s);
}

TEST(FrameAssembler, AFrameThatIsJoinedInItsMiddleIsLeftOut) {
  for (std::size_t first = 0; first <= kFrameReports; ++first) {
    std::vector<Bytes> reports = smallReports(4 * kFrameReports);
    reports.erase(reports.begin(), reports.begin() + static_cast<std::ptrdiff_t>(first));
    FrameAssembler assembler(smallBoard().info, smallBoard().configuration);
    assembler.restart();
    const std::vector<BoardFrame> frames = framesOf(assembler, reports);
    ASSERT_EQ(frames.size(), first == 0 ? 4U : 3U) << first;
    EXPECT_EQ(frames[0].number, first == 0 ? 0 : 1) << first;
    EXPECT_TRUE(frames[0].complete) << first;
    EXPECT_EQ(assembler.counts().incompleteFrames + assembler.counts().lost, 0U) << first;
  }
}

TEST(FrameAssembler, SingleRowModeMakesAFrameOfEachRow) {
  BoardSettings settings = smallBoard();
  settings.configuration.mode = BoardMode::SingleRow;
  settings.configuration.rowMask = 0b110;
  VirtualBoard board = boardWith(settings);
  FrameAssembler assembler(settings.info, settings.configuration);
  const std::vector<BoardFrame> frames = framesOf(assembler, reportsOf(board, 30));
  ASSERT_EQ(frames.size(), 10U);
  for (const BoardFrame& frame : frames) {
    EXPECT_TRUE(frame.complete);
    EXPECT_EQ(frame.rowExpected, (std::vector<bool>{false, true, false}));
    EXPECT_TRUE(frame.rowGood(1));
    EXPECT_EQ(frame.state(0, 0), ReadingState::Missing);
    EXPECT_TRUE(wireFaults(frame).empty());
  }
}

TEST(FrameAssembler, OnlyTheRowsOfTheMaskAreExpected) {
  BoardSettings settings = smallBoard();
  settings.configuration.rowMask = 0b101;
  VirtualBoard board = boardWith(settings);
  FrameAssembler assembler(settings.info, settings.configuration);
  const std::vector<BoardFrame> frames = framesOf(assembler, reportsOf(board, 12));
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_TRUE(frames[1].complete && frames[1].rowGood(2));
}

TEST(FrameAssembler, ReportsOfAnotherConfigurationAreStale) {
  VirtualBoard board = boardWith(smallBoard());
  FrameAssembler assembler(smallBoard().info, smallBoard().configuration);
  BoardConfiguration changed = smallBoard().configuration;
  changed.rowMask = 0b001;
  ASSERT_TRUE(board.setFeature(encode(changed)));
  const std::vector<Bytes> reports = reportsOf(board, 12);
  EXPECT_TRUE(framesOf(assembler, reports).empty());
  EXPECT_EQ(assembler.counts().stale, 12U);
  EXPECT_EQ(assembler.staleInARow(), 12);
  EXPECT_EQ(assembler.counts().lost, 0U);
  assembler.setConfiguration(board.configuration()); // now it is known
  EXPECT_EQ(framesOf(assembler, reportsOf(board, 6, 100'000)).size(), 2U);
  EXPECT_EQ(assembler.staleInARow(), 0);
}

TEST(FrameAssembler, FlagsAndTemperatureOfAllReportsGoIntoTheFrame) {
  std::vector<Bytes> reports = smallReports(kFrameReports);
  change(reports[4], [](Readings& r) { r.flags |= ReadingFlag::AdcOverrun; });
  const auto [frames, counts] = assemble(reports);
  EXPECT_TRUE(frames[0].flags & ReadingFlag::AdcOverrun);
  EXPECT_TRUE(frames[0].flags & ReadingFlag::Simulated);
  EXPECT_NEAR(frames[0].temperature_degC.value_or(0), 23, 1e-9);
}

TEST(FrameAssembler, CompleteFramesAreRightWhateverHappensToTheStream) {
  std::mt19937 engine(11);
  std::vector<Bytes> reports = smallReports(3000);
  std::vector<Bytes> mangled;
  for (const Bytes& report : reports) {
    const auto dice = engine() % 40;
    if (dice == 0) continue; // lost
    mangled.push_back(report);
    if (dice == 1) mangled.push_back(report);
    if (dice == 2) mangled.back()[engine() % 64] ^= static_cast<std::uint8_t>(1 + engine() % 255);
    if (dice == 3) mangled.back().resize(engine() % 100);
    if (dice == 4 && mangled.size() > 9) mangled.push_back(mangled[mangled.size() - 1 - engine() % 8]);
  }
  const auto [frames, counts] = assemble(mangled);
  EXPECT_GT(counts.incompleteFrames, 10U);
  EXPECT_GT(counts.frames - counts.incompleteFrames, 10U);
  for (const BoardFrame& frame : frames) {
    if (!frame.complete) continue;
    EXPECT_LT((frame.resistances_ohm - placeResistances()).cwiseAbs().maxCoeff(), 300 * 4.0 / (1 << 24));
  }
}

} // namespace
} // namespace palp
