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

/// All cases on few elements.
std::vector<StabilityRow> allRows() {
  std::vector<StabilityRow> rows;
  palp::StabilityCases cases(rows, {}, {});
  palp::ReportRequest request;
  request.mesh.mapped = std::array<int, 3>{4, 4, 2};
  request.perArea = 40; // enough for networks that are right
  palp::StageLog stages;
  addSolverCases(cases, request, stages);
  addResistanceCases(cases, request);
  addNetworkCases(cases, request, stages);
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

const StabilityRow& rowOf(const std::vector<StabilityRow>& rows, const std::string& name) {
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return nameOf(r) == name; });
  if (row == rows.end()) throw std::logic_error("no case '" + name + "'");
  return *row;
}

} // namespace

/// The cases of the solver are not lost with it.
TEST(StabilityCase, SamplesWithoutASolutionAreOneThatSaysSo) {
  std::vector<StabilityRow> rows;
  palp::StabilityCases cases(rows, {}, {});
  palp::ReportRequest request;
  std::get<MooneyRivlin>(request.design.material.law).c01_MPa = -0.32; // nearly no shear stiffness is left
  request.mesh.mapped = std::array<int, 3>{4, 4, 2};
  request.perArea = 5;
  palp::StageLog stages;
  addNetworkCases(cases, request, stages);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(nameOf(rows[0]), "network: samples of the design");
  EXPECT_EQ(rows[0].outcome, StabilityOutcome::Stopped);
  EXPECT_NE(rows[0].words.find("load "), std::string::npos) << rows[0].words;
}

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

/// None wrong, and none that is not right without a sentence.
void expectNoSilentMistake(const std::vector<StabilityRow>& rows) {
  EXPECT_GT(rows.size(), 100U);
  for (const StabilityRow& row : rows) {
    EXPECT_NE(row.outcome, StabilityOutcome::Wrong) << nameOf(row) << ": " << row.words;
    EXPECT_TRUE(row.outcome == StabilityOutcome::Right || !row.words.empty()) << nameOf(row);
  }
}

void expectSolverRight(const std::vector<StabilityRow>& rows) {
  std::size_t found = 0;
  for (const StabilityRow& row : rows) {
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

/// On so few samples of so coarse a mesh only a network with some ridge is good; the others must say that they are not.
void expectNetworksHonest(const std::vector<StabilityRow>& rows) {
  const auto outcome = [&](const std::string& what) { return name(rowOf(rows, "network: " + what).outcome); };
  for (const char* right : {"ridge: ridge 1e-06, spread 1", "solver: cholesky, spread 10"})
    EXPECT_EQ(outcome(right), "right") << right;
  for (const char* warned : {"spread, bias only: spread 0.001", "data: all inputs constant", "data: a single sample",
                             "broken wires: nearly open wire (R = 1e12 ohm)", "broken wires: shorted wire (R = 0)"})
    EXPECT_EQ(outcome(warned), "warned") << warned;
  for (const char* refused :
       {"data: an input that is not a number", "data: inputs times 1e+200", "broken wires: open wire (R infinite)"})
    EXPECT_EQ(outcome(refused), "refused") << refused;
}

// One test, as each runs in a process of its own and all need the same cases: minutes under the sanitizers.
TEST(StabilityReport, EveryCaseIsRightOrSaysThatItIsNot) {
  const std::vector<StabilityRow> rows = allRows();
  expectNoSilentMistake(rows);
  expectSolverRight(rows);
  expectNetworksHonest(rows);
}

/// A sphere of 0.05 mm lies between the nodes of any coarse mesh: refused, or with a warning, but never silently.
TEST(StabilityReport, EveryContactIsRightOrSaysThatItIsNot) {
  std::vector<StabilityRow> rows;
  palp::StabilityCases cases(rows, {}, {});
  palp::ReportRequest request;
  request.mesh.mapped = std::array<int, 3>{16, 16, 2};
  palp::StageLog stages;
  addContactCases(cases, request, stages);
  EXPECT_GT(rows.size(), 15U);
  for (const StabilityRow& row : rows) {
    EXPECT_NE(row.outcome, StabilityOutcome::Wrong) << nameOf(row) << ": " << row.words;
    EXPECT_TRUE(row.outcome == StabilityOutcome::Right || !row.words.empty()) << nameOf(row);
  }
  EXPECT_NE(rowOf(rows, "contact: size of a sphere: 0.05 mm").outcome, StabilityOutcome::Right);
  EXPECT_EQ(name(rowOf(rows, "contact: size of a sphere: 1e+05 mm").outcome), "right");
}

TEST(StabilityReport, StopsWithoutAResult) {
  std::stop_source source;
  source.request_stop();
  EXPECT_EQ(palp::stabilityReport({}, {}, source.get_token()), std::nullopt);
}
