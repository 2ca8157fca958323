#include "app/study/studies/StudyFolder.h"

#include "app/study/Version.h"
#include "app/study/studies/StudyReport.h"
#include "app/study/studies/StudyRow.h"
#include "io/AtomicFile.h"
#include "model/base/Error.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

StudyPlan planOf(const std::string& compute, const std::string& material) {
  return parseStudy(R"({"palp_study": 1, "design": "paper", "mapped": [4, 4, 2], "per_area": 5, "decoders": ["linear"],
    "compute": [")" + compute +
                        R"("], "vary": [{"key": "material.c01_MPa", "values": [)" + material + "]}]}",
                    "study");
}

StudyPlan quickPlan() {
  return planOf("displacement", "0.08, 0.07");
}

bool compute(StudyFolder& study, bool retryProblems = false) {
  return study.compute(0, study.plan().designs(), 1, {}, {}, retryProblems);
}

TEST(StudyRow, ALoadOfABatchWithoutASolutionIsARowThatSaysSo) {
  const StudyPlan plan = planOf("decoders", "-0.32"); // nearly no shear stiffness is left
  const auto row = studyRow(plan, 0, studyAreas(plan), 1, {}, {});
  ASSERT_TRUE(row);
  EXPECT_NE(row->problem.find("load "), std::string::npos) << row->problem;
}

TEST(StudyFolder, KnowsItsPlanByContentAndNotByItsBytes) {
  const TemporaryFolder folder;
  const StudyPlan plan = quickPlan();
  { const StudyFolder begun(folder / "out", plan); }
  EXPECT_NE(readFile(folder / "out" / "study.json").find(program()), std::string::npos);
  std::string other = toJson(plan);
  other.insert(other.find('{') + 1, "\n\n   ");
  writeFile(folder / "out" / "study.json", other, true); // other spaces, no program
  EXPECT_NO_THROW(StudyFolder::requireFits(folder / "out", plan));
  EXPECT_THROW(StudyFolder::requireFits(folder / "out", planOf("displacement", "0.08, 0.06")), Error);
}

TEST(StudyFolder, SaysWhereRowsAreOfSeveralPrograms) {
  const TemporaryFolder folder;
  StudyFolder study(folder / "out", quickPlan());
  ASSERT_TRUE(compute(study));
  EXPECT_EQ(study.mixedPrograms(), "");
  const auto first = folder / "out" / "rows" / "0000000.csv";
  const std::string row = readFile(first);
  writeFile(first, row.substr(0, row.find('\n') + 1) + "# program: palp 0.1 (commit old)\n", true);
  EXPECT_NE(study.mixedPrograms().find("1 of palp 0.1 (commit old)"), std::string::npos) << study.mixedPrograms();
  study.writeTable(); // the row itself is whole
  EXPECT_EQ(readFile(study.table()).find("program"), std::string::npos);
  const ReportContent page = studyReport(study);
  const auto* words = std::get_if<ReportWords>(&page.parts.front());
  ASSERT_NE(words, nullptr);
  EXPECT_NE(words->text.find("palp 0.1"), std::string::npos) << words->text;
}

TEST(StudyFolder, WorksOutRowsWithAProblemAgainWhereAsked) {
  const TemporaryFolder folder;
  StudyFolder study(folder / "out", quickPlan());
  ASSERT_TRUE(compute(study));
  const auto first = folder / "out" / "rows" / "0000000.csv";
  const std::string good = readFile(first), failed = "0,0.08,no memory,\n";
  writeFile(first, failed, true);
  ASSERT_TRUE(compute(study));
  EXPECT_EQ(readFile(first), failed);
  ASSERT_TRUE(compute(study, true));
  EXPECT_EQ(readFile(first), good);
}

} // namespace
} // namespace palp
