#include "nn/ConstantReadings.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

TEST(ConstantReadings, AreNamedWithTheirValues) {
  ConstantReadings readings;
  Eigen::MatrixXd block = Eigen::MatrixXd::Random(4, 5);
  block.row(2).setConstant(1e9);
  readings.add(block);
  readings.add(block);
  const std::string words = readings.inWords([](Eigen::Index i) { return "R" + std::to_string(i); }, "ohm");
  EXPECT_EQ(words.find("reading R2 (1e+09 ohm) has the same value in all 10 samples"), 0U) << words;
}

TEST(ConstantReadings, OfTooFewSamplesSayNothing) {
  ConstantReadings readings;
  readings.add(Eigen::MatrixXd::Ones(3, 2));
  EXPECT_EQ(readings.constant().size(), 3U);
  EXPECT_EQ(readings.inWords([](Eigen::Index) { return "R"; }, "ohm"), "");
}

} // namespace
} // namespace palp
