#include "model/RestFit.h"

#include "model/FieldAtRest.h"
#include "model/base/Error.h"

#include "model/base/Cancelled.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace palp {
namespace {

SensorDesign fieldDesign(Readout readout) {
  SensorDesign design = paperDesign();
  FieldLaw law;
  law.readout = readout;
  design.resistance = law;
  return design;
}

/// What a sensor of these numbers reads at rest, with noise.
Eigen::MatrixXd readingsOf(const SensorDesign& design, double noise, unsigned seed) {
  const FieldLaw& law = *design.field();
  Eigen::MatrixXd r_ohm = NetworkReading(networkAtRest(design, law), law.readout).resistances_ohm();
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  for (double& one_ohm : r_ohm.reshaped()) one_ohm *= 1 + noise * normal(engine);
  return r_ohm;
}

FieldLaw otherNumbers(Readout readout) {
  FieldLaw law;
  law.readout = readout;
  law.electrodeRadius_mm = 0.26;
  law.resistivity_ohm_mm = 1430;
  law.contact_ohm_mm2 = 120; // a third of a sphere's own resistance
  return law;
}

TEST(RestFit, FindsTheNumbersOfATwinWithinItsStatedDeviations) {
  constexpr double noise = 1e-4;
  for (const Readout readout : {Readout::Floating, Readout::VirtualGround}) {
    SensorDesign twin = fieldDesign(readout);
    twin.resistance = otherNumbers(readout);
    const FieldLaw& truth = *twin.field();
    double squares = 0;
    int count = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
      const RestFit fit = fitAtRest(fieldDesign(readout), readingsOf(twin, noise, seed), noise);
      ASSERT_TRUE(fit.keptContact.empty()) << fit.keptContact;
      const Eigen::Array3d deviations((fit.law.electrodeRadius_mm - truth.electrodeRadius_mm) / fit.radiusDeviation_mm,
                                      (fit.law.resistivity_ohm_mm - truth.resistivity_ohm_mm) /
                                          fit.resistivityDeviation_ohm_mm,
                                      (fit.law.contact_ohm_mm2 - truth.contact_ohm_mm2) / fit.contactDeviation_ohm_mm2);
      EXPECT_LT(deviations.abs().maxCoeff(), 4) << deviations; // 1 in 5000 of 36 would be beyond by chance
      squares += deviations.square().sum();
      count += 3;
      EXPECT_NEAR(fit.misfit, noise, 0.15 * noise); // 300 readings: 4 %
      EXPECT_LT(fit.radiusDeviation_mm, 0.02 * truth.electrodeRadius_mm);
    }
    // Neither too bold nor too shy: rms deviation of 6 fits whose three numbers go together.
    EXPECT_GT(std::sqrt(squares / count), 0.4);
    EXPECT_LT(std::sqrt(squares / count), 1.8);
  }
}

TEST(RestFit, KeepsTheContactWhereItCannotBeToldFromTheRadius) {
  SensorDesign design = fieldDesign(Readout::VirtualGround);
  const RestFit fit = fitAtRest(design, readingsOf(design, 0.02, 1), 0.02);
  EXPECT_EQ(fit.contactDeviation_ohm_mm2, 0);
  EXPECT_FALSE(fit.keptContact.empty());
  EXPECT_EQ(fit.law.contact_ohm_mm2, 0);
  EXPECT_LT(std::abs(fit.law.electrodeRadius_mm - 0.2), 4 * fit.radiusDeviation_mm);
}

TEST(RestFit, KeepsTheContactThatTheDesignSays) {
  SensorDesign design = fieldDesign(Readout::VirtualGround);
  FieldLaw law = *design.field();
  law.contact_ohm_mm2 = 120;
  design.resistance = law;
  const RestFit fit = fitAtRest(design, readingsOf(design, 0.02, 1), 0.02);
  ASSERT_FALSE(fit.keptContact.empty());
  EXPECT_NEAR(fit.law.contact_ohm_mm2, 120, 1e-9);
  EXPECT_LT(std::abs(fit.law.electrodeRadius_mm - 0.2), 4 * fit.radiusDeviation_mm);
}

TEST(RestFit, WantsNoContactBelowZero) {
  SensorDesign design = fieldDesign(Readout::VirtualGround);
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const RestFit fit = fitAtRest(design, readingsOf(design, 1e-4, seed), 1e-4);
    EXPECT_GE(fit.law.contact_ohm_mm2, 0);
    EXPECT_NEAR(fit.law.resistivity_ohm_mm, 2000, 2);
  }
}

TEST(RestFit, PassesOverReadingsThatAreNotThere) {
  SensorDesign twin = fieldDesign(Readout::VirtualGround);
  twin.resistance = otherNumbers(Readout::VirtualGround);
  Eigen::MatrixXd readings = readingsOf(twin, 1e-4, 2);
  readings(3, 7) = readings(9, 29) = std::numeric_limits<double>::quiet_NaN();
  const RestFit fit = fitAtRest(fieldDesign(Readout::VirtualGround), readings, 1e-4);
  EXPECT_EQ(fit.readings, 298);
  EXPECT_TRUE(std::isnan(fit.left(3, 7)));
  EXPECT_NEAR(fit.law.resistivity_ohm_mm, 1430, 4 * fit.resistivityDeviation_ohm_mm);
}

TEST(RestFit, SaysWhichReadOutABoardLikelyHas) {
  const SensorDesign design = fieldDesign(Readout::VirtualGround);
  const Eigen::MatrixXd readings = readingsOf(fieldDesign(Readout::Floating), 1e-4, 1);
  const RestFit fit = fitAtRest(design, readings, 1e-4);
  const std::string why = whyNoFit(fit, design, readings, 1e-4);
  EXPECT_NE(why.find("read-out floating leaves"), std::string::npos) << why;
  EXPECT_NE(why.find("virtual_ground"), std::string::npos) << why;
}

TEST(RestFit, NamesTheWireThatDoesNotFit) {
  const SensorDesign design = fieldDesign(Readout::VirtualGround);
  Eigen::MatrixXd readings = readingsOf(design, 1e-4, 1);
  EXPECT_EQ(whyNoFit(fitAtRest(design, readings, 1e-4), design, readings, 1e-4), "");
  readings.row(6) *= 1.5;
  const std::string why = whyNoFit(fitAtRest(design, readings, 1e-4), design, readings, 1e-4);
  EXPECT_NE(why.find("row-wire 6"), std::string::npos) << why;
}

TEST(RestFit, RefusesWhatCannotBeFitted) {
  const SensorDesign design = fieldDesign(Readout::Floating);
  Eigen::MatrixXd readings = readingsOf(design, 0, 1);
  EXPECT_THROW(fitAtRest(paperDesign(), readings, 0), Error);
  EXPECT_THROW(fitAtRest(design, readings.topRows(9), 0), Error);
  readings(0, 0) = 0;
  EXPECT_THROW(fitAtRest(design, readings, 0), Error);
  readings.setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW(fitAtRest(design, readings, 0), Error);
}

TEST(RestFit, IsStopped) {
  const SensorDesign design = fieldDesign(Readout::VirtualGround);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(fitAtRest(design, readingsOf(design, 1e-4, 1), 1e-4, stop.get_token()), Cancelled);
}

} // namespace
} // namespace palp
