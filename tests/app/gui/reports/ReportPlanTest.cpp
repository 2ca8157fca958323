#include "app/gui/reports/ReportPlan.h"
#include "app/gui/reports/ReportKinds.h"

#include <QSettings>

#include <gtest/gtest.h>

#include <algorithm>

namespace palp {
namespace {

const std::vector<RunPart> kParts{{"short", 0.5, 2}, {"long", 1, 18}};

TEST(ReportPlan, LeavesTheRestOfThePlanAsMuchSlowerAsTheRunWasSoFar) {
  QSettings().remove("reportSpeed"); // of the windows of other tests
  const ReportPlan plan("plan-a", kParts);
  EXPECT_DOUBLE_EQ(plan.seconds(), 20);
  EXPECT_DOUBLE_EQ(plan.left_s({0, 0}, 0), 20);
  EXPECT_NEAR(plan.left_s({0.5, 2}, 2), 18, 1e-9);         // as planned, though half of the progress is done
  EXPECT_NEAR(plan.left_s({0.75, 44}, 44), 36, 0.15 * 36); // four times as slow: 9 s of the plan are left
  EXPECT_DOUBLE_EQ(plan.left_s({1, 50}, 50), 0);
}

TEST(ReportPlan, TakesTheTimesOfTheLastRunOnThisMachine) {
  QSettings().remove("reportSpeed");
  const ReportPlan first("plan-b", kParts);
  EXPECT_FALSE(first.measuredHere());
  first.remember({1, 4}, {});
  const ReportPlan second("plan-b", kParts);
  EXPECT_TRUE(second.measuredHere());
  EXPECT_DOUBLE_EQ(second.seconds(), 5);
  EXPECT_DOUBLE_EQ(ReportPlan("plan-new", kParts).seconds(), 5) << "a machine four times as fast";
  const ReportPlan other("plan-b", {{"another division", 1, 7}}); // of another version of Palp
  EXPECT_FALSE(other.measuredHere());
  EXPECT_DOUBLE_EQ(other.seconds(), 7.0 / 4);
}

TEST(ReportPlan, IsRightWithinAThirdOnTheSecondRunHoweverUnevenThePartsAre) {
  // Nine tenths of the second part's time pass within a tenth of its progress; the second run is a half slower.
  const std::vector<RunMoment> moments{{0.25, 1}, {0.5, 2}, {0.9, 3}, {0.95, 12}, {1, 20}};
  ReportPlan("plan-c", kParts).remember({2, 18}, moments);
  const ReportPlan plan("plan-c", kParts);
  EXPECT_DOUBLE_EQ(plan.seconds(), 20);
  for (double share = 0.1; share < 0.99; share += 0.01) {
    const auto next =
        std::find_if(moments.begin(), moments.end(), [share](const RunMoment& one) { return one.share >= share; });
    const RunMoment before = next == moments.begin() ? RunMoment{} : *(next - 1);
    const double way = (share - before.share) / (next->share - before.share);
    const double elapsed_s = 1.5 * (before.seconds + way * (next->seconds - before.seconds));
    if (elapsed_s < 3 || elapsed_s > 27) continue; // 10 % to 90 % of the run
    EXPECT_NEAR(plan.left_s({share, elapsed_s}, elapsed_s), 30 - elapsed_s, (30 - elapsed_s) / 3) << share;
  }
}

TEST(ReportPlan, CountsDownWhileTheProgressStandsStill) {
  QSettings().remove("reportSpeed");
  const ReportPlan first("plan-d", kParts);
  EXPECT_NEAR(first.left_s({0.5, 2}, 12), 8, 1e-9); // 10 s into the long part, of which nothing was told
  EXPECT_DOUBLE_EQ(first.left_s({0.25, 1}, 11), 18) << "the short part takes longer than planned: the long one is left";
  // The second run tells its progress at the same shares: a step of 12 s stands between 0.6 and 0.61, much of the
  // progress right before it takes no time.
  const std::vector<RunMoment> moments{{0.5, 2}, {0.55, 2.001}, {0.6, 2.002}, {0.61, 14}, {0.99, 14.01}, {1, 20}};
  first.remember({2, 18}, moments);
  const ReportPlan second("plan-d", kParts);
  for (double elapsed_s = 2.1; elapsed_s < 20; elapsed_s += 0.5) {
    const auto next = std::find_if(moments.begin(), moments.end(),
                                   [elapsed_s](const RunMoment& one) { return one.seconds > elapsed_s; });
    EXPECT_NEAR(second.left_s(*(next - 1), elapsed_s), 20 - elapsed_s, 0.05) << elapsed_s;
  }
  EXPECT_NEAR(second.left_s({0.6, 2.002}, 30), 6, 0.05) << "the step takes too long: what comes after it is left";
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

TEST(ReportPlan, IsOfTheProjectsLawAndNumberOfSamples) {
  const auto& kinds = reportKinds();
  const auto networks =
      std::find_if(kinds.begin(), kinds.end(), [](const ReportKind& kind) { return runName(kind) == "networks"; });
  ASSERT_NE(networks, kinds.end());
  const auto seconds = [&](const Project& project) { return ReportPlan("", partsOf(*networks, project)).seconds(); };
  QSettings().remove("reportSpeed");
  Project pairs, field;
  FieldLaw law;
  field.design.resistance = law;
  EXPECT_EQ(partsOf(*networks, pairs).size(), networks->parts.size());
  ASSERT_FALSE(networks->fieldParts.empty());
  EXPECT_EQ(partsOf(*networks, field).front().name, networks->fieldParts.front().name);
  EXPECT_GT(seconds(field), seconds(pairs)) << "each read-out is sampled";
  Project many = field;
  many.view.reportPerArea = 10 * field.view.reportPerArea;
  EXPECT_GT(seconds(many), 1.2 * seconds(field));
  EXPECT_NE(settingsName(networks->arguments, field), settingsName(networks->arguments, pairs));
  Project other = field;
  law.electrodeRadius_mm *= 1.1;
  other.design.resistance = law;
  EXPECT_NE(settingsName(networks->arguments, other), settingsName(networks->arguments, field))
      << "the times of another design are others";
}

} // namespace
} // namespace palp
