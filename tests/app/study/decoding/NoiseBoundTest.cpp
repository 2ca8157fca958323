#include "app/study/decoding/NoiseBound.h"

#include "model/base/Error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace palp {
namespace {

constexpr double kRest_ohm = 300;
const Eigen::Vector3d kSlope_perN{1e-3, 2e-3, 4e-4}; ///< dR/R of the column-wire that feels this force, a newton

/// A sensor of one row-wire and three column-wires, each of which feels one force and is linear in it: R = R0 (1 + s
/// F).
SampleSet linearSensor() {
  SampleSet set;
  set.rowWires = 1;
  set.columnWires = 3;
  set.electrodesPerRowWire = 1;
  set.areaCount = 1;
  const Eigen::Index size = 200; // far more than the monomials of the fit, which is exact for a line
  set.area = Eigen::VectorXi::Zero(size);
  std::mt19937_64 engine(4);
  std::uniform_real_distribution<double> side(-1, 1);
  set.forces_N = Eigen::Matrix3Xd::NullaryExpr(3, size, [&](Eigen::Index, Eigen::Index) { return side(engine); });
  set.displacements_mm.resize(0, size);
  set.resistances_ohm = kRest_ohm * (1 + (kSlope_perN.asDiagonal() * set.forces_N).array());
  return set;
}

Eigen::Array3d rangeOf(const SampleSet& set) {
  return set.forces_N.rowwise().maxCoeff() - set.forces_N.rowwise().minCoeff();
}

/// Relative noise moves R by noise * R and F by noise * R / (dR/dF): sigma over the slope, in parts of the range.
Eigen::Array3Xd deviations(const SampleSet& set, double noise) {
  const Eigen::Array3Xd share = (kSlope_perN.asDiagonal() * set.forces_N).array();
  return ((noise * (1 + share)).colwise() / (kSlope_perN.array() * rangeOf(set)));
}

TEST(NoiseBound, OfALinearSensorIsTheNoiseOverTheSlope) {
  const SampleSet set = linearSensor();
  for (const double noise : {1e-6, 1e-4, 1e-2}) {
    const NoiseBound bound = noiseBound(set, InputKind::Resistance, {0}, noise);
    const Eigen::Array3d closed = 100 * deviations(set, noise).square().rowwise().mean().sqrt();
    for (int f = 0; f < 3; ++f) // the fit of a line by a polynomial loses some digits, the eigenvalues few
      EXPECT_NEAR(bound.withoutPriorPercent(f), closed(f), 1e-6 * closed(f)) << noise;
  }
}

TEST(NoiseBound, WithPriorAddsTheInformationOfTheRange) {
  const SampleSet set = linearSensor();
  for (const double noise : {1e-6, 1e-3, 1e-1}) {
    const NoiseBound bound = noiseBound(set, InputKind::Resistance, {0}, noise);
    // 1 / sigma^2 of the reading and 12 of the prior, whose variance is range^2 / 12, add up.
    const Eigen::Array3d closed =
        100 * (deviations(set, noise).square().inverse() + 12).inverse().rowwise().mean().sqrt();
    for (int f = 0; f < 3; ++f) EXPECT_NEAR(bound.withPriorPercent(f), closed(f), 1e-6 * closed(f)) << noise;
  }
}

TEST(NoiseBound, OfMuchNoiseIsKnowingNothing) {
  const NoiseBound bound = noiseBound(linearSensor(), InputKind::Resistance, {0}, 0.99);
  for (int f = 0; f < 3; ++f) {
    EXPECT_LT(bound.withPriorPercent(f), 100 / std::sqrt(12.0)); // the deviation of a uniform density
    EXPECT_GT(bound.withPriorPercent(f), 0.999 * 100 / std::sqrt(12.0));
    EXPECT_GT(bound.withoutPriorPercent(f), 1000);
  }
}

TEST(NoiseBound, IsInfiniteWhereAForceIsNotFelt) {
  SampleSet set = linearSensor();
  set.resistances_ohm.row(2).setConstant(kRest_ohm);
  const NoiseBound bound = noiseBound(set, InputKind::Resistance, {0}, 1e-4);
  EXPECT_TRUE(std::isinf(bound.withoutPriorPercent(2)));
  EXPECT_NEAR(bound.withPriorPercent(2), 100 / std::sqrt(12.0), 1e-6);
}

TEST(NoiseBound, RefusesNoiseThatIsNone) {
  for (const double noise : {0.0, -1e-4, 1.0, std::nan("")})
    EXPECT_THROW(noiseBound(linearSensor(), InputKind::Resistance, {0}, noise), Error);
}

TEST(NoiseBound, SaysNothingWhereSamplesAreTooFewToKnowSlopes) {
  SampleSet few = linearSensor();
  ASSERT_GE(few.size(), 8);
  std::vector<Eigen::Index> five{0, 1, 2, 3, 4};
  few = samplesAt(few, five);
  few.area.setZero();
  const NoiseBound bound = noiseBound(few, InputKind::Resistance, {0}, 1e-4);
  EXPECT_TRUE(bound.withPriorPercent.array().isNaN().all()) << "the prior alone is no bound of the sensor";
  EXPECT_TRUE(bound.withoutPriorPercent.array().isNaN().all());
  EXPECT_NE(inWords(bound).find("too few samples"), std::string::npos) << inWords(bound);
}

/// As of a rig that presses and never pulls sideways: what is left is the bound of that force alone.
TEST(NoiseBound, OfAForceAloneIsThatOfASensorOfThisForce) {
  SampleSet set = linearSensor();
  const NoiseBound all = noiseBound(set, InputKind::Resistance, {0}, 1e-4);
  set.forces_N.topRows(2).setZero();
  set.resistances_ohm.topRows(2).setConstant(kRest_ohm);
  const NoiseBound bound = noiseBound(set, InputKind::Resistance, {0}, 1e-4);
  EXPECT_NEAR(bound.withoutPriorPercent(2), all.withoutPriorPercent(2), 1e-6 * all.withoutPriorPercent(2));
  EXPECT_NEAR(bound.withPriorPercent(2), all.withPriorPercent(2), 1e-6 * all.withPriorPercent(2));
  EXPECT_TRUE(bound.withPriorPercent.head<2>().array().isNaN().all());
  const std::string words = inWords(bound);
  EXPECT_TRUE(words.starts_with("without prior - - ")) << words;
  EXPECT_TRUE(words.ends_with("does not vary in the samples")) << words;
  set.forces_N.setZero();
  EXPECT_TRUE(noiseBound(set, InputKind::Resistance, {0}, 1e-4).withPriorPercent.array().isNaN().all());
}

TEST(NoiseBound, WithoutLimitSaysSo) {
  SampleSet set = linearSensor();
  set.resistances_ohm.row(2).setConstant(kRest_ohm);
  const std::string words = inWords(noiseBound(set, InputKind::Resistance, {0}, 1e-4));
  EXPECT_NE(words.find("unlimited: the readings do not determine"), std::string::npos) << words;
  EXPECT_EQ(words.find("inf "), std::string::npos) << words;
}

} // namespace
} // namespace palp
