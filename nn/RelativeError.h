#pragma once

#include <Eigen/Core>

namespace palp {

/// Errors of predictions, one entry per output.
struct PredictionError {
  Eigen::VectorXd eq13Percent;        ///< Eq. (13): mean of |F' - F| / |F| x 100 %; infinite if some F is 0
  Eigen::VectorXd eq13FlooredPercent; ///< the same with |F| >= floor in the denominator
  double floor = 0;                   ///< 1/120 of the largest range: 0.05 N of the paper's 6 N
  Eigen::VectorXd meanAbsolute;       ///< in the targets' unit
  Eigen::VectorXd rmsePercentOfRange; ///< root mean square error in % of `range`
};

/// The paper's Eq. (13) and its companions; one column per sample. `range` is the targets' range (high - low), one per
/// output; if it is 0 the RMSE is given in % of 1 unit. Throws NetworkError if sizes differ or there is no sample.
PredictionError predictionError(const Eigen::Ref<const Eigen::MatrixXd>& predicted,
                                const Eigen::Ref<const Eigen::MatrixXd>& truth,
                                const Eigen::Ref<const Eigen::VectorXd>& range);

} // namespace palp
