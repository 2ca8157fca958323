#pragma once

// Private to study: the work behind trainDecoder.

#include "app/study/decoding/Prediction.h"

#include <functional>
#include <stop_token>
#include <string>

namespace palp {

class DecoderTraining {
public:
  /// All arguments outlive the training.
  DecoderTraining(const SampleSet& samples, const SensorDesign* design, const TrainOptions& options,
                  const std::stop_token& stop, const std::function<void(double, const std::string&)>& progress);
  Decoder run();

private:
  void describe();
  void fit();
  void fitRbf();
  void fitPolynomial(int degree);
  void fitGaussianProcess();
  void fitBackPropagation();
  void fitTwoStep(bool gaussNewton);
  void fitLikelihood();
  void tellResiduals(const Eigen::MatrixXd& residuals, const Eigen::VectorXi& areas);
  void tellAreas();
  [[nodiscard]] ForwardModel forwardModel();
  void say(double share, const std::string& what) const;

  const SampleSet& samples_;
  const SensorDesign* design_;
  const TrainOptions& options_;
  const std::stop_token& stop_;
  const std::function<void(double, const std::string&)>& progress_;
  Eigen::MatrixXd inputs_;
  Decoder decoder_;
};

} // namespace palp
