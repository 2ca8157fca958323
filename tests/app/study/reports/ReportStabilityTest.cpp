#include "app/study/reports/stability/StabilityReport.h"
#include "app/study/reports/stability/StabilityRow.h"
#include "model/DesignError.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

using palp::StabilityOutcome;
using palp::StabilityRow;

namespace {

/// All cases once, on few elements: minutes under the sanitizers otherwise.
const std::vector<StabilityRow>& allRows() {
  static const std::vector<StabilityRow> rows = [] {
    std::vector<StabilityRow> made;
    palp::StabilityCases cases(made, {}, {});
    palp::ReportRequest request;
    request.mesh.mapped = std::array<int, 3>{4, 4, 2};
    request.perArea = 40; // enough for networks that are right
    palp::StageLog stages;
    addSolverCases(cases, request, stages);
    addResistanceCases(cases, request);
    addNetworkCases(cases, request, stages);
    return made;
  }();
  return rows;
}

std::string nameOf(const StabilityRow& row) {
  return row.group + ": " + row.what;
}

bool isNetwork(const StabilityRow& row) {
  return row.group.rfind("network", 0) == 0;
}

/// The cases of the solver and of Eq. (1) that are not plainly right, and why they cannot be.
const std::map<std::string, StabilityOutcome> kNotRight{
    {"compression: (0, 0, -1000) N on area 0", StabilityOutcome::Stopped}, // the block is pressed flat before
    {"material: c01 = -0.3 MPa", StabilityOutcome::Stopped},               // loses its stiffness under tension
    {"material: c01 = -0.4 MPa", StabilityOutcome::Refused},               // has none: c10 + c01 < 0
    {"inverted elements: a node of the mesh pushed through the element below", StabilityOutcome::Refused},
    {"Eq. (1): symmetric layout: row-wire at y = 15 mm of a layout symmetric about 15 mm", StabilityOutcome::Warned},
};

const StabilityRow& rowOf(const std::string& name) {
  const auto& rows = allRows();
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return nameOf(r) == name; });
  if (row == rows.end()) throw std::logic_error("no case '" + name + "'");
  return *row;
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

TEST(StabilityReport, NoCaseIsWrong) {
  EXPECT_GT(allRows().size(), 100U);
  for (const StabilityRow& row : allRows())
    EXPECT_NE(row.outcome, StabilityOutcome::Wrong) << nameOf(row) << ": " << row.words;
}

TEST(StabilityReport, EveryRowThatIsNotRightHasASentence) {
  for (const StabilityRow& row : allRows())
    EXPECT_TRUE(row.outcome == StabilityOutcome::Right || !row.words.empty()) << nameOf(row);
}

TEST(StabilityReport, EveryCaseOfTheSolverIsRightButThoseThatCannotBe) {
  std::size_t found = 0;
  for (const StabilityRow& row : allRows()) {
    if (isNetwork(row)) continue;
    const auto known = kNotRight.find(nameOf(row));
    const StabilityOutcome expected = known == kNotRight.end() ? StabilityOutcome::Right : known->second;
    EXPECT_EQ(name(row.outcome), name(expected)) << nameOf(row) << ": " << row.words;
    if (known != kNotRight.end()) ++found;
    if (expected == StabilityOutcome::Right) {
      EXPECT_FALSE(std::isnan(row.error)) << nameOf(row) << " was not checked";
    }
  }
  EXPECT_EQ(found, kNotRight.size());
}

TEST(StabilityReport, NetworksAreRightAtModerateSpreadsAndAdmitWhereTheyAreNot) {
  for (const char* spread : {"1", "10"})
    EXPECT_EQ(name(rowOf(std::string("network: spread, linear tail: spread ") + spread).outcome), "right") << spread;
  EXPECT_EQ(name(rowOf("network: spread, bias only: spread 0.001").outcome), "warned"); // sees one sample at a time
  EXPECT_EQ(name(rowOf("network: data: all inputs constant").outcome), "warned");
  EXPECT_EQ(name(rowOf("network: data: a single sample").outcome), "warned");
  for (const char* refused : {"network: data: an input that is not a number", "network: data: inputs times 1e+200",
                              "network: broken wires: open wire (R infinite)"})
    EXPECT_EQ(name(rowOf(refused).outcome), "refused") << refused;
  for (const char* marked :
       {"network: broken wires: nearly open wire (R = 1e12 ohm)", "network: broken wires: shorted wire (R = 0)"})
    EXPECT_EQ(name(rowOf(marked).outcome), "warned") << marked;
}

TEST(StabilityReport, StopsWithoutAResult) {
  std::stop_source source;
  source.request_stop();
  EXPECT_EQ(palp::stabilityReport({}, {}, source.get_token()), std::nullopt);
}
