#include "app/scenes/charts/AxisMarks.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palp {
namespace {

const AxisRoom kWide{.length_px = 800, .letter_px = 7.5, .gap_px = 8};

std::vector<std::string> texts(const AxisMarks& marks) {
  std::vector<std::string> result;
  for (const auto& [at, text] : marks) result.push_back(text);
  return result;
}

TEST(AxisMarks, AreOneTwoFiveWhereThereIsRoom) {
  EXPECT_EQ(texts(axisMarks(0.9, 21, true, kWide)), (std::vector<std::string>{"1", "2", "5", "10", "20"}));
}

TEST(AxisMarks, AreFewerWhereLabelsWouldMeet) {
  AxisRoom narrow = kWide;
  narrow.length_px = 150;
  EXPECT_EQ(texts(axisMarks(0.9, 120, true, kWide)),
            (std::vector<std::string>{"1", "2", "5", "10", "20", "50", "100"}));
  EXPECT_EQ(texts(axisMarks(0.9, 120, true, narrow)), (std::vector<std::string>{"1", "10", "100"}));
}

TEST(AxisMarks, NeverMeetAndNeverVanish) {
  for (const double length : {120.0, 300.0, 460.0, 800.0, 2000.0})
    for (const double low : {1e-9, 3.7e-4, 0.02, 1.0, 950.0})
      for (const double factor : {1.3, 4.0, 7.0, 30.0, 900.0, 1e5, 1e12})
        for (const bool logarithmic : {false, true}) {
          AxisRoom room = kWide;
          room.length_px = length;
          const AxisMarks marks = axisMarks(low, low * factor, logarithmic, room);
          EXPECT_FALSE(marks.empty()) << low << " times " << factor;
          EXPECT_TRUE(labelsFit(marks, low, low * factor, logarithmic, room))
              << low << " times " << factor << " on " << length << " px";
          // A hair outside is allowed, of the axis as it is drawn: a linear one may begin at 0 instead of 1e-9.
          const double hair = 1e-6 * (logarithmic ? low : low * (factor - 1));
          for (const auto& [at, text] : marks) EXPECT_TRUE(at >= low - hair && at <= low * factor * (1 + 1e-6)) << at;
        }
}

TEST(AxisMarks, StandOneLineApartOnAnUprightAxis) {
  const AxisRoom upright{.length_px = 100, .letter_px = 0, .gap_px = 16};
  const AxisMarks marks = axisMarks(0, 1, false, upright);
  ASSERT_GE(marks.size(), 3U);
  for (std::size_t k = 1; k < marks.size(); ++k) EXPECT_GE(100 * (marks[k].first - marks[k - 1].first), 16 - 1e-9);
}

} // namespace
} // namespace palp
