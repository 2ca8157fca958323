#include "app/study/reports/networks/LawsSideBySide.h"

#include "app/study/reports/networks/NoiseReport.h"

#include <gtest/gtest.h>

#include <cmath>

using palp::LawReading;

namespace {

constexpr double kLawsNoise = 1e-4;

/// The paper's design as it is (lower electrodes held), and with lower electrodes that follow the rubber.
const palp::LawsSideBySide& laws(bool follows) {
  static palp::StageLog stages;
  static const auto response = palp::AreaResponse::atRest(palp::paperDesign(), {}, 0, stages, {}, {});
  static const auto of = [](bool lowerFollows) {
    palp::SensorDesign design = palp::paperDesign();
    design.lowerFollowsRubber = lowerFollows;
    return palp::LawsSideBySide(design, {}, *response, 0, stages, {});
  };
  static const palp::LawsSideBySide held = of(false), following = of(true);
  return follows ? following : held;
}

const LawReading& named(const palp::LawsSideBySide& laws, const std::string& name) {
  for (const LawReading& reading : laws.readings())
    if (reading.name == name) return reading;
  throw std::logic_error("no such reading");
}

/// A line of the table that an independent prototype found, as printed; `percent` is what is left to its mesh and ours.
struct Line {
  const char* name;
  Eigen::Vector3d signal, row, all;
  double percent;
};

void expectPrinted(const Eigen::Vector3d& found, const Eigen::Vector3d& printed, double percent, const char* what) {
  for (int axis = 0; axis < 3; ++axis) {
    const double digit = std::pow(10, std::floor(std::log10(printed(axis))) - 1); // the last one that is printed
    EXPECT_NEAR(found(axis), printed(axis), 0.5 * digit + percent / 100 * printed(axis)) << what << " " << axis;
  }
}

class PrototypesTable : public testing::TestWithParam<Line> {};

/// Eq. (1) with lower electrodes held, the field with electrodes that all follow the rubber, signals beside that
/// Eq. (1).
TEST_P(PrototypesTable, HoldsInEveryEntry) {
  const Line& known = GetParam();
  const LawReading& pairs = laws(false).readings().front();
  const LawReading& own = std::string(known.name) == "Eq. (1)" ? pairs : named(laws(true), known.name);
  expectPrinted(palp::comparedWith(pairs.slopes, own.slopes).factor, known.signal, known.percent, "signal");
  expectPrinted(own.bound(4, kLawsNoise).withPrior(), known.row, known.percent, "row 4");
  expectPrinted(own.bound(-1, kLawsNoise).withPrior(), known.all, known.percent, "all rows");
}

INSTANTIATE_TEST_SUITE_P(Paper, PrototypesTable,
                         testing::Values(Line{"Eq. (1)", {1, 1, 1}, {9.1, 22, 13}, {1.20, 0.97, 1.24}, 1},
                                         Line{"floating", {0.39, 0.30, 0.40}, {16, 20, 17}, {6.0, 4.3, 4.5}, 12},
                                         Line{
                                             "virtual_ground", {2.1, 2.3, 3.7}, {4.5, 8.5, 2.8}, {0.92, 0.41, 0.43}, 5},
                                         Line{"rows_grounded", {1.3, 2.2, 2.6}, {6.9, 17, 13}, {1.28, 0.46, 0.52}, 5},
                                         Line{"others_at_half", {0.17, 0.09, 0.32}, {18, 25, 12}, {7.6, 11, 3.6}, 12}),
                         [](const auto& each) {
                           std::string name = each.param.name;
                           std::erase_if(name, [](char c) { return !std::isalpha(static_cast<unsigned char>(c)); });
                           return name;
                         });

TEST(LawsSideBySide, TheTableIsTheReadingsAndSoAreTheFigures) {
  std::vector<std::pair<std::string, double>> figures;
  const palp::ReportTable table = laws(true).bounds(kLawsNoise, &figures);
  ASSERT_EQ(table.rows.size(), 10U); // five laws, the row-wire in the middle and all
  EXPECT_EQ(table.rows[5][0], "virtual_ground");
  EXPECT_EQ(table.rows[5][1], "all");
  ASSERT_EQ(figures.size(), 30U);
  EXPECT_EQ(figures[17].first, "virtual_ground_rows_all_Fz_bound_with_prior_percent");
  EXPECT_EQ(figures[17].second, named(laws(true), "virtual_ground").bound(-1, kLawsNoise).withPrior()(2));
}

TEST(NoiseReport, OfADesignByEquationOneNamesTheOtherLawsToo) {
  palp::ReportRequest request;
  request.mesh.mapped = std::array<int, 3>{4, 4, 2};
  request.perArea = 8;
  const auto report = noiseReport(request, {}, {});
  ASSERT_TRUE(report);
  EXPECT_NE(report->csv.find("\nall 10 row-wires,\"bound with prior at rest, virtual_ground\",1e-04,"),
            std::string::npos);
  ASSERT_EQ(report->figures.size(), 30U);
}

TEST(NoiseReport, SaysWhereTheFieldCannotBeFound) {
  palp::ReportRequest request;
  request.mesh.mapped = std::array<int, 3>{4, 4, 2};
  request.perArea = 8;
  request.design.upper.z_mm = {{1.2}}; // spheres of 0.2 mm radius would overlap those at 1 mm
  request.design.lower.wire_mm[0] = 1.5;
  request.design.lower.along_mm[0][0] = 4.5;
  request.design.lower.wire_mm[1] = 2;
  const auto report = noiseReport(request, {}, {});
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->figures.empty());
}

} // namespace
