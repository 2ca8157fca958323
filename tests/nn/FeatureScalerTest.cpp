#include "nn/FeatureScaler.h"

#include "nn/NetworkError.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

const Eigen::MatrixXd samples = (Eigen::MatrixXd(3, 4) << 1, 2, 3, 6, -10, 0, 10, 20, 7, 7, 7, 7).finished();

TEST(FeatureScaler, MinMaxBringsEachVaryingInputToPlusMinusOne) {
  const Eigen::MatrixXd scaled = FeatureScaler::fit(Scaling::MinMax, samples).apply(samples);
  for (const int row : {0, 1}) {
    EXPECT_DOUBLE_EQ(scaled.row(row).minCoeff(), -1);
    EXPECT_DOUBLE_EQ(scaled.row(row).maxCoeff(), 1);
  }
}

TEST(FeatureScaler, GlobalPutsTheFarthestSampleAtDistanceOneAndKeepsTheInputsProportions) {
  const Eigen::MatrixXd scaled = FeatureScaler::fit(Scaling::Global, samples).apply(samples);
  EXPECT_NEAR(scaled.colwise().norm().maxCoeff(), 1, 1e-15);
  const Eigen::VectorXd range = scaled.rowwise().maxCoeff() - scaled.rowwise().minCoeff();
  EXPECT_NEAR(range(0) / range(1), 5.0 / 30, 1e-15);
}

TEST(FeatureScaler, ZScoreGivesMeanZeroAndDeviationOne) {
  const Eigen::MatrixXd scaled = FeatureScaler::fit(Scaling::ZScore, samples).apply(samples);
  EXPECT_NEAR(scaled.row(1).mean(), 0, 1e-15);
  EXPECT_NEAR(scaled.row(1).squaredNorm() / 4, 1, 1e-15);
}

TEST(FeatureScaler, AConstantInputTellsNothing) {
  for (const Scaling scaling : {Scaling::MinMax, Scaling::ZScore, Scaling::Global})
    EXPECT_EQ(FeatureScaler::fit(scaling, samples).apply(samples).row(2).cwiseAbs().maxCoeff(), 0) << name(scaling);
}

TEST(FeatureScaler, InvertingTheScaledGivesTheSamplesBack) {
  for (const Scaling scaling : {Scaling::Raw, Scaling::MinMax, Scaling::ZScore, Scaling::Global}) {
    const FeatureScaler scaler = FeatureScaler::fit(scaling, samples);
    // Two roundings of numbers up to 20.
    EXPECT_LT((scaler.invert(scaler.apply(samples)) - samples).cwiseAbs().maxCoeff(), 1e-13) << name(scaling);
  }
}

TEST(FeatureScaler, AnUnknownNameIsRefusedWithTheKnownOnes) {
  EXPECT_EQ(scalingNamed("zscore"), Scaling::ZScore);
  EXPECT_THROW(scalingNamed("standard"), NetworkError);
}

} // namespace
} // namespace palp
