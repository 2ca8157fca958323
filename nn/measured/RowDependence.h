#pragma once

#include "model/base/NamedEnum.h"
#include "nn/measured/GroupRidge.h"

#include <Eigen/Core>

#include <optional>
#include <stop_token>
#include <vector>

namespace palp {

/// How the rows of a measured table depend on each other, which decides the rows that are left out together.
enum class RowOrder {
  Independent, ///< each row alone, or with rows that are nearly equal
  Time,        ///< neighbours are alike: stretches, with a margin on both sides
  Runs,        ///< complete runs
};
inline constexpr NamedEnum kRowOrders("order",
                                      std::array{std::pair{RowOrder::Independent, "independent"},
                                                 std::pair{RowOrder::Time, "time"}, std::pair{RowOrder::Runs, "runs"}});

/// Readings and targets of measured rows, in the order of the table.
struct MeasuredRows {
  Eigen::MatrixXd readings; ///< rows x readings
  Eigen::MatrixXd targets;  ///< rows x targets
  Eigen::VectorXd times_s;  ///< empty: no clock
  Eigen::VectorXi runs;     ///< number of each row's run, not decreasing; all 0 for one run

  [[nodiscard]] Eigen::Index size() const { return readings.rows(); }
  [[nodiscard]] int runCount() const;
};

/// What was found of it.
struct RowDependence {
  RowOrder order = RowOrder::Independent;
  double correlation = 0; ///< largest of a line's leave-one-out errors between neighbours at several distances
  double leaders = 1;     ///< share of rows that are not nearly equal to another one before
};

/// Looks at up to 6,000 neighbouring rows from the middle of the table. Runs count from five of them on; `order`
/// overrules what is detected. Throws Cancelled.
RowDependence findDependence(const MeasuredRows& rows, const std::optional<RowOrder>& order,
                             const std::stop_token& stop);

/// Rows that are nearly equal in readings and targets, whatever their order: number of each row's cluster.
Eigen::VectorXi nearlyEqualRows(const Eigen::MatrixXd& readings, const Eigen::MatrixXd& targets);

/// Folds by the order: five folds of runs, five stretches with margins, or ten folds of clusters.
std::vector<Fold> foldsFor(const MeasuredRows& rows, RowOrder order);
/// Each run in turn.
std::vector<Fold> foldsOfRuns(const MeasuredRows& rows);

} // namespace palp
