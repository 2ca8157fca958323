#include "io/board/BoardFrame.h"

#include <gtest/gtest.h>

#include <limits>

namespace palp {
namespace {

BoardFrame goodFrame(int rows = 4, int columns = 6) {
  BoardFrame frame;
  frame.rowExpected.assign(static_cast<std::size_t>(rows), true);
  frame.resistances_ohm = Eigen::MatrixXd::Constant(rows, columns, 300);
  frame.state.setConstant(rows, columns, ReadingState::Good);
  return frame;
}

TEST(BoardFrame, CodesAreTheDividerOfTheProtocol) {
  EXPECT_EQ(decodeCode(1 << 23, 1000).resistance_ohm, 1000); // R = reference at half scale
  EXPECT_DOUBLE_EQ(decodeCode(1 << 22, 1000).resistance_ohm, 1000.0 / 3);
  EXPECT_EQ(decodeCode(1 << 23, 1000).state, ReadingState::Good);
}

TEST(BoardFrame, ShortOpenAndNotMeasuredAreStatesAndNoNumbers) {
  EXPECT_EQ(decodeCode(0, 1000).state, ReadingState::Short);
  EXPECT_EQ(decodeCode(0xFFFFFF, 1000).state, ReadingState::Open);
  EXPECT_EQ(decodeCode(0xFFFFFE, 1000).state, ReadingState::NotMeasured);
  EXPECT_EQ(decodeCode(0xFFFFFF, 1000).resistance_ohm, 0);
  EXPECT_EQ(decodeCode(0xFFFFFD, 1000).state, ReadingState::Good); // the largest resistance, near 5.6e9 ohm
}

TEST(BoardFrame, CodesOfResistancesReadBackToHalfAStep) {
  for (const double R : {1.0, 300.0, 1000.0, 1e5}) {
    const double step = 1000 * std::pow(1 + R / 1000, 2) / (1 << 24); // dR of one code
    EXPECT_NEAR(decodeCode(encodeResistance(R, 1000), 1000).resistance_ohm, R, 0.51 * step);
  }
  EXPECT_EQ(encodeResistance(0, 1000), 0U);
  EXPECT_EQ(encodeResistance(std::numeric_limits<double>::infinity(), 1000), 0xFFFFFFU);
  EXPECT_EQ(encodeResistance(1e30, 1000), 0xFFFFFDU);
  EXPECT_EQ(encodeResistance(1e-30, 1000), 1U);
}

TEST(BoardFrame, NothingIsWrongWithAGoodFrame) {
  EXPECT_TRUE(wireFaults(goodFrame()).empty());
  EXPECT_TRUE(goodFrame().rowGood(0));
}

TEST(BoardFrame, AWholeRowOrColumnIsNamedOnce) {
  BoardFrame frame = goodFrame();
  frame.state.row(2).setConstant(ReadingState::Open);
  EXPECT_EQ(wireFaults(frame), std::vector<std::string>{"row-wire 2: open"});
  EXPECT_FALSE(frame.rowGood(2));
  frame = goodFrame();
  frame.state.col(5).setConstant(ReadingState::Short);
  EXPECT_EQ(wireFaults(frame), std::vector<std::string>{"column-wire 5: short"});
}

TEST(BoardFrame, SingleReadingsAreNamedByBothWires) {
  BoardFrame frame = goodFrame();
  frame.state(1, 3) = ReadingState::NotMeasured;
  EXPECT_EQ(wireFaults(frame), std::vector<std::string>{"row-wire 1, column-wire 3: not measured"});
}

TEST(BoardFrame, NeighbouringReadingsAreNamedTogether) {
  BoardFrame frame = goodFrame();
  for (const int column : {1, 2, 3}) frame.state(1, column) = ReadingState::Missing;
  frame.state(1, 4) = ReadingState::Short;
  EXPECT_EQ(wireFaults(frame), (std::vector<std::string>{"row-wire 1, column-wires 1 to 3: no reading received",
                                                         "row-wire 1, column-wire 4: short"}));
}

TEST(BoardFrame, ASensorThatIsNotPluggedInNamesItsRowsOnly) {
  BoardFrame frame = goodFrame(2, 6);
  frame.state.setConstant(ReadingState::Open);
  EXPECT_EQ(wireFaults(frame), (std::vector<std::string>{"row-wire 0: open", "row-wire 1: open"}));
}

TEST(BoardFrame, RowsThatAreNotScannedAreNoFault) {
  BoardFrame frame = goodFrame();
  frame.rowExpected[3] = false;
  frame.state.row(3).setConstant(ReadingState::Missing);
  EXPECT_TRUE(wireFaults(frame).empty());
}

} // namespace
} // namespace palp
