#pragma once

#include "io/Decoder.h"
#include "model/SampleSet.h"
#include "nn/measured/RowDependence.h"

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <stop_token>

namespace palp {

/// Readings and targets of a set of samples with their times and runs. `inputs` is inputs x samples, `targets` is
/// targets x samples.
MeasuredRows measuredRows(const SampleSet& samples, const Eigen::MatrixXd& inputs, const Eigen::MatrixXd& targets);

/// Errors of a decoder on measured rows that it was not trained on.
struct GroupedErrors {
  RowDependence dependence;
  Eigen::MatrixXd errors; ///< truth minus prediction, targets x samples; forces [N], below them x and y [mm]
};

/// Trains once for each fold of rows that depend on each other, without them, and predicts them
/// (resources/docs/numerics/measured.md). `rows` is of the same samples; `order` overrules the dependence that is
/// detected. `progress` receives the share of the folds that are done. Throws what `train` throws, and Cancelled.
GroupedErrors groupedErrors(const SampleSet& samples, const MeasuredRows& rows, const std::optional<RowOrder>& order,
                            const std::function<Decoder(const SampleSet&)>& train, const std::stop_token& stop,
                            const std::function<void(double)>& progress);

} // namespace palp
