#pragma once

#include "app/cli/Options.h"
#include "app/study/decoding/TrainOptions.h"
#include "nn/RelativeError.h"

#include <nlohmann/json.hpp>

namespace palp {

/// The options that train and sweep have in common.
struct TrainArguments {
  std::string input = "displacement";
  std::string rows = "4";
  std::string mode = "default";
  std::string decoder = "rbf";
  std::string target = "force";
  std::string spread = "auto";
  std::string centers, centersBy, solver, ridge, scaler, tail, convention;
  std::string noise = "0";
  std::string forgetting = "1";
  std::string seed = "1";
  void declare(Command command, bool withSpread);
  /// UsageError names the option, its value and what is allowed.
  [[nodiscard]] TrainOptions options() const;
};

/// { eq13_percent, eq13_floored_percent, mean_absolute_N, rmse_percent_of_range }, each [outputs]; null for infinite.
nlohmann::ordered_json errorJson(const PredictionError& error);
/// Column by column; null where a number is not finite.
nlohmann::ordered_json listJson(const Eigen::VectorXd& values);

} // namespace palp
