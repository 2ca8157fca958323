#include "app/cli/commands/TrainArguments.h"

#include "app/study/decoding/TrainOptionTable.h"

#include <cmath>

namespace palp {

namespace {

/// Of the values of an option, for --help.
const char* typeOf(TrainOption::Form form) {
  if (form == TrainOption::Form::WholeNumber) return "N";
  return form == TrainOption::Form::Number || form == TrainOption::Form::Share ? "NUMBER" : "TEXT";
}

} // namespace

void TrainArguments::declare(Command command, const std::set<std::string>& without) {
  command.group("Training");
  for (const TrainOption& option : trainOptionTable())
    if (!without.contains(option.name))
      command.option("--" + option.name, values[option.name], typeOf(option.form),
                     option.choices.empty() ? option.help : option.allowed + ": " + option.help);
}

bool TrainArguments::isGiven(const std::string& name) const {
  const auto found = values.find(name);
  return found != values.end() && !found->second.empty();
}

TrainOptions TrainArguments::options() const {
  TrainOptions result;
  for (const TrainOption& option : trainOptionTable()) {
    const auto given = values.find(option.name);
    if (given == values.end() || given->second.empty() || option.set(result, given->second)) continue;
    throw badValue("--" + option.name, given->second, option.allowed);
  }
  return result;
}

void SplitOption::declare(Command command) {
  command.option("--split", value, "SPLIT",
                 "time or runs, with a share (default 0.8): keeps the last rows, or the last runs, back from training "
                 "to test with; for example time:0.7");
}

SplitSamples SplitOption::of(const SampleSet& samples) const {
  const std::optional<SampleSplit> by = sampleSplit(value);
  if (!by) throw badValue("--split", value, "time or runs, with a share above 0 and below 1, for example time:0.7");
  return split(samples, *by);
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
