#pragma once

#include <Eigen/Core>

#include <functional>
#include <optional>

namespace palp {

/// A vector of residuals as a function of parameters.
using ResidualsOf = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// x of min |columns x - right|; nullopt where the columns are linearly dependent (to 1e-7 of their size).
std::optional<Eigen::VectorXd> leastSquares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& right);

/// (J^T J)^-1; infinite entries where the columns are linearly dependent.
Eigen::MatrixXd inverseOfSquares(const Eigen::MatrixXd& J);

/// The derivatives of the residuals by the parameters, by central differences of 1e-6 of each.
Eigen::MatrixXd differences(const Eigen::VectorXd& at, const ResidualsOf& residuals);

struct Minimum {
  Eigen::VectorXd at;
  double squares = 0; ///< |residuals|^2
};

/// A local minimum of |residuals|^2 by the method of Levenberg and Marquardt (Eigen's, after MINPACK's lmder) from
/// `start`, which must be allowed. Steps to what is not allowed, or gives residuals that are not finite, are
/// shortened.
Minimum levenbergMarquardt(const Eigen::VectorXd& start, const ResidualsOf& residuals,
                           const std::function<bool(const Eigen::VectorXd&)>& allowed);

} // namespace palp
