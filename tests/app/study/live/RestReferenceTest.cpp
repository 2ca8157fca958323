#include "app/study/live/RestReference.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palp {
namespace {

BoardFrame readings(double value) {
  BoardFrame frame;
  frame.resistances_ohm = Eigen::MatrixXd::Constant(2, 3, value);
  frame.state.setConstant(2, 3, ReadingState::Good);
  return frame;
}

TEST(RestReference, CountsFromTheTareElseTheDesignElseTheFirstFrame) {
  RestReference rest;
  rest.add(readings(100));
  EXPECT_NEAR(rest.change(readings(101))(0, 0), 0.01, 1e-12);
  rest.reset(Eigen::MatrixXd::Constant(2, 3, 202));
  EXPECT_NEAR(rest.change(readings(101))(1, 2), -0.5, 1e-12);
  rest.startTare(2);
  rest.add(readings(50));
  rest.add(readings(60));
  EXPECT_STREQ(rest.name(), "the tared frames");
  EXPECT_NEAR(rest.change(readings(110))(0, 1), 1, 1e-12);
  rest.clearTare();
  EXPECT_STREQ(rest.name(), "the design at rest");
}

TEST(RestReference, GivesNoNumberForABadReadingAndTaresAroundIt) {
  RestReference rest;
  BoardFrame bad = readings(100);
  bad.state(1, 1) = ReadingState::Open;
  bad.resistances_ohm(1, 1) = 0;
  rest.startTare(2);
  rest.add(bad);
  rest.add(readings(200));
  EXPECT_TRUE(std::isnan(rest.change(bad)(1, 1)));
  EXPECT_NEAR(rest.change(readings(150))(0, 0), 0, 1e-12);
  EXPECT_NEAR(rest.change(readings(200))(1, 1), 0, 1e-12); // of the one frame that held it
}

TEST(RestReference, AveragesTheTareOverTheFramesAskedForAndNoMore) {
  RestReference rest;
  rest.startTare(2);
  rest.add(readings(100));
  EXPECT_STREQ(rest.name(), "the first frame"); // not yet
  rest.add(readings(200));
  rest.add(readings(900)); // too late to count
  EXPECT_NEAR(rest.change(readings(300))(0, 0), 1, 1e-12);
}

TEST(RestReference, BeginsTheTareAnewWhereItIsAskedAgain) {
  RestReference rest;
  rest.startTare(2);
  rest.add(readings(100));
  rest.startTare(1);
  rest.add(readings(200));
  EXPECT_NEAR(rest.change(readings(200))(0, 0), 0, 1e-12);
}

TEST(RestReference, TakesTheFirstGoodReadingOfEachWireWhereNothingElseIsKnown) {
  RestReference rest;
  BoardFrame first = readings(100);
  first.state(0, 2) = ReadingState::NotMeasured;
  rest.add(first);
  EXPECT_TRUE(std::isnan(rest.change(readings(110))(0, 2)));
  rest.add(readings(110));
  EXPECT_NEAR(rest.change(readings(110))(0, 0), 0.1, 1e-12); // of the first frame
  EXPECT_NEAR(rest.change(readings(110))(0, 2), 0, 1e-12);   // of the second
}

TEST(RestReference, GivesNoNumberWhereTheTareNeverSawTheWire) {
  RestReference rest;
  BoardFrame bad = readings(100);
  bad.state(1, 0) = ReadingState::Short;
  rest.startTare(1);
  rest.add(bad);
  EXPECT_TRUE(std::isnan(rest.change(readings(100))(1, 0)));
  EXPECT_NEAR(rest.change(readings(100))(0, 0), 0, 1e-12);
}

TEST(RestReference, PassesOverARestOfAnotherSize) {
  RestReference rest;
  rest.reset(Eigen::MatrixXd::Constant(5, 5, 100));
  EXPECT_TRUE(std::isnan(rest.change(readings(100))(0, 0))); // nothing has come yet
  rest.add(readings(100));
  EXPECT_NEAR(rest.change(readings(150))(0, 0), 0.5, 1e-12);
}

} // namespace
} // namespace palp
