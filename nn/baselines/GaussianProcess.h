#pragma once

#include "nn/RbfNetwork.h"

#include <Eigen/Core>

#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// Gaussian process with a squared exponential and a linear kernel; scales and noise by maximum marginal likelihood
/// (Rasmussen and Williams 2006, 5.4.1). Its mean is an RBF network; it also gives its variance.
struct GaussianProcess {
  RbfNetwork mean;
  Eigen::VectorXd outputVariance; ///< of each output's squared exponential kernel
  double linearVariance = 0;      ///< of the linear kernel 1 + x.z, against the squared exponential's
  double noiseVariance = 0;       ///< of the targets, against the squared exponential's
  Eigen::MatrixXd factor;         ///< lower Cholesky factor of the kernel matrix with noise; centres as the mean's

  [[nodiscard]] Eigen::Index inputs() const { return mean.inputs(); }
  [[nodiscard]] Eigen::Index outputs() const { return mean.outputs(); }
  [[nodiscard]] Eigen::MatrixXd predict(const Eigen::Ref<const Eigen::MatrixXd>& samples) const {
    return mean.predict(samples);
  }
  /// Of the mean at one sample: outputs x inputs.
  [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::Ref<const Eigen::VectorXd>& sample) const {
    return mean.jacobian(sample);
  }
  /// Standard deviation of a new target (function and noise), outputs x samples.
  [[nodiscard]] Eigen::MatrixXd standardDeviation(const Eigen::Ref<const Eigen::MatrixXd>& samples) const;
};

struct GaussianProcessOptions {
  Scaling scaling = Scaling::Global;
  int mostSamples = 1000; ///< more are thinned evenly
  double relativeInputNoise = 0;
  std::uint64_t seed = 1;
};

struct GaussianProcessFit {
  GaussianProcess process;
  double logLikelihood = 0;
  int evaluations = 0; ///< of the likelihood
  double condition = 0;
  Eigen::MatrixXd leaveOneOutResiduals; ///< outputs x samples in use
  Eigen::VectorXi used;                 ///< which samples were used
  std::vector<std::string> warnings;
};

/// Throws NetworkError for data that no process can be fitted to.
GaussianProcessFit trainGaussianProcess(const Eigen::Ref<const Eigen::MatrixXd>& samples,
                                        const Eigen::Ref<const Eigen::MatrixXd>& targets,
                                        const GaussianProcessOptions& options = {}, const std::stop_token& stop = {});

} // namespace palp
