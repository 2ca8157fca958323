#include "solver/element/ElementKernels.h"

#include <gtest/gtest.h>

#include <set>

namespace palp {
namespace {

TEST(LaneIndex, PutsEightElementsSideBySide) {
  EXPECT_EQ(laneIndex(0, 5, 0), 0U);
  EXPECT_EQ(laneIndex(7, 5, 0), 7U);              // the same number of the next elements of a block
  EXPECT_EQ(laneIndex(0, 5, 1), 8U);              // the next number of the first element
  EXPECT_EQ(laneIndex(9, 5, 2), 5U * 8 + 16 + 1); // block 1, number 2, lane 1
}

TEST(LaneIndex, HasAPlaceForEveryNumberAndNoneForTwo) {
  constexpr std::size_t elements = 24, size = 7;
  std::set<std::size_t> places;
  for (std::size_t e = 0; e < elements; ++e)
    for (std::size_t item = 0; item < size; ++item) places.insert(laneIndex(e, size, item));
  EXPECT_EQ(places.size(), elements * size);
  EXPECT_EQ(*places.rbegin(), elements * size - 1);
}

// Loads on elements, [elements][blocks of loads][size][8].
TEST(LaneIndex, NumbersTheLoadsOfOneElementBlockAfterBlock) {
  constexpr std::size_t loads = 32, size = 7, element = 3, load = 13, item = 4;
  EXPECT_EQ(laneIndex(element * loads + load, size, item),
            ((element * (loads / lanes) + load / lanes) * size + item) * lanes + load % lanes);
}

} // namespace
} // namespace palp
