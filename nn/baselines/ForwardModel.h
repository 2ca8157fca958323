#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace palp {

/// For each class a polynomial in the parameters y (a few numbers) that gives the measurements x (many numbers): the
/// forward direction, smooth and well-posed, which is then inverted by maximum likelihood.
struct ForwardModel {
  int degree = 4;
  Eigen::VectorXd parameterOffset, parameterFactor; ///< parameters to [-1, 1]: (y - offset) * factor
  std::vector<Eigen::MatrixXd> coefficients;        ///< one per class: measurements x monomials
  Eigen::VectorXd deviation; ///< standard deviation of each measurement: noise and the model's own error

  [[nodiscard]] Eigen::Index measurements() const { return deviation.size(); }
  [[nodiscard]] Eigen::Index parameters() const { return parameterOffset.size(); }
  [[nodiscard]] std::size_t classes() const { return coefficients.size(); }
  /// Measurements of class c under parameters y; their derivatives (measurements x parameters) on request.
  [[nodiscard]] Eigen::VectorXd measurementsOf(std::size_t c, const Eigen::Ref<const Eigen::VectorXd>& y,
                                               Eigen::MatrixXd* jacobian = nullptr) const;
};

/// Number of monomials of `parameters` variables up to `degree`, including the constant.
Eigen::Index monomialCount(Eigen::Index parameters, int degree);

struct ForwardModelOptions {
  int degree = 4;
  double relativeNoise = 0; ///< of each measurement
};

/// One column per sample; `classes` counts from 0, each class with at least one sample. The degree is lowered if a
/// class has too few samples for it (reported in `warnings`).
ForwardModel fitForwardModel(const Eigen::Ref<const Eigen::MatrixXd>& measurements,
                             const Eigen::Ref<const Eigen::MatrixXd>& parameters, const Eigen::VectorXi& classes,
                             const ForwardModelOptions& options, std::vector<std::string>* warnings = nullptr);

/// Most likely class of one measurement vector, and its parameters: maximum likelihood, with the prior knowledge that
/// each parameter has the variance of its training range (which matters only when the noise is large), averaged over
/// the classes by their probability when the class is uncertain.
struct LikelihoodEstimate {
  int classIndex = 0;
  double confidence = 1; ///< posterior probability of the class (Laplace approximation)
  Eigen::VectorXd parameters;
  Eigen::VectorXd standardDeviation;
  double chiSquare = 0; ///< mean square of the residual per measurement: 1 if model and noise fit
};
LikelihoodEstimate maximumLikelihood(const ForwardModel& model, const Eigen::Ref<const Eigen::VectorXd>& measurement);

/// The same for many measurements: keeps each class's normal equations, so that inverting one costs a tenth.
class LikelihoodInversion {
public:
  explicit LikelihoodInversion(const ForwardModel& model);
  [[nodiscard]] LikelihoodEstimate estimate(const Eigen::Ref<const Eigen::VectorXd>& measurement) const;

private:
  struct Class;
  struct Posterior;
  [[nodiscard]] Posterior posterior(const Class& c, const Eigen::VectorXd& measurement) const;

  Eigen::VectorXd parameterOffset_, parameterWidth_;
  Eigen::Index measurements_ = 0;
  Eigen::MatrixXi exponent_;
  std::vector<Class> classes_;
};

/// One class: constant + polynomial * (monomials without the constant), in units of the deviation.
struct LikelihoodInversion::Class {
  Eigen::VectorXd constant;   ///< measurements
  Eigen::VectorXd weight;     ///< 1 / deviation
  Eigen::MatrixXd polynomial; ///< measurements x monomials
  Eigen::MatrixXd gram;       ///< monomials x monomials
};

} // namespace palp
