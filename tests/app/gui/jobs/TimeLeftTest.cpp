#include "app/gui/jobs/TimeLeft.h"

#include <QStringList>

#include <gtest/gtest.h>

#include <cmath>

namespace palp {
namespace {

TEST(TimeLeft, KnowsNothingBeforeTheFirstStep) {
  TimeLeft left;
  left.begin(0, 3);
  EXPECT_FALSE(left.left_s(0, 100, 9).has_value());
  EXPECT_EQ(leftInWords(std::nullopt), "");
}

TEST(TimeLeft, DoesNotTakeThePreparationForWork) {
  TimeLeft left;
  left.begin(0, 8); // 8 s of meshing
  EXPECT_DOUBLE_EQ(*left.left_s(10, 100, 9), 9);
}

TEST(LeftOfShares, SaysNothingBeforeItCanKnow) {
  const LeftOfShares left;
  for (const double share : {0.0, 0.5, 1.0}) EXPECT_FALSE(left.at(share).has_value()) << "in the first seconds";
}

TEST(TimeLeft, DoesNotTakeAPauseBetweenForWork) {
  TimeLeft left;
  left.begin(0, 0);
  left.pause(50, 5);
  left.begin(50, 105);
  EXPECT_DOUBLE_EQ(*left.left_s(60, 100, 106), 4);
}

TEST(TimeLeft, WhatWasDoneBeforeAStopTellsNothingOfTheTime) {
  TimeLeft left;
  left.begin(90, 0);
  EXPECT_FALSE(left.left_s(90, 100, 1).has_value());
  EXPECT_DOUBLE_EQ(*left.left_s(91, 100, 2), 18);
}

TEST(TimeLeft, IsRightWithinAThirdWhereStepsTakeUnequallyLong) {
  // Steps of 1 to 3 s in waves of 12, after a preparation of 40 s.
  const int all = 120;
  const auto step_s = [](int k) { return 2 + std::sin(2 * 3.14159265358979 * k / 12); };
  double total_s = 40;
  for (int k = 0; k < all; ++k) total_s += step_s(k);
  TimeLeft left;
  left.begin(0, 40);
  double now_s = 40;
  for (int done = 1; done < all; ++done) {
    now_s += step_s(done - 1);
    if (10 * done < all || 10 * done > 9 * all) continue;
    const double truth_s = total_s - now_s;
    EXPECT_NEAR(*left.left_s(done, all, now_s), truth_s, truth_s / 3) << "after " << done << " steps";
  }
}

TEST(TimeLeft, WordsAreAtMostASixthAwayFromTheNumber) {
  for (double seconds = 4; seconds < 7200; seconds *= 1.01) {
    const QStringList words = roughly(seconds).split(' ');
    ASSERT_EQ(words.size(), 2);
    const double said = words[0].toDouble() * (words[1] == "min" ? 60 : 1);
    EXPECT_NEAR(said, seconds, seconds / 6 + 1e-9) << words.join(' ').toStdString();
  }
  EXPECT_EQ(roughly(0.01), "1 s");
  EXPECT_EQ(leftInWords(100), ", about 1.5 min left");
}

} // namespace
} // namespace palp
