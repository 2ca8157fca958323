#include "app/study/reports/readout/ReadoutReport.h"

#include "app/study/reports/layout/FieldResponse.h"
#include "app/study/reports/layout/SignalComparison.h"
#include "app/study/reports/readout/CurrentPaths.h"
#include "model/FieldAtRest.h"

#include <gtest/gtest.h>

#include <map>

using palp::Readout;

namespace {

palp::SensorDesign readoutDesign() {
  palp::SensorDesign design = palp::paperDesign();
  design.lowerFollowsRubber = true;
  return design;
}

/// The paper's block on the default mesh at rest.
const palp::AreaResponse& response() {
  static palp::StageLog stages;
  static const auto solved = palp::AreaResponse::atRest(palp::paperDesign(), {}, 0, stages, {}, {});
  return *solved;
}

palp::LayoutBound boundWith(const palp::FieldLaw& law) {
  return palp::FieldResponse(readoutDesign(), law, response(), 0, 0.5).bound(Readout::VirtualGround, -1, 1e-4);
}

void expectNear(const Eigen::Vector3d& found, const Eigen::Vector3d& known, double digit) {
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(found(axis), known(axis), 0.5 * digit + 0.05 * known(axis)) << axis; // 5 % between two meshes
}

} // namespace

/// An independent prototype found these bounds with prior of all row-wires.
TEST(ReadoutFigures, OfAContactAndOfSwitchesAreThoseOfAnIndependentProgram) {
  palp::FieldLaw contact;
  contact.contact_ohm_mm2 = 3 * contact.resistivity_ohm_mm * contact.electrodeRadius_mm;
  expectNear(boundWith(contact).withPrior(), {1.3, 1.0, 1.3}, 0.1);
  palp::FieldLaw switches;
  switches.wire_ohm = 5;
  expectNear(boundWith(switches).withPrior(), {0.94, 0.42, 0.45}, 0.01);
}

TEST(CurrentPaths, ThroughOtherWiresAreThoseOfAnIndependentProgram) {
  // Two wires that float alone: 5.5 % of the current goes straight, 0.73 A an ampere cross other wires' metal.
  const palp::CurrentPaths paths =
      currentPaths(palp::networkAtRest(palp::paperDesign(), palp::FieldLaw{}), Readout::Floating);
  EXPECT_NEAR(paths.straight, 0.055, 0.003);
  EXPECT_NEAR(paths.metal, 0.73, 0.02);
}

TEST(CurrentPaths, OfTwoWiresAloneIsAllStraight) {
  palp::SensorDesign design = palp::paperDesign();
  design.upper.wire_mm = {15};
  design.lower.wire_mm = {15};
  const palp::TerminalNetwork network = palp::networkAtRest(design, palp::FieldLaw{});
  for (const Readout readout : {Readout::Floating, Readout::VirtualGround, Readout::OthersAtHalf}) {
    const palp::CurrentPaths paths = currentPaths(network, readout);
    EXPECT_NEAR(paths.straight, 1, 1e-12);
    EXPECT_EQ(paths.metal, 0);
    EXPECT_NEAR(paths.mostPerVolt_A, palp::NetworkReading(network, readout).resistances_ohm().cwiseInverse()(0, 0),
                1e-12);
  }
}

TEST(SignalComparison, IsTheFactorAndOneForTheSameSignals) {
  palp::LogSensitivity one(2), other;
  for (auto& area : one) area.fill(Eigen::MatrixXd::Random(3, 4));
  other = one;
  for (auto& area : other) area[2] *= -3;
  const palp::SignalComparison compared = palp::comparedWith(one, other);
  EXPECT_NEAR(compared.factor.x(), 1, 1e-12);
  EXPECT_NEAR(compared.factor.z(), 3, 1e-12);
  EXPECT_NEAR(compared.correlation.x(), 1, 1e-12);
  EXPECT_NEAR(compared.correlation.z(), -1, 1e-12);
}

TEST(ReadoutReport, ChoosesVirtualGroundForThePapersDesignAndSaysWhatTheBoardNeeds) {
  palp::ReportRequest request;
  request.mesh.mapped = std::array<int, 3>{6, 6, 3};
  const auto report = readoutReport(request, {}, {});
  ASSERT_TRUE(report);
  EXPECT_NE(report->summary.find("Best read-out: virtual_ground"), std::string::npos) << report->summary;
  const std::map<std::string, double> figures(report->figures.begin(), report->figures.end());
  const double best = figures.at("virtual_ground_bound_without_prior_percent");
  EXPECT_GT(figures.at("floating_bound_without_prior_percent"), 4 * best);
  EXPECT_NEAR(figures.at("noise_of_reading_for_one_percent") * best / 1e-4, 1, 1e-9); // bounds grow with the noise
  for (const char* line : {"\nradius [mm]: bound with prior [%],virtual_ground,all,0.2,Fx,",
                           "\ncorrelation with Eq. (1),floating,all,,Fz,",
                           "\nnoise of full scale: bound without prior [%],rows_grounded,4,1e-04,Fy,"})
    EXPECT_NE(report->csv.find(line), std::string::npos) << line;
}

TEST(ReadoutReport, RefusesADesignWhoseElectrodesWouldOverlapUnderTheUsualLaw) {
  palp::ReportRequest request;
  request.design.lower.wire_mm = {15, 15.3};
  EXPECT_THROW((void)readoutReport(request, {}, {}), palp::Error);
}
