#pragma once

#include "nn/Basis.h"
#include "nn/FeatureScaler.h"

#include <Eigen/Core>

namespace palp {

/// F(x) = W phi(|s(x) - c|) + T s(x) + b: Gaussians on centres c, a linear tail T and a bias b, on scaled inputs s(x).
/// A plain value; RbfEvaluator evaluates it fast for live use.
struct RbfNetwork {
  FeatureScaler scaler;
  Eigen::MatrixXd centers; ///< scaled inputs x centres
  double spread = 1;
  SpreadConvention convention = SpreadConvention::Radbas;
  BasisForm form = BasisForm::Gaussian;
  Eigen::MatrixXd weights; ///< outputs x centres
  Eigen::MatrixXd tail;    ///< outputs x scaled inputs; empty: no linear tail
  Eigen::VectorXd bias;    ///< outputs; 0 if there is none

  [[nodiscard]] Eigen::Index inputs() const { return scaler.inputs(); }
  [[nodiscard]] Eigen::Index outputs() const { return weights.rows(); }
  /// Outputs x samples.
  [[nodiscard]] Eigen::MatrixXd predict(const Eigen::Ref<const Eigen::MatrixXd>& samples) const;
  /// dF/dx at one sample, outputs x inputs.
  [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::Ref<const Eigen::VectorXd>& sample) const;
};

} // namespace palp
