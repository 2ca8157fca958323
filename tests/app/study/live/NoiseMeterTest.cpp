#include "app/study/live/NoiseMeter.h"

#include <gtest/gtest.h>

#include <random>

namespace palp {
namespace {

constexpr Eigen::Index kReadings = 300;

/// Frames of readings of 500 ohm with noise, of which `moving` go up by a share of R a frame.
NoiseMeter measured(double noise, Eigen::Index moving, double motion) {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  NoiseMeter meter;
  Eigen::VectorXd readings(kReadings);
  for (int frame = 0; frame < 60; ++frame) {
    for (Eigen::Index k = 0; k < kReadings; ++k)
      readings(k) = 500 * (1 + noise * normal(engine) + (k < moving ? motion * frame * frame : 0));
    meter.add(readings);
  }
  return meter;
}

TEST(NoiseMeter, FindsTheNoiseAtRestAndUnderATouch) {
  for (const double noise : {5e-6, 1e-4}) {
    EXPECT_NEAR(measured(noise, 0, 0).noise(), noise, 0.05 * noise);     // a median of 300, fifty times
    EXPECT_NEAR(measured(noise, 40, 2e-5).noise(), noise, 0.25 * noise); // the accelerated ones are few
  }
}

TEST(NoiseMeter, IsReadyAfterAFewFramesAndBeginsAnew) {
  NoiseMeter meter;
  EXPECT_EQ(meter.noise(), 0);
  for (int frame = 0; frame < 7; ++frame) meter.add(Eigen::VectorXd::Constant(4, 100));
  EXPECT_FALSE(meter.ready());
  meter.add(Eigen::VectorXd::Constant(4, 100));
  EXPECT_TRUE(meter.ready());
  meter.restart();
  EXPECT_FALSE(meter.ready());
}

} // namespace
} // namespace palp
