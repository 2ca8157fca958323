#pragma once

#include "app/cli/Options.h"
#include "app/study/decoding/TrainOptions.h"
#include "app/study/decoding/measured/SampleSplit.h"
#include "nn/RelativeError.h"

#include <nlohmann/json.hpp>

#include <map>
#include <set>
#include <string>

namespace palp {

/// The options that train and sweep have in common: the rows of trainOptionTable().
struct TrainArguments {
  std::map<std::string, std::string> values; ///< by name; empty: not given
  /// `without`: names of options that the command does not have.
  void declare(Command command, const std::set<std::string>& without = {});
  [[nodiscard]] bool isGiven(const std::string& name) const;
  /// Throws UsageError with the option, its value and what is allowed.
  [[nodiscard]] TrainOptions options() const;
};

/// The option --split of train and sweep.
struct SplitOption {
  std::string value;

  void declare(Command command);
  [[nodiscard]] bool given() const { return !value.empty(); }
  /// Throws UsageError with the value and what is allowed, and Error where the samples cannot be divided so.
  [[nodiscard]] SplitSamples of(const SampleSet& samples) const;
};

/// { eq13_percent, eq13_floored_percent, mean_absolute_N, rmse_percent_of_range }, each [outputs]; null for infinite.
nlohmann::ordered_json errorJson(const PredictionError& error);
/// Column by column; null where a number is not finite.
nlohmann::ordered_json listJson(const Eigen::VectorXd& values);

} // namespace palp
