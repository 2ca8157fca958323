#pragma once

#include "nn/measured/GroupRidge.h"

#include <Eigen/Core>

#include <vector>

namespace palp {

/// Standard deviation of a predicted target, sqrt(a^2 + (b |F|)^2): |F|^2 is the sum over the targets of (F_j /
/// range_j)^2.
struct DeviationLaw {
  Eigen::VectorXd a, b, range;

  /// Returns the deviations, targets x samples, from predicted targets of the same shape.
  [[nodiscard]] Eigen::MatrixXd at(const Eigen::Ref<const Eigen::MatrixXd>& predicted) const;
};

/// Fits a deviation law to the left-out errors (rows x targets) of the first `forces` targets, whose size enters it;
/// -1: all. b out of a list of shares of the range, a by bisection so that 68.3 % of the errors lie within one
/// deviation; the b for which the smaller and the larger forces have equal shares.
DeviationLaw fitDeviation(const Eigen::MatrixXd& targets, const Eigen::MatrixXd& errors, Eigen::Index forces);

/// Detects inputs far from the training inputs: their squared Mahalanobis distance exceeds `limit`.
struct TrainingEllipse {
  Eigen::VectorXd offset; ///< mean of the scaled training inputs
  Eigen::MatrixXd inverseCovariance;
  double limit = 0;

  /// Returns the squared Mahalanobis distance.
  [[nodiscard]] double distance(const Eigen::Ref<const Eigen::VectorXd>& scaled) const;
};

/// The ellipse of the scaled inputs (inputs x rows), with a limit that 99 % of the left-out rows keep to the rows that
/// stay. Throws NetworkError if no input varies.
TrainingEllipse fitEllipse(const Eigen::MatrixXd& scaled, const std::vector<Fold>& folds);

/// Errors of predictions that are limited to the range, as shares of the targets' deviations.
class Judge {
public:
  /// `targets` are rows x targets and outlive it. Throws NetworkError if none varies.
  explicit Judge(const Eigen::MatrixXd& targets);

  /// The errors (rows x targets) of the same predictions after limiting.
  [[nodiscard]] Eigen::MatrixXd limited(const Eigen::MatrixXd& errors) const;
  /// Rms over the targets that vary; infinite where an error is not a number.
  [[nodiscard]] double score(const Eigen::MatrixXd& limitedErrors) const;

private:
  const Eigen::MatrixXd& targets_;
  Eigen::RowVectorXd low_, high_; ///< limits of predictions: the range and 10 % of it on both sides
  Eigen::RowVectorXd variance_;
};

/// Root mean square of each column of errors.
Eigen::VectorXd rootMeanSquareOfColumns(const Eigen::MatrixXd& errors);

} // namespace palp
