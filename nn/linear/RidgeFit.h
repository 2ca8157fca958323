#pragma once

// Private to nn.

#include <Eigen/Core>

#include <optional>
#include <stop_token>

namespace palp {

/// Leave-one-out errors of least squares without fitting again (R. D. Cook, S. Weisberg, Residuals and Influence in
/// Regression, 1982, 2.2): e_g = (I - H_gg)^-1 r_g for groups g of `copies` rows that are left out together, with the
/// hat matrix H = L L^T + T T^T. `remainder` (rows x outputs) is r = (I - H) y; the result is outputs x rows.
Eigen::MatrixXd leftOutErrors(const Eigen::MatrixXd& remainder, const Eigen::MatrixXd& l, const Eigen::MatrixXd& t,
                              Eigen::Index copies);

/// min |a x + 1 c - y|^2 + ridge s1^2 |x|^2, the constant c not penalised; s1 is the largest singular value of a
/// without its columns' means.
struct RidgeFit {
  Eigen::MatrixXd x;        ///< unknowns x outputs
  Eigen::VectorXd constant; ///< outputs
  double ridge = 0;
  double condition = 0;
  int rank = 0;
  Eigen::MatrixXd residuals; ///< leave-one-out errors, outputs x samples (of each sample's first copy)
};
/// `y` is rows x outputs, in groups of `copies` rows per sample. No ridge given: by leave-one-out over 1e-13..10 times
/// the largest squared singular value.
RidgeFit ridgeFit(const Eigen::MatrixXd& a, const Eigen::MatrixXd& y, Eigen::Index copies,
                  const std::optional<double>& ridge, const std::stop_token& stop = {}, double rcond = 1e-13);

/// Every column `copies` times in a row.
Eigen::MatrixXd repeatedColumns(const Eigen::MatrixXd& columns, Eigen::Index copies);

} // namespace palp
