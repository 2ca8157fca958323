#include "nn/FeatureScaler.h"

#include "nn/NetworkError.h"

#include <cmath>

namespace palp {
namespace {

/// Relative to its size, an input whose range is below this does not vary: the rest is rounding.
constexpr double noVariation = 1e-14;

double inverseOrZero(double value, double size) {
  return value > noVariation * size && value > 0 ? 1 / value : 0;
}

} // namespace

std::string name(Scaling scaling) {
  switch (scaling) {
  case Scaling::Raw:
    return "raw";
  case Scaling::MinMax:
    return "minmax";
  case Scaling::ZScore:
    return "zscore";
  case Scaling::Global:
    break;
  }
  return "global";
}

Scaling scalingNamed(const std::string& text) {
  for (const Scaling scaling : {Scaling::Raw, Scaling::MinMax, Scaling::ZScore, Scaling::Global})
    if (name(scaling) == text) return scaling;
  throw NetworkError("scaler '" + text + "': not known, allowed are raw, minmax, zscore and global");
}

FeatureScaler FeatureScaler::fit(Scaling scaling, const Eigen::Ref<const Eigen::MatrixXd>& samples) {
  if (samples.cols() == 0) throw NetworkError("there is no sample to fit a scaler to; at least 1 is needed");
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

Eigen::MatrixXd FeatureScaler::apply(const Eigen::Ref<const Eigen::MatrixXd>& samples) const {
  return factor.asDiagonal() * (samples.colwise() - offset);
}

Eigen::MatrixXd FeatureScaler::invert(const Eigen::Ref<const Eigen::MatrixXd>& scaled) const {
  const Eigen::VectorXd width = factor.unaryExpr([](double f) { return f == 0 ? 0.0 : 1 / f; });
  return (width.asDiagonal() * scaled).colwise() + offset;
}

} // namespace palp
