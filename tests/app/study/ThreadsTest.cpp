#include "app/study/reports/layout/DesignBounds.h"
#include "app/study/reports/layout/LayoutSearch.h"
#include "app/study/reports/layout/LayoutSweeps.h"
#include "app/study/studies/StudyRow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <thread>

namespace palp {
namespace {

int threadsOfThisProcess() {
  return static_cast<int>(std::distance(std::filesystem::directory_iterator("/proc/self/task"), {}));
}

/// Looks at the threads of this process all the time that it lives.
class ThreadWatch {
public:
  /// How many more there were than before it, itself apart.
  int more() {
    looking_.request_stop();
    looking_.join();
    return most_ - before_ - 1;
  }

private:
  int before_ = threadsOfThisProcess(), most_ = 0;
  std::jthread looking_{[this](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      most_ = std::max(most_, threadsOfThisProcess());
      std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
  }};
};

MeshOptions fewBricks() {
  MeshOptions mesh;
  mesh.mapped = std::array<int, 3>{4, 4, 2};
  return mesh;
}

/// On a node that others use too, a command takes no more than what --threads gives it.
TEST(OneThread, IsAllThatBoundsSweepsAndSearchesOfLayoutsTake) {
  SensorDesign pairs = paperDesign(), field = paperDesign();
  field.resistance = FieldLaw{};
  StageLog stages;
  ThreadWatch watch;
  for (const SensorDesign& design : {pairs, field}) {
    ASSERT_TRUE(designBounds(design, fewBricks(), 1e-4, 1, {}, {}));
    const auto response = AreaResponse::solve(design, fewBricks(), 1, stages, {}, {});
    EXPECT_GT(areaGoal(*response, -1, 1e-4, 1)(design, 0.5, {}), 0);
  }
  const auto response = AreaResponse::solve(pairs, fewBricks(), 1, stages, {}, {});
  EXPECT_FALSE(layoutSweeps(pairs, *response, -1, 1e-4, 1).empty());
  EXPECT_EQ(watch.more(), 0);
}

TEST(OneThread, IsAllThatARowOfAStudyTakes) {
  const StudyPlan plan = parseStudy(R"({"palp_study": 1, "design": "paper", "mapped": [4, 4, 2], "per_area": 10,
    "decoders": ["linear"], "compute": ["bound", "displacement", "decoders"],
    "vary": [{"key": "material.c01_MPa", "values": [0.08]}]})",
                                    "study");
  ThreadWatch watch;
  const auto row = studyRow(plan, 0, studyAreas(plan), 1, {}, {});
  EXPECT_EQ(watch.more(), 0);
  ASSERT_TRUE(row);
  EXPECT_EQ(row->problem, "");
}

} // namespace
} // namespace palp
