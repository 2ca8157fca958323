#include "app/study/live/drift/DriftWatch.h"

#include "app/study/live/RestReference.h"
#include "io/DecoderFile.h"
#include "tests/app/study/live/LiveFixture.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

/// Frames of the paper's sensor at rest that warms up steadily, 10 a second.
class WarmingSensor {
public:
  /// `pause_s`: of the host's clock and the board's, before these frames.
  const LiveStatus& frames(int count, double pause_s = 0) {
    time_s_ += pause_s;
    for (int i = 0; i < count; ++i, time_s_ += 0.1) {
      LiveFrame live;
      live.forces.valid = true;
      live.frame.time_s = time_s_;
      live.change = Eigen::MatrixXd::Constant(10, 30, 1e-4 * time_s_);
      watch_.judge(live, &decoder_, 100 + time_s_, status_);
    }
    return status_;
  }

private:
  ForceDecoder decoder_{readNetwork(std::filesystem::path(PALP_SOURCE_DIR) / "resources/board/paper-network.json"),
                        simulatedBoard(shippedSamples(), {}, 1000, 1).info(), paperDesign()};
  DriftWatch watch_;
  LiveStatus status_;
  double time_s_ = 0;
};

TEST(DriftWatch, KnowsThePaceOfADriftAfterSomeSeconds) {
  WarmingSensor sensor;
  EXPECT_EQ(sensor.frames(20).driftRate_N_min, 0) << "too short a time to tell";
  EXPECT_GT(sensor.frames(100).driftRate_N_min, 0);
  EXPECT_TRUE(sensor.frames(1).drift);
}

TEST(DriftWatch, LooksForTheDriftAnewAfterAGapWithoutFrames) {
  WarmingSensor sensor;
  ASSERT_GT(sensor.frames(120).driftRate_N_min, 0);
  EXPECT_GT(sensor.frames(10, 2).driftRate_N_min, 0) << "frames may be missing for a while";
  EXPECT_EQ(sensor.frames(10, 4).driftRate_N_min, 0) << "nobody has seen it for long enough";
  EXPECT_GT(sensor.frames(120).driftRate_N_min, 0);
}

} // namespace
} // namespace palp
