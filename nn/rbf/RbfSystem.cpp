#include "nn/rbf/RbfSystem.h"

#include "model/base/Cancelled.h"
#include "model/base/GotExpected.h"
#include "nn/NetworkError.h"
#include "nn/rbf/KernelSystem.h"
#include "nn/rbf/LeastSquaresSystem.h"

#include <cmath>
#include <string>

namespace palp {
namespace {

void refuse(const std::string& what, double value, const std::string& expected) {
  throw NetworkError(what + ": " + gotExpected(value, "", expected));
}

void requireFinite(const Eigen::Ref<const Eigen::MatrixXd>& values, const std::string& what) {
  for (Eigen::Index j = 0; j < values.cols(); ++j)
    for (Eigen::Index i = 0; i < values.rows(); ++i)
      if (!(std::abs(values(i, j)) <= 1e100))
        throw NetworkError(what + " " + std::to_string(i) + " of sample " + std::to_string(j) + ": " +
                           gotExpected(values(i, j), "", "-1e100 to 1e100"));
}

} // namespace

void requireUsable(const Eigen::Ref<const Eigen::MatrixXd>& samples, const Eigen::Ref<const Eigen::MatrixXd>& targets,
                   const RbfOptions& options) {
  if (samples.cols() == 0) throw NetworkError("samples: " + gotExpected("0", "1 or more"));
  if (samples.rows() == 0 || targets.rows() == 0) throw NetworkError("samples have no inputs or no outputs");
  if (samples.cols() != targets.cols())
    throw NetworkError(
        "targets: " + gotExpected(std::to_string(targets.cols()), std::to_string(samples.cols()) + ", one per sample"));
  requireFinite(samples, "input");
  requireFinite(targets, "target");
  if (options.spread && !(*options.spread > 0 && *options.spread <= 1e100))
    refuse("spread", *options.spread, "above 0 up to 1e100");
  if (options.ridge && !(*options.ridge >= 0 && *options.ridge <= 1e100))
    refuse("ridge", *options.ridge, "0 up to 1e100");
  if (options.whitening && !(*options.whitening >= 0 && *options.whitening <= 1))
    refuse("whitening", *options.whitening, "0 to 1");
  if (options.centerCount < 0) refuse("centers", options.centerCount, "1 or more");
  if (!(options.rcond >= 0 && options.rcond < 1)) refuse("rcond", options.rcond, "0 up to below 1");
  if (!(options.forgetting > 0 && options.forgetting <= 1)) refuse("forgetting", options.forgetting, "above 0 up to 1");
  if (!(options.relativeInputNoise >= 0 && options.relativeInputNoise < 1))
    refuse("noise", options.relativeInputNoise, "0 up to below 1 (relative)");
  if (!(options.tailVariance > 0 && options.tailVariance <= 1e100))
    refuse("tail variance", options.tailVariance, "above 0 up to 1e100");
  if (options.noiseCopies < 1) refuse("noise copies", options.noiseCopies, "1 or more");
}

std::unique_ptr<RbfSystem> rbfSystem(const Eigen::Ref<const Eigen::MatrixXd>& samples,
                                     const Eigen::Ref<const Eigen::MatrixXd>& targets, const RbfOptions& options,
                                     int noiseCopies, const std::stop_token& stop) {
  throwIfStopped(stop);
  const bool oneASample = options.centers == CenterChoice::Samples ||
                          (options.centerCount >= samples.cols() && options.centers != CenterChoice::KMeans);
  if (oneASample && options.relativeInputNoise == 0 && options.method != LeastSquaresMethod::Recursive)
    return std::make_unique<KernelSystem>(samples, targets, options);
  return std::make_unique<LeastSquaresSystem>(samples, targets, options, noiseCopies, stop);
}

FeatureScaler scalerFor(const RbfOptions& options, const Eigen::Ref<const Eigen::MatrixXd>& samples) {
  if (options.scaling != Scaling::Whiten) return FeatureScaler::fit(options.scaling, samples);
  return FeatureScaler::whitened(samples, options.relativeInputNoise, options.whitening.value_or(0.5));
}

LeaveOneOutResult summarised(double spread, double ridge, Eigen::MatrixXd residuals, const Eigen::MatrixXd& targets) {
  LeaveOneOutResult result;
  result.spread = spread;
  result.ridge = ridge;
  result.residuals = std::move(residuals);
  result.rms = result.residuals.array().square().rowwise().mean().sqrt();
  const Eigen::VectorXd mean = targets.rowwise().mean();
  double sum = 0;
  for (Eigen::Index o = 0; o < targets.rows(); ++o) {
    const double deviation = std::sqrt((targets.row(o).array() - mean(o)).square().mean());
    const double relative = result.rms(o) / (deviation > 0 ? deviation : 1);
    sum += relative * relative;
  }
  result.score = std::sqrt(sum / static_cast<double>(targets.rows()));
  return result;
}

} // namespace palp
