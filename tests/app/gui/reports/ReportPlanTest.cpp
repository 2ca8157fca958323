#include "app/gui/reports/ReportPlan.h"
#include "app/gui/reports/ReportKinds.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

const std::vector<RunPart> kParts{{"short", 0.5, 2}, {"long", 1, 18}};

TEST(ReportPlan, LeavesTheRestOfThePlanAsMuchSlowerAsTheRunWasSoFar) {
  const ReportPlan plan("plan-a", kParts);
  EXPECT_DOUBLE_EQ(plan.seconds(), 20);
  EXPECT_DOUBLE_EQ(plan.left_s(0, 0), 20);
  EXPECT_NEAR(plan.left_s(0.5, 2), 18, 1e-9);        // as planned, though half of the progress is done
  EXPECT_NEAR(plan.left_s(0.75, 44), 36, 0.15 * 36); // four times as slow: 9 s of the plan are left
  EXPECT_DOUBLE_EQ(plan.left_s(1, 50), 0);
}

TEST(ReportPlan, TakesTheTimesOfTheLastRunOnThisMachine) {
  const ReportPlan first("plan-b", kParts);
  EXPECT_FALSE(first.measuredHere());
  first.remember({1, 4});
  const ReportPlan second("plan-b", kParts);
  EXPECT_TRUE(second.measuredHere());
  EXPECT_DOUBLE_EQ(second.seconds(), 5);
  const ReportPlan other("plan-b", {{"another division", 1, 7}}); // of another version of Palp
  EXPECT_FALSE(other.measuredHere());
  EXPECT_DOUBLE_EQ(other.seconds(), 7);
}

TEST(ReportPlan, EveryKindHasPartsThatGoUpToTheWhole) {
  for (const ReportKind& kind : reportKinds()) {
    ASSERT_FALSE(kind.parts.empty()) << kind.title.toStdString();
    double from = 0;
    for (const RunPart& part : kind.parts) {
      EXPECT_GT(part.until, from) << part.name;
      EXPECT_GT(part.seconds, 0) << part.name;
      from = part.until;
    }
    EXPECT_DOUBLE_EQ(from, 1) << kind.title.toStdString();
  }
}

} // namespace
} // namespace palp
