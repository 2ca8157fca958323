#pragma once

#include "nn/FeatureScaler.h"

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// Feed-forward network with one hidden layer of tanh units and linear outputs.
struct BackPropagationNetwork {
  FeatureScaler inputScaler;
  FeatureScaler outputScaler;
  Eigen::MatrixXd components;    ///< components x scaled inputs: their principal directions, to variance 1
  Eigen::MatrixXd hiddenWeights; ///< hidden x components
  Eigen::VectorXd hiddenBias;
  Eigen::MatrixXd outputWeights; ///< outputs x hidden
  Eigen::VectorXd outputBias;

  [[nodiscard]] Eigen::Index inputs() const { return inputScaler.inputs(); }
  [[nodiscard]] Eigen::Index outputs() const { return outputWeights.rows(); }
  [[nodiscard]] Eigen::MatrixXd predict(const Eigen::Ref<const Eigen::MatrixXd>& samples) const;
};

struct BackPropagationOptions {
  int hidden = 20;
  int iterations = 1500;      ///< steps of the optimiser at most
  double heldOutShare = 0.15; ///< of the samples: training stops where their error no longer falls
  double relativeInputNoise = 0;
  std::uint64_t seed = 1;
};

struct BackPropagationFit {
  BackPropagationNetwork network;
  int iterations = 0;
  std::vector<double> trainingError; ///< by iteration: mean square, scaled targets
  Eigen::MatrixXd heldOutResiduals;  ///< outputs x held-out samples
  Eigen::VectorXi heldOut;           ///< which samples
  std::vector<std::string> warnings;
};

BackPropagationFit trainBackPropagation(const Eigen::Ref<const Eigen::MatrixXd>& samples,
                                        const Eigen::Ref<const Eigen::MatrixXd>& targets,
                                        const BackPropagationOptions& options = {}, const std::stop_token& stop = {},
                                        const std::function<void(double)>& progress = {});

} // namespace palp
