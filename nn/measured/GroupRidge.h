#pragma once

#include <Eigen/Core>

#include <stop_token>
#include <vector>

namespace palp {

using RowNumbers = std::vector<Eigen::Index>;

/// RowNumbers that are left out together, and those of them whose errors are judged.
struct Fold {
  RowNumbers leftOut; ///< ascending
  RowNumbers judged;  ///< ascending, among them
};

/// Ridge regression min |y - A x - c|^2 + n lambda t |x|^2, c free, with t the mean square length of a row of A, and
/// its errors with groups of rows left out in closed form: the normal matrix without a group is that of all rows minus
/// the group's (resources/docs/numerics/measured.md).
class GroupRidge {
public:
  /// `a` is rows x features, `y` rows x outputs.
  GroupRidge(Eigen::MatrixXd a, Eigen::MatrixXd y);

  /// Solution: features x outputs, and below them the constants. Not finite where lambda is too small for double
  /// precision.
  [[nodiscard]] Eigen::MatrixXd fit(double lambda) const;
  /// y minus the prediction of a fit without the fold's rows, for all judged rows (0 elsewhere): rows x outputs for
  /// each lambda. Throws Cancelled between solutions.
  [[nodiscard]] std::vector<Eigen::MatrixXd> errors(const std::vector<Fold>& folds, const std::vector<double>& lambdas,
                                                    const std::stop_token& stop) const;
  /// The same with each single row left out: r / (1 - h).
  [[nodiscard]] Eigen::MatrixXd singleRowErrors(double lambda) const;

private:
  [[nodiscard]] Eigen::MatrixXd penalised(Eigen::MatrixXd normal, double lambda) const;

  Eigen::MatrixXd a_; ///< with a column of ones at the end
  Eigen::MatrixXd y_;
  Eigen::MatrixXd normal_, right_; ///< A^T A, A^T y
  double meanSquare_ = 0;
};

} // namespace palp
