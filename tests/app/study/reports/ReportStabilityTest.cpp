#include "app/study/reports/stability/StabilityReport.h"
#include "app/study/reports/stability/StabilityRow.h"
#include "model/DesignError.h"
#include "solver/SensorMesh.h"

#include <gtest/gtest.h>

using palp::StabilityOutcome;
using palp::StabilityRow;

namespace {

palp::MeshOptions coarse() {
  palp::MeshOptions mesh;
  mesh.mapped = std::array<int, 3>{4, 4, 2};
  return mesh;
}

} // namespace

TEST(StabilityCase, ARefusalKeepsItsSentence) {
  const StabilityRow row = palp::runCase("g", "w", [](StabilityRow&) { throw palp::DesignError("z_mm: too deep"); });
  EXPECT_EQ(row.outcome, StabilityOutcome::Refused);
  EXPECT_EQ(row.words, "z_mm: too deep");
}

TEST(StabilityCase, AMistakeOfTheProgramIsWrong) {
  const StabilityRow row = palp::runCase("g", "w", [](StabilityRow&) { throw std::logic_error("lost"); });
  EXPECT_EQ(row.outcome, StabilityOutcome::Wrong);
  EXPECT_NE(row.words.find("lost"), std::string::npos);
}

TEST(StabilityCase, AnErrorThatIsNoNumberIsWrong) {
  StabilityRow row;
  row.error = std::numeric_limits<double>::quiet_NaN();
  palp::judge(row, 1);
  EXPECT_EQ(row.outcome, StabilityOutcome::Wrong);
}

TEST(StabilityReport, EveryRowThatIsNotRightHasASentence) {
  std::vector<StabilityRow> rows;
  palp::StabilityCases cases(rows, {}, {});
  palp::ReportRequest request;
  request.mesh = coarse();
  request.perArea = 6;
  palp::StageLog stages;
  addSolverCases(cases, request, stages);
  addResistanceCases(cases, request);
  addNetworkCases(cases, request, stages);
  EXPECT_GT(rows.size(), 80U);
  for (const StabilityRow& row : rows)
    EXPECT_TRUE(row.outcome == StabilityOutcome::Right || !row.words.empty()) << row.group << ": " << row.what;
}

TEST(StabilityReport, StopsWithoutAResult) {
  std::stop_source source;
  source.request_stop();
  EXPECT_EQ(palp::stabilityReport({}, {}, source.get_token()), std::nullopt);
}
