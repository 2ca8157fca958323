#include "io/board/SimulatedSource.h"

#include "tests/io/board/SmallBoard.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

constexpr auto kPatience = std::chrono::milliseconds(1000);

TEST(SimulatedSource, StreamsWithoutLossInTheBoardsOrder) {
  SimulatedSource source(boardWith(smallBoard()));
  FrameAssembler assembler(source.info(), source.configuration());
  RawReport report;
  for (int i = 0; i < 90; ++i) {
    ASSERT_EQ(source.read(report, kPatience), ReportSource::Outcome::Read);
    assembler.add(report.bytes, report.hostTime_s, [](const BoardFrame&) {});
  }
  EXPECT_EQ(assembler.counts().frames, 10U);
  EXPECT_EQ(assembler.counts().incompleteFrames + assembler.counts().lost, 0U);
}

TEST(SimulatedSource, GivesNothingWhileTheBoardIsStopped) {
  SimulatedSource source(boardWith(smallBoard()));
  RawReport report;
  ASSERT_TRUE(source.send({Opcode::Stop, 1, {}}));
  ASSERT_EQ(source.read(report, kPatience), ReportSource::Outcome::Read); // the answer
  EXPECT_EQ(source.read(report, std::chrono::milliseconds(5)), ReportSource::Outcome::Nothing);
}

TEST(SimulatedSource, CanBeConfigured) {
  SimulatedSource source(boardWith(smallBoard()));
  BoardConfiguration wanted = source.configuration();
  wanted.mode = BoardMode::SingleRow;
  EXPECT_TRUE(source.configure(wanted));
  EXPECT_EQ(source.configuration().mode, BoardMode::SingleRow);
  EXPECT_EQ(source.configuration().generation, 1);
}

} // namespace
} // namespace palp
