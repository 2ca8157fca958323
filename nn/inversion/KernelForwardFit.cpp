#include "model/base/GotExpected.h"
#include "nn/inversion/KernelInversion.h"

#include "model/base/Cancelled.h"
#include "nn/NetworkError.h"
#include "nn/inversion/ForwardProcess.h"
#include "nn/linear/RandomNumbers.h"

#include <algorithm>
#include <numeric>

namespace palp {

namespace {

constexpr Eigen::Index kHeldOut = 5; // one sample of this number

/// The quantile of the sizes at this share: at 0.683 one standard deviation of normal ones.
double quantile(double share, std::vector<double> sizes) {
  if (sizes.empty()) return 1;
  const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(sizes.size()));
  std::nth_element(sizes.begin(), at, sizes.end());
  return *at;
}

} // namespace

KernelForwardFit fitKernelForwardModel(const Eigen::Ref<const Eigen::MatrixXd>& measurements,
                                       const Eigen::Ref<const Eigen::MatrixXd>& parameters,
                                       const Eigen::VectorXi& groups, const KernelForwardOptions& options,
                                       const std::stop_token& stop) {
  if (measurements.cols() != parameters.cols() || parameters.rows() != groups.size() || parameters.cols() < kHeldOut)
    throw NetworkError("samples: " + gotExpected(std::to_string(parameters.cols()),
                                                 std::to_string(kHeldOut) +
                                                     " or more for a forward model of touches, with a column of "
                                                     "parameters for each"));
  const Eigen::MatrixXd allMeasurements = measurements, allParameters = parameters;
  ForwardProcess work(allMeasurements, allParameters, groups, options, stop);
  work.chooseSmoothness();
  KernelForwardFit result;
  result.width = work.width();
  std::vector<Eigen::Index> rest, all(static_cast<std::size_t>(parameters.cols()));
  std::iota(all.begin(), all.end(), Eigen::Index(0));
  for (const Eigen::Index i : all) (i % kHeldOut == kHeldOut - 1 ? result.heldOut : rest).push_back(i);
  // The inflation of the deviations, from samples that the model has not been fitted to.
  const KernelForwardModel some = work.modelOf(rest);
  const KernelInversion inversion(some);
  RandomNumbers random(1);
  result.heldOutResiduals.resize(parameters.rows(), static_cast<Eigen::Index>(result.heldOut.size()));
  std::vector<double> residuals;
  std::vector<std::vector<double>> sizes(static_cast<std::size_t>(parameters.rows()));
  for (std::size_t i = 0; i < result.heldOut.size(); ++i) {
    if (stop.stop_requested()) throw Cancelled();
    const Eigen::VectorXd truth = parameters.col(result.heldOut[i]);
    Eigen::VectorXd reading = measurements.col(result.heldOut[i]);
    for (double& value : reading) value *= 1 + options.relativeNoise * random.normal(); // as they will come
    const KernelEstimate estimate = inversion.estimate(reading);
    residuals.push_back(estimate.chiSquare);
    const Eigen::VectorXd off = result.heldOutResiduals.col(static_cast<Eigen::Index>(i)) = truth - estimate.parameters;
    for (Eigen::Index k = 0; k < off.size(); ++k)
      if (estimate.standardDeviation(k) > 0)
        sizes[static_cast<std::size_t>(k)].push_back(std::abs(off(k)) / estimate.standardDeviation(k));
  }
  result.model = work.modelOf(all);
  result.model.residualLimit = quantile(0.99, std::move(residuals));
  for (std::size_t k = 0; k < sizes.size(); ++k)
    result.model.inflation(static_cast<Eigen::Index>(k)) = quantile(0.683, std::move(sizes[k]));
  return result;
}

} // namespace palp
