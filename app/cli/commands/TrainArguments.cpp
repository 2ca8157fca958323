#include "app/cli/commands/TrainArguments.h"

#include "app/study/decoding/TrainOptionTable.h"

#include <cmath>

namespace palp {

void TrainArguments::declare(Command command, const std::set<std::string>& without) {
  for (const TrainOption& option : trainOptionTable())
    if (!without.contains(option.name))
      command.option("--" + option.name, values[option.name],
                     option.choices.empty() ? option.help : option.allowed + ": " + option.help);
}

TrainOptions TrainArguments::options() const {
  TrainOptions result;
  for (const TrainOption& option : trainOptionTable()) {
    const auto given = values.find(option.name);
    if (given == values.end() || given->second.empty() || option.set(result, given->second)) continue;
    throw UsageError("--" + option.name + ": '" + given->second + "'; allowed is " + option.allowed);
  }
  return result;
}

nlohmann::ordered_json listJson(const Eigen::VectorXd& values) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const double value : values)
    list.push_back(std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json());
  return list;
}

nlohmann::ordered_json errorJson(const PredictionError& error) {
  return {{"eq13_percent", listJson(error.eq13Percent)},
          {"eq13_floored_percent", listJson(error.eq13FlooredPercent)},
          {"mean_absolute_N", listJson(error.meanAbsolute)},
          {"rmse_percent_of_range", listJson(error.rmsePercentOfRange)}};
}

} // namespace palp
