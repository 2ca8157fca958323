#include "nn/FeatureScaler.h"

#include "model/base/Error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palp {
namespace {

const Eigen::MatrixXd threeRows = (Eigen::MatrixXd(3, 4) << 1, 2, 3, 6, -10, 0, 10, 20, 7, 7, 7, 7).finished();

TEST(FeatureScaler, MinMaxBringsEachVaryingInputToPlusMinusOne) {
  const Eigen::MatrixXd scaled = FeatureScaler::fit(Scaling::MinMax, threeRows).apply(threeRows);
  for (const int row : {0, 1}) {
    EXPECT_DOUBLE_EQ(scaled.row(row).minCoeff(), -1);
    EXPECT_DOUBLE_EQ(scaled.row(row).maxCoeff(), 1);
  }
}

TEST(FeatureScaler, GlobalPutsTheFarthestSampleAtDistanceOneAndKeepsTheInputsProportions) {
  const Eigen::MatrixXd scaled = FeatureScaler::fit(Scaling::Global, threeRows).apply(threeRows);
  EXPECT_NEAR(scaled.colwise().norm().maxCoeff(), 1, 1e-15);
  const Eigen::VectorXd range = scaled.rowwise().maxCoeff() - scaled.rowwise().minCoeff();
  EXPECT_NEAR(range(0) / range(1), 5.0 / 30, 1e-15);
}

TEST(FeatureScaler, ZScoreGivesMeanZeroAndDeviationOne) {
  const Eigen::MatrixXd scaled = FeatureScaler::fit(Scaling::ZScore, threeRows).apply(threeRows);
  EXPECT_NEAR(scaled.row(1).mean(), 0, 1e-15);
  EXPECT_NEAR(scaled.row(1).squaredNorm() / 4, 1, 1e-15);
}

TEST(FeatureScaler, AConstantInputIsScaledToZero) {
  for (const Scaling scaling : {Scaling::MinMax, Scaling::ZScore, Scaling::Global})
    EXPECT_EQ(FeatureScaler::fit(scaling, threeRows).apply(threeRows).row(2).cwiseAbs().maxCoeff(), 0) << name(scaling);
}

/// Inputs around 100: the first two directions exceed the noise of 1e-3, the third is a twentieth of it.
Eigen::MatrixXd threeDirections() {
  Eigen::MatrixXd result(3, 200);
  for (int i = 0; i < 200; ++i) {
    const double a = std::sin(1.0 * i), b = std::cos(2.3 * i), c = std::sin(5.1 * i + 1);
    result.col(i) << 100 * (1 + 0.1 * a), 100 * (1 + 0.01 * b), 100 * (1 + 5e-5 * c);
  }
  return result;
}

TEST(FeatureScaler, WhiteningRaisesSmallComponentsAndLeavesOutThoseInTheNoise) {
  const Eigen::MatrixXd inputs = threeDirections();
  for (const double power : {0.0, 0.5, 1.0}) {
    const FeatureScaler scaler = FeatureScaler::whitened(inputs, 1e-3, power);
    ASSERT_EQ(scaler.dimensions(), 2);
    const Eigen::MatrixXd scaled = scaler.apply(inputs);
    EXPECT_NEAR(scaled.colwise().norm().maxCoeff(), 1, 1e-12);
    const Eigen::VectorXd deviation = (scaled.array().square().rowwise().mean()).sqrt();
    // The deviations' ratio of 10 becomes 10^(1 - power); the noise of a seventh of the smaller one takes 1 % off.
    EXPECT_NEAR(deviation(0) / deviation(1), std::pow(10, 1 - power), 0.05 * std::pow(10, 1 - power)) << power;
    const Eigen::VectorXd step = 1e-3 * Eigen::VectorXd::Ones(3);
    const Eigen::MatrixXd moved = scaler.apply(inputs.colwise() + step);
    EXPECT_LT(((moved - scaled).colwise() - scaler.jacobian() * step).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(FeatureScaler, WhiteningCopesWithConstantInputs) {
  for (const Eigen::MatrixXd& inputs :
       {Eigen::MatrixXd(Eigen::MatrixXd::Constant(3, 4, 7)), Eigen::MatrixXd(Eigen::MatrixXd::Zero(3, 1))})
    for (const double noise : {0.0, 1e-3}) {
      const FeatureScaler scaler = FeatureScaler::whitened(inputs, noise, 0.5);
      EXPECT_EQ(scaler.apply(inputs).cwiseAbs().maxCoeff(), 0);
      EXPECT_TRUE(scaler.rotation.allFinite());
    }
}

TEST(FeatureScaler, InvertingTheScaledGivesTheSamplesBack) {
  for (const Scaling scaling : {Scaling::Raw, Scaling::MinMax, Scaling::ZScore, Scaling::Global}) {
    const FeatureScaler scaler = FeatureScaler::fit(scaling, threeRows);
    // Two roundings of numbers up to 20.
    EXPECT_LT((scaler.invert(scaler.apply(threeRows)) - threeRows).cwiseAbs().maxCoeff(), 1e-13) << name(scaling);
  }
}

TEST(FeatureScaler, AnUnknownNameIsRefusedWithTheKnownOnes) {
  EXPECT_EQ(kScalings.value("zscore"), Scaling::ZScore);
  EXPECT_THROW(static_cast<void>(kScalings.value("standard")), Error);
}

} // namespace
} // namespace palp
