#pragma once

#include "nn/RbfNetwork.h"

#include <Eigen/Core>

#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// Gaussian process with a squared exponential and a linear kernel; scales and noise by maximum marginal likelihood
/// (Rasmussen and Williams 2006, 5.4.1). Its mean is an RBF network; it knows its variance too.
struct GaussianProcess {
  RbfNetwork mean;
  Eigen::VectorXd outputVariance; ///< signal variance of each output
  double linearVariance = 0;      ///< of the linear kernel, against the squared exponential
  double biasVariance = 0;
  double noiseVariance = 0; ///< of the targets, against the squared exponential
  Eigen::MatrixXd factor;   ///< lower Cholesky factor of the kernel matrix with noise

  [[nodiscard]] Eigen::MatrixXd predict(const Eigen::Ref<const Eigen::MatrixXd>& samples) const {
    return mean.predict(samples);
  }
  /// Standard deviation of the latent function with the noise, outputs x samples.
  [[nodiscard]] Eigen::MatrixXd standardDeviation(const Eigen::Ref<const Eigen::MatrixXd>& samples) const;
};

struct GaussianProcessOptions {
  Scaling scaling = Scaling::Global;
  double relativeInputNoise = 0;
  std::uint64_t seed = 1;
};

struct GaussianProcessFit {
  GaussianProcess process;
  double logLikelihood = 0;
  int evaluations = 0;
  double condition = 0;
  Eigen::MatrixXd leaveOneOutResiduals;
  std::vector<std::string> warnings;
};

GaussianProcessFit trainGaussianProcess(const Eigen::Ref<const Eigen::MatrixXd>& samples,
                                        const Eigen::Ref<const Eigen::MatrixXd>& targets,
                                        const GaussianProcessOptions& options = {}, const std::stop_token& stop = {});

} // namespace palp
