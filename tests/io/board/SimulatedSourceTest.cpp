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

TEST(SimulatedSource, ABoardThatIsOpenedAgainIsAsWarmAsItHasBecome) {
  const auto control = std::make_shared<SimulationControl>();
  BoardDisturbance disturbance;
  disturbance.warming_degC = 8;
  disturbance.warmingTime_s = 0.05;
  control->set({}, disturbance);
  RawReport report;
  double warm_degC = 0;
  {
    SimulatedSource source(boardWith(smallBoard()), control);
    while (warm_degC < 2) {
      ASSERT_EQ(source.read(report, kPatience), ReportSource::Outcome::Read);
      warm_degC = source.board().warmth_degC();
    }
  }
  SimulatedSource again(boardWith(smallBoard()), control);
  ASSERT_EQ(again.read(report, kPatience), ReportSource::Outcome::Read);
  EXPECT_GE(again.board().warmth_degC(), warm_degC);
  EXPECT_LE(again.board().warmth_degC(), 8);
  SimulatedSource another(boardWith(smallBoard()), std::make_shared<SimulationControl>());
  ASSERT_EQ(another.read(report, kPatience), ReportSource::Outcome::Read);
  EXPECT_EQ(another.board().warmth_degC(), 0) << "another board is not";
}

TEST(SimulatedSource, WhatIsBrokenIsSoOnEachBoardThatIsOpenedWithTheControl) {
  const auto control = std::make_shared<SimulationControl>();
  BoardFaults faults;
  faults.openRows = {1};
  faults.openColumns = {2};
  faults.dropEvery = 7;
  BoardDisturbance disturbance;
  disturbance.noise = 1e-4;
  disturbance.warming_degC = 3;
  disturbance.hysteresisShare = 0.25;
  control->set(faults, disturbance);
  for (int opened = 0; opened < 3; ++opened) {
    SimulatedSource source(boardWith(smallBoard()), control);
    RawReport report;
    ASSERT_EQ(source.read(report, kPatience), ReportSource::Outcome::Read);
    EXPECT_EQ(source.board().faults().openRows, std::vector<int>{1}) << opened;
    EXPECT_EQ(source.board().faults().openColumns, std::vector<int>{2}) << opened;
    EXPECT_EQ(source.board().faults().dropEvery, 7) << opened;
    EXPECT_EQ(source.board().disturbance().noise, 1e-4) << opened;
    EXPECT_EQ(source.board().disturbance().warming_degC, 3) << opened;
    EXPECT_EQ(source.board().disturbance().hysteresisShare, 0.25) << opened;
  }
}

} // namespace
} // namespace palp
