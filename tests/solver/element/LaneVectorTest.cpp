#include "solver/element/LaneVector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <unistd.h>

namespace palp {
namespace {

/// Memory of this process that is in use [bytes].
double resident() {
  double total = 0, pages = 0;
  std::ifstream("/proc/self/statm") >> total >> pages;
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

TEST(LaneVector, LiesOnCacheLinesAtAnySize) {
  for (std::size_t size : {1, 1000, 130'000, 131'072, 1'000'000}) {
    const LaneVector vector(size);
    const UnsetArray<double> array(size);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(vector.data()) % 64, 0) << size;
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.data()) % 64, 0) << size;
  }
}

TEST(LaneVector, GivesLargeMemoryBackToTheSystem) {
  const double before = resident(), bytes = 64e6;
  UnsetArray<double> array(static_cast<std::size_t>(bytes) / sizeof(double));
  std::fill_n(array.data(), array.size(), 1.);
  EXPECT_GT(resident(), before + 0.9 * bytes);
  array = {};
  EXPECT_EQ(array.size(), 0);
#ifdef __SANITIZE_ADDRESS__
  constexpr double shadow = 1. / 8; // of the array, which the sanitizer keeps
#else
  constexpr double shadow = 0;
#endif
  EXPECT_LT(resident(), before + (0.1 + shadow) * bytes);
}

TEST(UnsetArray, GivesBackItsFirstNumbersAloneWhenItForgetsThem) {
  constexpr std::size_t size = 8'000'000, forgotten = 6'000'000; // 64 and 48 MB
  UnsetArray<double> array(size);
  std::fill_n(array.data(), size, 7.);
  const double before = resident();
  array.forgetFirst(forgotten);
  EXPECT_LT(resident(), before - 0.9 * double(forgotten) * sizeof(double));
  EXPECT_EQ(std::count(array.data() + forgotten, array.data() + size, 7.), size - forgotten);
  UnsetArray<double> few(3); // too few for a page of their own: they stay where they are
  few.data()[2] = 7;
  few.forgetFirst(2);
  EXPECT_EQ(few.data()[2], 7);
}

TEST(UnsetArray, KeepsItsNumbersWhenItMoves) {
  UnsetArray<double> first(3);
  first.data()[2] = 7;
  UnsetArray<double> second = std::move(first);
  EXPECT_EQ(second.size(), 3);
  EXPECT_EQ(second.data()[2], 7);
  EXPECT_EQ(first.size(), 0); // NOLINT(bugprone-use-after-move): a moved array is empty
}

} // namespace
} // namespace palp
