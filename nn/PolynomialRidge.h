#pragma once

#include "nn/FeatureScaler.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace palp {

/// Least squares on all monomials up to a degree of the inputs' principal components; degree 1 on all components is
/// plain linear least squares, the baseline.
struct PolynomialRidge {
  int degree = 1;
  FeatureScaler scaler;
  Eigen::MatrixXd components;   ///< components x inputs, of the scaled inputs
  Eigen::MatrixXd coefficients; ///< outputs x monomials

  [[nodiscard]] Eigen::Index inputs() const { return scaler.offset.size(); }
  [[nodiscard]] Eigen::Index outputs() const { return coefficients.rows(); }
  [[nodiscard]] Eigen::MatrixXd predict(const Eigen::Ref<const Eigen::MatrixXd>& samples) const;
};

struct PolynomialOptions {
  int degree = 1;
  std::optional<double> ridge; ///< none: by leave-one-out
  double relativeInputNoise = 0;
  std::uint64_t seed = 1;
};

struct PolynomialFit {
  PolynomialRidge model;
  double ridge = 0;
  int components = 0;
  int monomials = 0;
  double condition = 0;
  int rank = 0;
  Eigen::MatrixXd leaveOneOutResiduals; ///< outputs x samples
  std::vector<std::string> warnings;
};

/// Throws NetworkError for data from which nothing can be made.
PolynomialFit trainPolynomial(const Eigen::Ref<const Eigen::MatrixXd>& samples,
                              const Eigen::Ref<const Eigen::MatrixXd>& targets, const PolynomialOptions& options = {});

} // namespace palp
