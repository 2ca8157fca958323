#include "io/board/VirtualBoard.h"

#include "model/base/Error.h"
#include "tests/io/board/SmallBoard.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palp {
namespace {

std::vector<BoardFrame> framesOfBoard(const BoardSettings& settings, VirtualBoard& board, std::size_t reports) {
  FrameAssembler assembler(settings.info, board.configuration());
  return framesOf(assembler, reportsOf(board, reports));
}

TEST(Board, AnswersItsFeaturesAndNoOthers) {
  const VirtualBoard board = boardWith(smallBoard());
  EXPECT_EQ(std::get<BoardInfo>(decodeInfo(*board.feature(0x10))), smallBoard().info);
  EXPECT_EQ(std::get<BoardConfiguration>(decodeConfiguration(*board.feature(0x11))), smallBoard().configuration);
  EXPECT_FALSE(board.feature(0x12));
}

TEST(Board, CountsTheGenerationUpAtEachConfiguration) {
  VirtualBoard board = boardWith(smallBoard());
  BoardConfiguration wanted = smallBoard().configuration;
  wanted.rate_Hz = 500;
  EXPECT_TRUE(board.setFeature(encode(wanted)));
  EXPECT_EQ(board.configuration().generation, 1);
  EXPECT_EQ(board.configuration().rate_Hz, 500);
  wanted.rate_Hz = 60000;
  EXPECT_FALSE(board.setFeature(encode(wanted)));
  wanted.rate_Hz = 500;
  wanted.rowMask = 0b11000; // no row of this board
  EXPECT_FALSE(board.setFeature(encode(wanted)));
  wanted.rowMask = 0xFF;
  EXPECT_TRUE(board.setFeature(encode(wanted)));
  EXPECT_EQ(board.configuration().rowMask, 0b111U);
  EXPECT_EQ(board.configuration().generation, 2);
}

TEST(Board, KeepsItsRateOnTheClockThatItIsGiven) {
  for (const int rate_Hz : {300, 1000, 8000}) {
    BoardSettings settings = smallBoard();
    settings.configuration.rate_Hz = rate_Hz;
    VirtualBoard board = boardWith(settings);
    int count = 0;
    for (std::uint64_t clock_us = 5'000'000; clock_us < 7'000'000; clock_us += 777)
      board.advance(clock_us, [&](std::span<const std::uint8_t>) { ++count; });
    EXPECT_NEAR(count, 2 * rate_Hz, 0.01 * rate_Hz); // the last steps of 777 us
  }
}

TEST(Board, StartsStopsAndAnswersWithTheTag) {
  VirtualBoard board = boardWith(smallBoard());
  reportsOf(board, 3);
  ASSERT_TRUE(board.output(encode(BoardCommand{Opcode::Stop, 77, {}})));
  std::vector<Bytes> reports;
  board.advance(10'000'000, [&](std::span<const std::uint8_t> b) { reports.emplace_back(b.begin(), b.end()); });
  ASSERT_EQ(reports.size(), 1U);
  const auto event = std::get<BoardEvent>(decodeInput(reports[0], board.info()));
  EXPECT_EQ(event.tag, 77);
  EXPECT_EQ(event.code, EventCode::Done);
  EXPECT_FALSE(board.nextDue_us());
  board.output(encode(BoardCommand{Opcode::Start, 78, {2000, 0}}));
  EXPECT_EQ(reportsOf(board, 10, 10'000'100).size(), 10U);
  EXPECT_EQ(board.configuration().rate_Hz, 2000);
  EXPECT_FALSE(board.output(std::vector<std::uint8_t>(64)));
}

TEST(Board, RefusesWhatIsNotAmongItsCapabilities) {
  VirtualBoard board = boardWith(smallBoard());
  board.output(encode(BoardCommand{Opcode::Tare, 5, {}}));
  const auto event = std::get<BoardEvent>(decodeInput(reportsOf(board, 1)[0], board.info()));
  EXPECT_EQ(event.code, EventCode::Refused);
  EXPECT_FALSE(event.text.empty());
}

TEST(Board, TestPatternEncodesRowAndColumn) {
  BoardSettings settings = smallBoard();
  settings.configuration.mode = BoardMode::TestPattern;
  VirtualBoard board = boardWith(settings);
  const auto readings = std::get<Readings>(decodeInput(reportsOf(board, 5)[4], board.info()));
  EXPECT_EQ(readings.codes[3], 0x100000U + 0x1000 * 1 + 18); // second report of row-wire 1, fourth reading
}

TEST(Board, TheSameSeedSendsTheSameBytes) {
  BoardSettings settings = smallBoard();
  settings.disturbance.noise = 1e-4;
  VirtualBoard one = boardWith(settings);
  VirtualBoard two = boardWith(settings);
  EXPECT_EQ(reportsOf(one, 100), reportsOf(two, 100));
  settings.seed = 2;
  VirtualBoard three = boardWith(settings);
  EXPECT_NE(reportsOf(one, 100), reportsOf(three, 100));
}

TEST(Board, NoiseHasItsSize) {
  BoardSettings settings = smallBoard();
  settings.disturbance.noise = 1e-4;
  VirtualBoard board = boardWith(settings);
  double squares = 0;
  const auto frames = framesOfBoard(settings, board, 900);
  for (const BoardFrame& frame : frames)
    squares += (frame.resistances_ohm.array() / placeResistances().array() - 1).square().mean();
  // 9600 readings: their rms is known to 1/sqrt(2 * 9600) = 0.7 %; five times that
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(frames.size())), 1e-4, 0.04e-4);
}

TEST(Board, DriftFollowsTheTemperature) {
  BoardSettings settings = smallBoard();
  settings.disturbance.warming_degC = 10;
  settings.disturbance.warmingTime_s = 1;
  settings.disturbance.temperatureCoefficient = 1e-3;
  VirtualBoard board = boardWith(settings);
  const auto frames = framesOfBoard(settings, board, 9000);
  EXPECT_NEAR(*frames.back().temperature_degC, 33, 0.01); // the field's step; exp(-9) of the way is left
  EXPECT_NEAR(frames.back().resistances_ohm(1, 1) / frames.front().resistances_ohm(1, 1), 1.01, 1e-4);
}

TEST(Board, HysteresisKeepsAPartOfThePast) {
  BoardSettings settings = smallBoard();
  settings.disturbance.hysteresisShare = 0.5;
  settings.disturbance.hysteresisWidth = 1e-3;
  Eigen::MatrixXd now = placeResistances();
  VirtualBoard board(settings, [&now](double time_s) -> const Eigen::MatrixXd& {
    now = placeResistances() * (time_s > 0.05 && time_s < 0.1 ? 1.01 : 1.0); // pressed for a while
    return now;
  });
  const auto frames = framesOfBoard(settings, board, 150);
  const double rest = frames.front().resistances_ohm(0, 0);
  // back at rest the play still stands at its width, half of which shows; to a code step
  EXPECT_NEAR(frames.back().resistances_ohm(0, 0) / rest - 1, 0.5e-3, 1e-6);
}

TEST(Board, FaultsOfWiresShowAsSuch) {
  BoardSettings settings = smallBoard();
  settings.faults.openRows = {1};
  settings.faults.shortReadings = {{0, 4}};
  VirtualBoard board = boardWith(settings);
  const auto frames = framesOfBoard(settings, board, 9);
  EXPECT_EQ(wireFaults(frames[0]), (std::vector<std::string>{"row-wire 0, column-wire 4: short", "row-wire 1: open"}));
  board.faults() = {};
  board.faults().openColumns = {7};
  board.faults().excitationFault = true;
  const auto later = framesOfBoard(settings, board, 20).back();
  EXPECT_EQ(wireFaults(later), std::vector<std::string>{"column-wire 7: open"});
  EXPECT_TRUE(later.flags & ReadingFlag::ExcitationFault);
}

TEST(Board, FaultsOfTheLineAreFoundByTheAssembler) {
  BoardSettings settings = smallBoard();
  settings.faults = {{}, {}, {}, false, 47, 71, 89, 113, 127};
  VirtualBoard board = boardWith(settings);
  FrameAssembler assembler(settings.info, settings.configuration);
  framesOf(assembler, reportsOf(board, 5000));
  const ReportCounts& counts = assembler.counts();
  EXPECT_NEAR(static_cast<double>(counts.bad), 5000.0 / 71 + 5000.0 / 113 + 5000.0 / 127, 6);
  EXPECT_GT(counts.lost, counts.bad); // what was bad, and what was never sent
  EXPECT_GT(counts.duplicates, 40U);
  EXPECT_EQ(counts.backwards + counts.restarts, 0U);
}

TEST(Board, RefusesASensorOfOtherSize) {
  const Eigen::MatrixXd resistances = placeResistances(4, 32);
  EXPECT_THROW(VirtualBoard(smallBoard(), [&](double) -> const Eigen::MatrixXd& { return resistances; }), Error);
  BoardSettings settings = smallBoard();
  settings.info.rowWires = 33;
  EXPECT_THROW(boardWith(settings), Error);
}

} // namespace
} // namespace palp
