#pragma once

#include "nn/FeatureScaler.h"
#include "nn/measured/InputStage.h"
#include "nn/measured/RowDependence.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace palp {

/// Factor of the features of a line together with Gaussians: it is penalised 100 times less.
inline constexpr double kTail = 10;

/// Offset and factor of each input (inputs x rows): deviation 1, but an input that hardly varies is not raised by more
/// than 10 times against the largest of the first `readings`; then one factor: mean square length 1. Throws
/// NetworkError if no input varies.
FeatureScaler inputScaler(const Eigen::MatrixXd& inputs, Eigen::Index readings);

/// A line, or Gaussians of one spread on some of the samples and a line.
struct Features {
  double spread = 0; ///< 0: a line alone
  Eigen::MatrixXd centers;
  Eigen::MatrixXd basis; ///< combinations of Gaussians that are independent to rounding: centres x combinations

  /// Rows x features of scaled inputs (inputs x rows).
  [[nodiscard]] Eigen::MatrixXd at(const Eigen::MatrixXd& scaled) const;
};
/// Features with up to `most` centres, drawn from the scaled inputs (inputs x rows) by the seed.
Features featuresOf(const Eigen::MatrixXd& scaled, double spread, int most, std::uint64_t seed);

/// Every k-th row, or every k-th run where they are many, so that about `most` rows are left.
std::vector<Eigen::Index> thinnedRows(const MeasuredRows& rows, Eigen::Index most);
MeasuredRows rowsAt(const MeasuredRows& rows, const std::vector<Eigen::Index>& chosen);

/// Transforms to try: none, and the logarithm and the inverse of readings that are positive and vary much.
std::vector<ReadingTransform> transformsFor(const Eigen::MatrixXd& readings);
/// Sets of time constants [s] to try: none, and neighbours of dt, 4 dt, 16 dt, ... up to a sixteenth of the time
/// recorded.
std::vector<std::vector<double>> memoriesFor(const MeasuredRows& rows);

/// Value below which this share of the values lies, between two of them interpolated.
double percentile(Eigen::VectorXd values, double share);

} // namespace palp
