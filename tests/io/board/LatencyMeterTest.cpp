#include "io/board/LatencyMeter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palp {
namespace {

TEST(LatencyMeter, TheClocksOffsetDoesNotCount) {
  LatencyMeter meter;
  for (int i = 0; i < 1000; ++i) meter.add(5000 + 1e-3 * i + (i % 10 == 0 ? 0 : 2e-3), 1e-3 * i);
  EXPECT_NEAR(meter.quantile_s(0.5), 2e-3, 0.1e-3); // the meter's bins are 5 % wide
  EXPECT_NEAR(meter.quantile_s(0.05), 1e-6, 1e-6);
  EXPECT_NEAR(meter.longest_s(), 2e-3, 1e-9);
}

TEST(LatencyMeter, SlowDriftOfTheClocksDoesNotCount) {
  LatencyMeter meter;
  for (int i = 0; i < 600'000; ++i) { // ten minutes at 1000/s, 100 ppm apart: 60 ms in all
    const double time_s = 1e-3 * i;
    meter.add(time_s * (1 + 1e-4) + 1e-4, time_s);
  }
  EXPECT_LT(meter.quantile_s(0.99), 1.2e-3); // 10 s of drift
}

TEST(LatencyMeter, FindsTheRareLateOnes) {
  LatencyMeter meter;
  for (int i = 0; i < 1000; ++i) meter.add(1e-3 * i + (i % 100 == 50 ? 0.03 : 0) + 1e-5 * (i % 2), 1e-3 * i);
  EXPECT_LT(meter.quantile_s(0.9), 1e-4);
  EXPECT_NEAR(meter.quantile_s(0.995), 0.03, 0.0016);
  EXPECT_NEAR(meter.longest_s(), 0.03, 1e-9);
  EXPECT_EQ(meter.count(), 1000U);
}

TEST(LatencyMeter, ARestartOfTheDeviceIsNoLatency) {
  LatencyMeter meter;
  meter.add(100, 50);
  meter.restart();
  EXPECT_EQ(meter.add(101, 0), 0);
  EXPECT_EQ(LatencyMeter().quantile_s(0.5), 0);
}

} // namespace
} // namespace palp
