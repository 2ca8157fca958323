#include "app/gui/jobs/samples/SampleTimes.h"

#include "tests/app/gui/WindowFixture.h"

#include <QSettings>

namespace palp {
namespace {

class SampleTimes : public testing::Test {
protected:
  SampleTimes() { QSettings().remove("sampleTimes"); }
  ~SampleTimes() override { QSettings().remove("sampleTimes"); }
  SampleTimes(const SampleTimes&) = delete;
  SampleTimes& operator=(const SampleTimes&) = delete;

  Project project = exampleProject();
};

TEST_F(SampleTimes, FollowWhatTheyTookHereLast) {
  SampleSettings samples = project.samples;
  const auto before = sampleTime(samples, project.design, project.mesh);
  ASSERT_TRUE(before.has_value());
  EXPECT_FALSE(before->measuredHere);
  rememberSampleTime(samples, project.design, project.mesh, 3 * before->seconds);
  const auto after = sampleTime(samples, project.design, project.mesh);
  EXPECT_TRUE(after->measuredHere);
  EXPECT_DOUBLE_EQ(after->seconds, 3 * before->seconds);
  samples.perArea *= 10;
  EXPECT_GT(sampleTime(samples, project.design, project.mesh)->seconds, after->seconds);

  samples.touches = usualTouches(project.design);
  const auto touches = sampleTime(samples, project.design, project.mesh);
  EXPECT_FALSE(touches->measuredHere) << "another kind, on a machine three times as slow";
  QSettings().remove("sampleTimes");
  EXPECT_DOUBLE_EQ(touches->seconds, 3 * sampleTime(samples, project.design, project.mesh)->seconds);
}

TEST_F(SampleTimes, SayNothingOfAMeshThatTheyNeverMet) {
  MeshOptions coarse = project.mesh;
  coarse.mapped = {9, 8, 2};
  EXPECT_FALSE(sampleTime(project.samples, project.design, coarse).has_value());
  rememberSampleTime(project.samples, project.design, coarse, 0.5);
  EXPECT_NEAR(sampleTime(project.samples, project.design, coarse)->seconds, 0.5, 1e-12);
  EXPECT_FALSE(sampleTime(project.samples, project.design, project.mesh)->measuredHere);
}

} // namespace
} // namespace palp
