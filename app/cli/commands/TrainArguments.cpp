#include "app/cli/commands/TrainArguments.h"

#include <cmath>

namespace palp {
namespace {

/// The value that an option names.
template <class Names> auto chosen(const std::string& option, const std::string& text, const Names& names) {
  const auto value = names.find(text);
  if (!value) throw UsageError(option + ": '" + text + "'; allowed is " + names.allowed());
  return *value;
}

double numberIn(const std::string& option, const std::string& value, double low, double high, const char* allowed) {
  const double result = number(option, value);
  if (!(result >= low && result <= high)) throw UsageError(option + ": '" + value + "'; allowed is " + allowed);
  return result;
}

} // namespace

void TrainArguments::declare(Command command, bool withSpread) {
  command.option("--input", input, kInputKinds.allowed() + " (default displacement)");
  command.option("--rows", rows, "row-wires that are read: 4, or 1,4,7, or 2-5, or all (default 4, the centre)");
  command.option("--mode", mode, kDecoderModes.allowed() + ": what is not set below follows from it");
  command.option("--decoder", decoder, kDecoderKinds.allowed() + " (default rbf)");
  if (withSpread) {
    command.option(
        "--target", target,
        kDecoderTargets.allowed() +
            ": of touches (palp sample --touch) and measured places (palp import) the place as well (default force)");
    command.option("--spread", spread, "auto (by leave-one-out, default) or a number above 0, of scaled inputs");
  }
  command.option("--centers", centers, "all, or how many");
  command.option("--centers-by", centersBy, kCenterChoices.allowed() + " (default: as the mode says)");
  command.option("--solver", solver, kLeastSquaresMethods.allowed());
  command.option("--ridge", ridge, "0 or above; not given: 0, or by leave-one-out where there is noise");
  command.option("--scaler", scaler,
                 kScalings.allowed() + " (default: global; whiten with noise; in mode paper as in it)");
  command.option("--tail", tail, kTails.allowed());
  command.option("--convention", convention,
                 "what a spread means: " + kSpreadConventions.allowed() + " (default radbas)");
  command.option("--noise", noise, "relative noise of the inputs to train for (default 0)");
  command.option("--forgetting", forgetting, "of rls, above 0 up to 1 (default 1)");
  command.option("--seed", seed, "of centres, noise and starts (default 1)");
}

TrainOptions TrainArguments::options() const {
  TrainOptions result;
  result.input = chosen("--input", input, kInputKinds);
  result.rows = rows;
  result.mode = chosen("--mode", mode, kDecoderModes);
  result.decoder = chosen("--decoder", decoder, kDecoderKinds);
  result.target = chosen("--target", target, kDecoderTargets);
  if (spread != "auto") {
    result.spread = number("--spread", spread);
    if (!(*result.spread > 0)) throw UsageError("--spread: '" + spread + "'; allowed is auto or a number above 0");
  }
  if (centers == "all")
    result.allCenters = true;
  else if (!centers.empty())
    result.centers = wholeNumber("--centers", centers, 1, 1'000'000);
  if (!centersBy.empty()) result.centerChoice = chosen("--centers-by", centersBy, kCenterChoices);
  if (!solver.empty()) result.solver = chosen("--solver", solver, kLeastSquaresMethods);
  if (!ridge.empty()) result.ridge = numberIn("--ridge", ridge, 0, 1e100, "0 or above");
  if (!scaler.empty()) result.scaling = chosen("--scaler", scaler, kScalings);
  if (!tail.empty()) result.tail = chosen("--tail", tail, kTails);
  if (!convention.empty()) result.convention = chosen("--convention", convention, kSpreadConventions);
  result.noise = numberIn("--noise", noise, 0, 0.5, "0 to 0.5 (relative standard deviation)");
  result.forgetting = numberIn("--forgetting", forgetting, 1e-6, 1, "above 0 up to 1");
  result.seed = static_cast<std::uint64_t>(wholeNumber("--seed", seed, 0, 2'147'483'647));
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
