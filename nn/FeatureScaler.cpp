#include "nn/FeatureScaler.h"

#include "model/base/GotExpected.h"
#include "nn/NetworkError.h"
#include "nn/linear/Lapack.h"

#include <cassert>
#include <cmath>

namespace palp {
namespace {

/// Relative to its size, an input whose range is below this does not vary: the rest is rounding.
constexpr double kNoVariation = 1e-14;
/// Components smaller than this share of the noise carry a hundredth of its variance and less; without noise, those
/// smaller than the second number against the largest are rounding.
constexpr double kLeastOfNoise = 0.1;
constexpr double kLeastOfLargest = 1e-10;
constexpr double kDefaultPower = 0.5;

double inverseOrZero(double value, double size) {
  return value > kNoVariation * size && value > 0 ? 1 / value : 0;
}

} // namespace

FeatureScaler FeatureScaler::fit(Scaling scaling, const Eigen::Ref<const Eigen::MatrixXd>& samples) {
  if (samples.cols() == 0) throw NetworkError("samples: " + gotExpected("0", "1 or more to fit a scaler"));
  if (scaling == Scaling::Whiten) return whitened(samples, 0, kDefaultPower);
  FeatureScaler result;
  result.scaling = scaling;
  const Eigen::Index inputs = samples.rows();
  result.offset = Eigen::VectorXd::Zero(inputs);
  result.factor = Eigen::VectorXd::Ones(inputs);
  if (scaling == Scaling::Raw || inputs == 0) return result;

  const Eigen::VectorXd low = samples.rowwise().minCoeff();
  const Eigen::VectorXd high = samples.rowwise().maxCoeff();
  const Eigen::VectorXd size = low.cwiseAbs().cwiseMax(high.cwiseAbs());
  const Eigen::VectorXd mean = samples.rowwise().mean();
  const Eigen::VectorXd halfRange = (high - low) / 2;
  result.offset = scaling == Scaling::MinMax ? Eigen::VectorXd((low + high) / 2) : mean;
  const double globalFactor = inverseOrZero((samples.colwise() - mean).colwise().norm().maxCoeff(), 0);
  for (Eigen::Index i = 0; i < inputs; ++i) {
    const double ownFactor = inverseOrZero(halfRange(i), size(i));
    if (scaling == Scaling::MinMax || ownFactor == 0)
      result.factor(i) = ownFactor;
    else if (scaling == Scaling::Global)
      result.factor(i) = globalFactor;
    else
      result.factor(i) = 1 / std::sqrt((samples.row(i).array() - mean(i)).square().mean());
  }
  return result;
}

FeatureScaler FeatureScaler::whitened(const Eigen::Ref<const Eigen::MatrixXd>& samples, double relativeNoise,
                                      double power) {
  if (samples.cols() == 0) throw NetworkError("samples: " + gotExpected("0", "1 or more to fit a scaler"));
  FeatureScaler result;
  result.scaling = Scaling::Whiten;
  result.offset = samples.rowwise().mean();
  const double count = static_cast<double>(samples.cols());
  const Eigen::VectorXd size = (samples.cwiseAbs2().rowwise().sum() / count).cwiseSqrt();
  const Eigen::VectorXd range = samples.rowwise().maxCoeff() - samples.rowwise().minCoeff();
  result.factor = size.unaryExpr([](double s) { return inverseOrZero(s, 0); });
  for (Eigen::Index i = 0; i < size.size(); ++i)
    if (!(range(i) > kNoVariation * size(i))) result.factor(i) = 0;
  const lapack::ThinSvd svd = lapack::thinSvd(result.apply(samples));
  const Eigen::VectorXd deviation = svd.values / std::sqrt(count);
  const double least = std::max(kLeastOfNoise * relativeNoise, kLeastOfLargest * deviation(0));
  Eigen::Index kept = 0;
  while (kept < deviation.size() && deviation(kept) > least) ++kept;
  if (kept == 0) kept = 1; // nothing exceeds the noise: keep the strongest direction
  const Eigen::VectorXd weight = deviation.head(kept).unaryExpr([&](double s) {
    const double sum = s * s + relativeNoise * relativeNoise;
    return sum > 0 ? s * std::pow(sum, -(1 + power) / 2) : 0.0;
  });
  result.rotation = weight.asDiagonal() * svd.u.leftCols(kept).transpose();
  result.rotation *= inverseOrZero(result.apply(samples).colwise().norm().maxCoeff(), 0);
  return result;
}

Eigen::MatrixXd FeatureScaler::apply(const Eigen::Ref<const Eigen::MatrixXd>& samples) const {
  const Eigen::MatrixXd scaled = factor.asDiagonal() * (samples.colwise() - offset);
  return rotation.size() > 0 ? lapack::product(rotation, false, scaled, false) : scaled;
}

Eigen::MatrixXd FeatureScaler::jacobian() const {
  if (rotation.size() > 0) return rotation * factor.asDiagonal();
  return factor.asDiagonal();
}

Eigen::MatrixXd FeatureScaler::invert(const Eigen::Ref<const Eigen::MatrixXd>& scaled) const {
  assert(rotation.size() == 0 && "a scaler that leaves components out has no inverse");
  const Eigen::VectorXd width = factor.unaryExpr([](double f) { return f == 0 ? 0.0 : 1 / f; });
  return (width.asDiagonal() * scaled).colwise() + offset;
}

} // namespace palp
