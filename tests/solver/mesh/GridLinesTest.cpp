#include "solver/mesh/GridLines.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace palp;

namespace {

std::ptrdiff_t indexOf(const std::vector<double>& lines, double x) {
  return std::find(lines.begin(), lines.end(), x) - lines.begin();
}

TEST(GridLines, GoThroughAllStopsInCellsOfTheWantedSizes) {
  const SizeAlong size{3, 0.5, {{0, 0.5}, {10, 0.5}}};
  const std::vector<double> stops{0, 3.7, 10}, lines = gridLines(stops, size);
  for (const double stop : stops) EXPECT_LT(indexOf(lines, stop), std::ssize(lines)) << stop;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i)
    EXPECT_LT(lines[i + 1] - lines[i], 1.5 * size((lines[i] + lines[i + 1]) / 2)) << i;
  EXPECT_TRUE(std::is_sorted(lines.begin(), lines.end()));
}

TEST(GridLines, MeetTheWantedParitiesByAddingLinesOnly) {
  const SizeAlong size{1, 0.5, {}};
  const std::vector<double> borders{0, 3, 5, 9};
  for (const bool odd : {false, true})
    for (const auto& before : {std::vector<double>{0, 3, 5, 9}, {0, 1, 3, 4, 5, 7, 9}, {0, 1, 2, 3, 5, 6, 7, 8, 9}}) {
      std::vector<double> lines = before;
      meetParities(borders, odd, size, lines);
      EXPECT_EQ(indexOf(lines, 3) % 2, odd ? 1 : 0);
      EXPECT_EQ(indexOf(lines, 5) % 2, odd ? 1 : 0);
      EXPECT_EQ(indexOf(lines, 9) % 2, 0);
      EXPECT_EQ(lines.back(), 9);
      EXPECT_TRUE(std::includes(lines.begin(), lines.end(), before.begin(), before.end()));
      EXPECT_LE(lines.size(), before.size() + 3);
    }
}

} // namespace
