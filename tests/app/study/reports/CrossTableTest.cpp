#include "app/study/reports/networks/CrossTable.h"

#include "app/study/reports/networks/NetworksReport.h"
#include "model/DesignError.h"

#include <gtest/gtest.h>

#include <map>

namespace {

/// The paper's block with few electrodes, read by virtual ground, on a coarse mesh: seconds.
palp::ReportRequest smallRequest() {
  palp::ReportRequest request;
  request.design.upper.wire_mm = {6, 15, 24};
  request.design.upper.along_mm = {{6, 15, 24}};
  request.design.lower.wire_mm = {3, 9, 15, 21, 27};
  request.design.forceRange = {{-1, -1, -3}, {1, 1, 0}};
  palp::FieldLaw law;
  law.readout = palp::Readout::VirtualGround;
  request.design.resistance = law;
  request.mesh.mapped = std::array<int, 3>{4, 4, 2};
  request.perArea = 20;
  return request;
}

std::map<std::string, double> figures(const palp::ReportContent& report) {
  return {report.figures.begin(), report.figures.end()};
}

const palp::ReportContent& smallReport() {
  static const auto report = networksReport(smallRequest(), {}, {}); // the door: a design under the field leads here
  return *report;
}

std::string linear(const std::string& from, const std::string& on, const char* force) {
  return "linear_trained_" + from + "_used_" + on + "_" + force + "_percent";
}

TEST(CrossTable, TellsEveryPairOfLawsWithItsErrorsAsReadAndScaledAtRest) {
  ASSERT_EQ(smallReport().parts.size(), 10U);
  int tables = 0;
  for (const palp::ReportPart& part : smallReport().parts)
    if (const auto* table = std::get_if<palp::ReportTable>(&part)) {
      ++tables;
      EXPECT_EQ(table->rows.size(), 25U); // Eq. (1), three read-outs, a larger radius
      EXPECT_EQ(table->marks.size(), 25U);
    }
  EXPECT_EQ(tables, 2); // linear and rbf
  EXPECT_EQ(smallReport().figures.size(), 2U * 25 * 3);
  for (const char* line :
       {"\nlinear,Eq. (1),virtual_ground,as read,Fx,",
        "\nrbf,virtual_ground,\"virtual_ground, radius 0.3 mm\",scaled at rest,Fz,", "\npredicting the mean,,,,Fy,"})
    EXPECT_NE(smallReport().csv.find(line), std::string::npos) << line;
}

/// Without scaling the other law's ohms mean nothing to a decoder; on its own law scaling changes nothing.
TEST(CrossTable, ADecoderIsBestOnTheLawItWasTrainedOn) {
  const auto error = figures(smallReport());
  for (const char* on : {"virtual_ground", "rows_grounded", "floating"})
    EXPECT_LT(error.at(linear(on, on, "Fx")), error.at(linear("pairs", on, "Fx"))) << on;
  EXPECT_LT(error.at(linear("pairs", "pairs", "Fx")), error.at(linear("floating", "pairs", "Fx")));
  const std::string& csv = smallReport().csv;
  const auto after = [&](const std::string& line) {
    return csv.substr(csv.find(line) + line.size(), csv.find('\n', csv.find(line) + 1) - csv.find(line) - line.size());
  };
  EXPECT_EQ(after("\nlinear,floating,floating,as read,Fx,"), after("\nlinear,floating,floating,scaled at rest,Fx,"));
  EXPECT_NE(after("\nlinear,floating,rows_grounded,as read,Fx,"),
            after("\nlinear,floating,rows_grounded,scaled at rest,Fx,"));
}

TEST(CrossTable, LeavesOutARadiusThatDoesNotFit) {
  palp::ReportRequest request = smallRequest();
  palp::FieldLaw law = *request.design.field();
  law.electrodeRadius_mm = 0.8; // 1.2 mm would reach out of the block
  request.design.resistance = law;
  request.perArea = 5;
  const auto report = networksReport(request, {}, {});
  ASSERT_TRUE(report);
  EXPECT_EQ(report->figures.size(), 2U * 16 * 3);
  ASSERT_FALSE(report->warnings.empty());
  EXPECT_NE(report->warnings.back().find("radius 1.2"), std::string::npos) << report->warnings.back();
}

TEST(CrossTable, RefusesAPressureLawAndStops) {
  palp::ReportRequest request = smallRequest();
  std::stop_source source;
  source.request_stop();
  EXPECT_FALSE(crossTableReport(request, {}, source.get_token()));
  request.design.pressureLaw = palp::PressureLaw{};
  EXPECT_THROW(crossTableReport(request, {}, {}), palp::DesignError);
}

} // namespace
