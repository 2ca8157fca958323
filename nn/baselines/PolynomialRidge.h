#pragma once

#include "nn/FeatureScaler.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// Least squares on all monomials of the inputs up to a degree. Degree 1 is plain linear least squares, the baseline.
/// Higher degrees take the form of a kernel, F(x) = sum_i w_i (1 + s(x).s(x_i) / size)^degree + b: the same as all
/// monomials with a ridge, however many there are.
struct PolynomialRidge {
  int degree = 1;
  FeatureScaler scaler;
  double size = 1;         ///< divisor of the scaled inputs' products
  Eigen::MatrixXd centers; ///< scaled inputs x samples; degree 1: empty
  Eigen::MatrixXd weights; ///< outputs x samples; degree 1: outputs x scaled inputs
  Eigen::VectorXd bias;

  [[nodiscard]] Eigen::Index inputs() const { return scaler.inputs(); }
  [[nodiscard]] Eigen::Index outputs() const { return bias.size(); }
  /// Outputs x samples.
  [[nodiscard]] Eigen::MatrixXd predict(const Eigen::Ref<const Eigen::MatrixXd>& samples) const;
  /// dF/dx at one sample, outputs x inputs.
  [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::Ref<const Eigen::VectorXd>& sample) const;
};

struct PolynomialOptions {
  int degree = 1;
  /// Against the largest squared singular value. None: by leave-one-out; but 0 for degree 1 without noise.
  std::optional<double> ridge;
  double relativeInputNoise = 0;
  int noiseCopies = 10;
  std::uint64_t seed = 1;
};

struct PolynomialFit {
  PolynomialRidge model;
  double ridge = 0;
  double condition = 0;
  int rank = 0;
  Eigen::MatrixXd leaveOneOutResiduals; ///< outputs x samples
  std::vector<std::string> warnings;
};

/// Throws NetworkError for data from which nothing can be made.
PolynomialFit trainPolynomial(const Eigen::Ref<const Eigen::MatrixXd>& samples,
                              const Eigen::Ref<const Eigen::MatrixXd>& targets, const PolynomialOptions& options = {},
                              const std::stop_token& stop = {});

} // namespace palp
