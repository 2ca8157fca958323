#include "app/cli/commands/TrainArguments.h"

#include <array>
#include <cmath>
#include <utility>

namespace palp {
namespace {

/// A name out of a list that nn or io knows; their refusal becomes one with the option.
template <class Named> auto chosen(const std::string& option, const std::string& value, Named&& named) {
  try {
    return named(value);
  } catch (const std::runtime_error& refusal) {
    throw UsageError(option + ": " + refusal.what());
  }
}

double numberIn(const std::string& option, const std::string& value, double low, double high, const char* allowed) {
  const double result = number(option, value);
  if (!(result >= low && result <= high)) throw UsageError(option + ": '" + value + "'; allowed is " + allowed);
  return result;
}

constexpr std::array centerNames{std::pair{CenterChoice::KMeans, "kmeans"}, std::pair{CenterChoice::Random, "random"}};
constexpr std::array tailNames{std::pair{Tail::None, "none"}, std::pair{Tail::Bias, "bias"},
                               std::pair{Tail::Linear, "linear"}, std::pair{Tail::LinearPenalised, "penalised"}};

template <class Names> auto oneOf(const Names& names, const std::string& value) {
  std::string allowed;
  for (const auto& [result, text] : names) {
    if (value == text) return result;
    allowed += (allowed.empty() ? "" : ", ") + std::string(text);
  }
  throw Error("'" + value + "'; allowed is " + allowed);
}

} // namespace

void TrainArguments::declare(CLI::App& command, bool withSpread) {
  command.add_option("--input", input, "displacement or resistance (default displacement)");
  command.add_option("--rows", rows, "row-wires that are read: 4, or 1,4,7, or all (default 4, the centre)");
  command.add_option("--mode", mode, "default or paper: what is not set below follows from it");
  command.add_option("--decoder", decoder,
                     "rbf (default), linear, poly2, poly3, gp, bp, two-step-bp, two-step-gn or ml");
  if (withSpread)
    command.add_option("--spread", spread, "auto (by leave-one-out, default) or a number above 0, of scaled inputs");
  command.add_option("--centers", centers, "all, or how many");
  command.add_option("--centers-by", centersBy, "kmeans or random (default: as the mode says)");
  command.add_option("--solver", solver, "qr, cholesky, svd or rls");
  command.add_option("--ridge", ridge, "0 or above; not given: 0, or by leave-one-out where there is noise");
  command.add_option(
      "--scaler", scaler,
      "raw, minmax, zscore, global or whiten (default: global; whiten with noise; in mode paper as in it)");
  command.add_option("--tail", tail, "none, bias, linear or penalised");
  command.add_option("--convention", convention, "what a spread means: radbas (default) or sigma");
  command.add_option("--noise", noise, "relative noise of the inputs to train for (default 0)");
  command.add_option("--forgetting", forgetting, "of rls, above 0 up to 1 (default 1)");
  command.add_option("--seed", seed, "of centres, noise and starts (default 1)");
}

TrainOptions TrainArguments::options() const {
  TrainOptions result;
  result.input = chosen("--input", input, inputKindNamed);
  result.rows = rows;
  result.mode = chosen("--mode", mode, decoderModeNamed);
  result.decoder = chosen("--decoder", decoder, decoderKindNamed);
  if (spread != "auto") {
    result.spread = number("--spread", spread);
    if (!(*result.spread > 0)) throw UsageError("--spread: '" + spread + "'; allowed is auto or a number above 0");
  }
  if (centers == "all")
    result.allCenters = true;
  else if (!centers.empty())
    result.centers = wholeNumber("--centers", centers, 1, 1'000'000);
  const auto named = [](const auto& names) {
    return [&names](const std::string& value) { return oneOf(names, value); };
  };
  if (!centersBy.empty()) result.centerChoice = chosen("--centers-by", centersBy, named(centerNames));
  if (!solver.empty()) result.solver = chosen("--solver", solver, leastSquaresMethodNamed);
  if (!ridge.empty()) result.ridge = numberIn("--ridge", ridge, 0, 1e100, "0 or above");
  if (!scaler.empty()) result.scaling = chosen("--scaler", scaler, scalingNamed);
  if (!tail.empty()) result.tail = chosen("--tail", tail, named(tailNames));
  if (!convention.empty()) result.convention = chosen("--convention", convention, spreadConventionNamed);
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
