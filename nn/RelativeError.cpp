#include "nn/RelativeError.h"

#include "model/base/GotExpected.h"
#include "nn/NetworkError.h"

#include <string>

namespace palp {

namespace {

constexpr double kFloorsInRange = 120;

} // namespace

PredictionError predictionError(const Eigen::Ref<const Eigen::MatrixXd>& predicted,
                                const Eigen::Ref<const Eigen::MatrixXd>& truth,
                                const Eigen::Ref<const Eigen::VectorXd>& range) {
  if (predicted.rows() != truth.rows() || predicted.cols() != truth.cols() || range.size() != truth.rows())
    throw NetworkError("predictions are " + std::to_string(predicted.rows()) + " x " +
                       std::to_string(predicted.cols()) + ", the truth is " + std::to_string(truth.rows()) + " x " +
                       std::to_string(truth.cols()) + ", the range has " + std::to_string(range.size()) +
                       " entries; all must agree");
  if (truth.cols() == 0) throw NetworkError("samples: " + gotExpected("0", "1 or more to measure an error"));
  const Eigen::ArrayXXd difference = (predicted - truth).array().abs();
  const Eigen::ArrayXXd size = truth.array().abs();
  PredictionError error;
  // 0 / 0 counts as 0: the force is 0 and 0 was predicted.
  error.eq13Percent = 100 * (difference == 0).select(0.0, difference / size).rowwise().mean();
  const Eigen::ArrayXd width = (range.array() > 0).select(range.array(), 1.0);
  const double largest = range.maxCoeff(); // not a width that replaces a range of 0
  error.floor = (largest > 0 ? largest : 1) / kFloorsInRange;
  error.eq13FlooredPercent = 100 * (difference / size.max(error.floor)).rowwise().mean();
  error.meanAbsolute = difference.rowwise().mean();
  error.rmsePercentOfRange = 100 * difference.square().rowwise().mean().sqrt() / width;
  return error;
}

} // namespace palp
