#include "nn/measured/RowDependence.h"

#include "model/base/Cancelled.h"
#include "nn/linear/RandomNumbers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace palp {

namespace {

constexpr Eigen::Index kRowsLookedAt = 6000;
constexpr double kCorrelated = 0.4, kNoise = 3; ///< correlation above max(0.4, 3 / sqrt(n)) is one
constexpr double kClipped = 3;                  ///< errors, in their deviations
constexpr int kPairsNeeded = 30;
constexpr int kRunsNeeded = 5;
constexpr int kStretches = 5, kRunFolds = 5, kClusterFolds = 10;
constexpr Eigen::Index kMarginShare = 40; ///< of the rows, on both sides of a stretch
constexpr double kNearlyEqual = 0.02;     ///< distance of rows, of the rms distance from their mean

Eigen::MatrixXd middle(const Eigen::MatrixXd& all) {
  if (all.rows() <= kRowsLookedAt) return all;
  return all.middleRows((all.rows() - kRowsLookedAt) / 2, kRowsLookedAt);
}

/// Each column minus its mean, divided by its deviation (0: by nothing) and the root of their number.
Eigen::MatrixXd standardised(const Eigen::MatrixXd& values) {
  Eigen::MatrixXd centred = values.rowwise() - values.colwise().mean();
  for (auto column : centred.colwise()) {
    const double deviation = std::sqrt(column.squaredNorm() / static_cast<double>(column.size()));
    if (deviation > 0) column /= deviation * std::sqrt(static_cast<double>(values.cols()));
  }
  return centred;
}

/// Minus the mean, mean square length 1.
Eigen::MatrixXd unitLength(const Eigen::MatrixXd& values) {
  Eigen::MatrixXd centred = values.rowwise() - values.colwise().mean();
  const double length = std::sqrt(centred.squaredNorm() / static_cast<double>(centred.rows()));
  if (length > 0) centred /= length;
  return centred;
}

/// A line's leave-one-out errors by the ridge with the least of them, each to mean 0, deviation 1 and at most 3; empty
/// if no ridge gives any (readings that do not vary).
Eigen::MatrixXd lineErrors(const Eigen::MatrixXd& readings, const Eigen::MatrixXd& targets,
                           const std::stop_token& stop) {
  const GroupRidge line(standardised(readings), targets);
  const Eigen::RowVectorXd variance =
      (targets.rowwise() - targets.colwise().mean()).colwise().squaredNorm() / static_cast<double>(targets.rows());
  Eigen::MatrixXd best;
  double least = std::numeric_limits<double>::infinity();
  for (int exponent = -8; exponent < 0; ++exponent) {
    throwIfStopped(stop);
    Eigen::MatrixXd errors = line.singleRowErrors(std::pow(10.0, exponent));
    double score = 0;
    for (Eigen::Index j = 0; j < errors.cols(); ++j)
      if (variance(j) > 0) score += errors.col(j).squaredNorm() / variance(j);
    if (!(score < least)) continue;
    least = score;
    best = std::move(errors);
  }
  for (auto column : best.colwise()) {
    column.array() -= column.mean();
    const double deviation = std::sqrt(column.squaredNorm() / static_cast<double>(column.size()));
    if (deviation > 0) column = (column / deviation).cwiseMax(-kClipped).cwiseMin(kClipped);
  }
  return best;
}

double neighbourCorrelation(const Eigen::MatrixXd& errors, const Eigen::VectorXi& runs) {
  if (errors.size() == 0) return 0;
  double largest = 0;
  const double all = errors.array().square().mean();
  for (const Eigen::Index step : {1, 2, 5, 10, 20, 50}) {
    if (step >= errors.rows() / 4) continue;
    double sum = 0;
    int pairs = 0;
    for (Eigen::Index i = step; i < errors.rows(); ++i) {
      if (runs(i) != runs(i - step)) continue;
      sum += errors.row(i).dot(errors.row(i - step)) / static_cast<double>(errors.cols());
      ++pairs;
    }
    if (pairs > kPairsNeeded && all > 0) largest = std::max(largest, sum / pairs / all);
  }
  return largest;
}

RowNumbers range(Eigen::Index first, Eigen::Index end) {
  RowNumbers rows(static_cast<std::size_t>(end - first));
  std::iota(rows.begin(), rows.end(), first);
  return rows;
}

/// RowNumbers by the fold that `foldOf` gives each.
template <class FoldOf> std::vector<Fold> dealt(Eigen::Index rows, int count, const FoldOf& foldOf) {
  std::vector<Fold> folds(static_cast<std::size_t>(count));
  for (Eigen::Index i = 0; i < rows; ++i) folds[static_cast<std::size_t>(foldOf(i))].leftOut.push_back(i);
  std::erase_if(folds, [](const Fold& fold) { return fold.leftOut.empty(); });
  for (Fold& fold : folds) fold.judged = fold.leftOut;
  return folds;
}

std::vector<Fold> stretches(Eigen::Index rows) {
  std::vector<Fold> folds;
  const Eigen::Index margin = rows / kMarginShare;
  for (int k = 0; k < kStretches; ++k) {
    const auto cut = [rows](int at) {
      return static_cast<Eigen::Index>(std::nearbyint(static_cast<double>(rows) * at / kStretches));
    };
    const Eigen::Index first = cut(k), end = cut(k + 1);
    if (end > first)
      folds.push_back(
          {range(std::max<Eigen::Index>(0, first - margin), std::min(rows, end + margin)), range(first, end)});
  }
  return folds;
}

std::vector<Fold> foldsOfClusters(const MeasuredRows& rows) {
  const Eigen::VectorXi cluster = nearlyEqualRows(rows.readings, rows.targets);
  std::vector<int> fold(static_cast<std::size_t>(cluster.maxCoeff()) + 1);
  std::iota(fold.begin(), fold.end(), 0);
  RandomNumbers random(0);
  for (std::size_t i = fold.size(); i > 1; --i) std::swap(fold[i - 1], fold[random.below(i)]);
  return dealt(rows.size(), kClusterFolds,
               [&](Eigen::Index i) { return fold[static_cast<std::size_t>(cluster(i))] % kClusterFolds; });
}

} // namespace

int MeasuredRows::runCount() const {
  int count = 0;
  for (Eigen::Index i = 0; i < runs.size(); ++i)
    if (i == 0 || runs(i) != runs(i - 1)) ++count;
  return count;
}

Eigen::VectorXi nearlyEqualRows(const Eigen::MatrixXd& readings, const Eigen::MatrixXd& targets) {
  const Eigen::MatrixXd p = unitLength(readings), q = unitLength(targets);
  std::vector<Eigen::Index> order = range(0, p.rows());
  std::stable_sort(order.begin(), order.end(), [&p](Eigen::Index a, Eigen::Index b) { return p(a, 0) < p(b, 0); });
  constexpr double square = kNearlyEqual * kNearlyEqual;
  std::vector<Eigen::Index> leaders;
  Eigen::VectorXi cluster(p.rows());
  std::size_t near = 0;
  for (const Eigen::Index i : order) {
    while (near < leaders.size() && p(leaders[near], 0) < p(i, 0) - kNearlyEqual) ++near;
    std::size_t found = near;
    while (found < leaders.size() && !((p.row(leaders[found]) - p.row(i)).squaredNorm() < square &&
                                       (q.row(leaders[found]) - q.row(i)).squaredNorm() < square))
      ++found;
    if (found == leaders.size()) leaders.push_back(i);
    cluster(i) = static_cast<int>(found);
  }
  return cluster;
}

RowDependence findDependence(const MeasuredRows& rows, const std::optional<RowOrder>& order,
                             const std::stop_token& stop) {
  RowDependence found;
  const Eigen::MatrixXd readings = middle(rows.readings), targets = middle(rows.targets);
  const Eigen::Index first = (rows.size() - readings.rows()) / 2;
  const Eigen::VectorXi runs = rows.runs.segment(first, readings.rows());
  const auto count = static_cast<double>(readings.rows());
  if (readings.rows() > 1) found.correlation = neighbourCorrelation(lineErrors(readings, targets, stop), runs);
  throwIfStopped(stop);
  found.leaders = (nearlyEqualRows(readings, targets).maxCoeff() + 1) / count;
  if (order)
    found.order = *order;
  else if (rows.runCount() >= kRunsNeeded)
    found.order = RowOrder::Runs;
  else if (found.correlation > std::max(kCorrelated, kNoise / std::sqrt(count)))
    found.order = RowOrder::Time;
  return found;
}

std::vector<Fold> foldsFor(const MeasuredRows& rows, RowOrder order) {
  if (order == RowOrder::Time) return stretches(rows.size());
  if (order == RowOrder::Independent) return foldsOfClusters(rows);
  int run = -1;
  Eigen::VectorXi number(rows.size());
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    if (i == 0 || rows.runs(i) != rows.runs(i - 1)) ++run;
    number(i) = run;
  }
  return dealt(rows.size(), kRunFolds, [&number](Eigen::Index i) { return number(i) % kRunFolds; });
}

std::vector<Fold> foldsOfRuns(const MeasuredRows& rows) {
  std::vector<Fold> folds;
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    if (i == 0 || rows.runs(i) != rows.runs(i - 1)) folds.emplace_back();
    folds.back().leftOut.push_back(i);
    folds.back().judged.push_back(i);
  }
  return folds;
}

} // namespace palp
