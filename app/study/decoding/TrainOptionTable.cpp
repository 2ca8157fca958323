#include "app/study/decoding/TrainOptionTable.h"

#include "model/base/NumberText.h"
#include "model/base/Text.h"

#include <cmath>
#include <type_traits>
#include <utility>

namespace palp {
namespace {

using Form = TrainOption::Form;

template <class> struct IsOptional : std::false_type {};
template <class Value> struct IsOptional<std::optional<Value>> : std::true_type {};

template <class Value> std::string numberText(Value value) {
  if constexpr (std::is_integral_v<Value>)
    return std::to_string(value);
  else
    return text(value);
}

bool hasRbf(DecoderKind kind) {
  return traits(kind).hasRbf;
}

bool isNumber(const TrainOption& option) {
  return option.form == Form::Number || option.form == Form::Share || option.form == Form::WholeNumber;
}

/// The value of a text within the option's limits; none where it has none.
std::optional<double> valueOf(const TrainOption& option, const std::string& text) {
  const std::optional<double> value = numberIn(text);
  const bool fits = value && *value >= option.low && *value <= option.high;
  if (!fits || (option.form == Form::WholeNumber && *value != std::floor(*value))) return {};
  return value;
}

/// `names`: the NamedEnum of the member.
template <class Member, class Names>
TrainOption choice(TrainOption option, Member TrainOptions::*member, const Names& names) {
  option.form = Form::Choice;
  for (const auto& [value, text] : names.all()) option.choices.emplace_back(text);
  option.allowed = names.allowed();
  option.text = [member, &names](const TrainOptions& options) -> std::string {
    if constexpr (IsOptional<Member>())
      return options.*member ? names.name(*(options.*member)) : std::string();
    else
      return names.name(options.*member);
  };
  option.set = [member, &names](TrainOptions& options, const std::string& text) {
    const auto value = names.find(text);
    if (value || (IsOptional<Member>() && text.empty()))
      if constexpr (IsOptional<Member>())
        options.*member = value;
      else
        options.*member = *value;
    else
      return false;
    return true;
  };
  return option;
}

template <class Member> TrainOption number(TrainOption option, Member TrainOptions::*member) {
  if (!isNumber(option)) option.form = Form::Number;
  option.text = [member](const TrainOptions& options) -> std::string {
    if constexpr (IsOptional<Member>())
      return options.*member ? numberText(*(options.*member)) : std::string();
    else
      return numberText(options.*member);
  };
  option.set = [member, limits = option](TrainOptions& options, const std::string& text) {
    const std::optional<double> value = valueOf(limits, text);
    if constexpr (IsOptional<Member>()) {
      if (!value && !text.empty()) return false;
      if (value)
        options.*member = static_cast<typename Member::value_type>(*value);
      else
        options.*member = {};
    } else {
      if (!value) return false;
      options.*member = static_cast<Member>(*value);
    }
    return true;
  };
  return option;
}

TrainOption rows() {
  TrainOption option{.name = "rows",
                     .key = "rows",
                     .label = "row-wires",
                     .help = "row-wires that are read: 4, or 1,4,7, or 2-5, or all (default 4, the centre)",
                     .alwaysInCommands = true,
                     .alwaysInFiles = true,
                     .inForm = false};
  option.text = [](const TrainOptions& options) { return options.rows; };
  option.set = [](TrainOptions& options, const std::string& text) {
    options.rows = text;
    return true;
  };
  return option;
}

TrainOption spread() {
  TrainOption option{.name = "spread",
                     .label = "spread",
                     .help = "of scaled inputs: auto (by leave-one-out, default) or a number above 0",
                     .low = 1e-300,
                     .high = 1e300,
                     .allowed = "auto or a number above 0",
                     .inForm = false,
                     .applies = hasRbf};
  option = number(option, &TrainOptions::spread);
  option.set = [set = option.set](TrainOptions& options, const std::string& text) {
    return set(options, text == "auto" ? std::string() : text);
  };
  return option;
}

TrainOption centers() {
  TrainOption option{.name = "centers",
                     .label = "centres",
                     .help = "all, or how many (default: the mode decides)",
                     .form = Form::WholeNumber,
                     .low = 1,
                     .high = 1'000'000,
                     .allowed = "all, or a whole number from 1 to 1000000",
                     .inForm = false,
                     .applies = hasRbf};
  option = number(option, &TrainOptions::centers);
  option.text = [text = option.text](const TrainOptions& options) {
    return options.allCenters ? std::string("all") : text(options);
  };
  option.set = [set = option.set](TrainOptions& options, const std::string& text) {
    const bool all = text == "all";
    if (!set(options, all ? std::string() : text)) return false;
    options.allCenters = all;
    return true;
  };
  return option;
}

bool isRbf(DecoderKind kind) {
  return kind == DecoderKind::Rbf;
}

TrainOption memory() {
  TrainOption option{.name = "memory",
                     .key = "memory",
                     .label = "memory",
                     .help = "of measured samples: none, or time constants in s, for example 0.1,0.4 (default: by the "
                             "validation)",
                     .inForm = false,
                     .applies = isRbf};
  option.text = [](const TrainOptions& options) { return options.memory; };
  option.set = [](TrainOptions& options, const std::string& text) { // memoryTimes_s refuses what is wrong
    options.memory = text;
    return true;
  };
  return option;
}

/// Of measured samples: what is not given is chosen by the validation.
std::vector<TrainOption> ofMeasured() {
  return {
      choice({.name = "order",
              .key = "order",
              .label = "order of the rows",
              .help = "of measured samples: how rows depend on each other (default: detected)",
              .inForm = false,
              .applies = isRbf},
             &TrainOptions::order, kRowOrders),
      choice({.name = "transform",
              .key = "transform",
              .label = "transform of the readings",
              .help = "of measured samples: what is made of each reading (default: by the validation)",
              .inForm = false,
              .applies = isRbf},
             &TrainOptions::transform, kReadingTransforms),
      memory(),
      choice({.name = "clock",
              .key = "clock",
              .label = "clock of the memory",
              .help = "of measured samples: time, or rows where these are equally spaced in time (default time)",
              .inForm = false,
              .applies = isRbf},
             &TrainOptions::clock, kMemoryClocks),
  };
}

std::vector<TrainOption> sources() {
  return {
      choice({.name = "input",
              .key = "input",
              .label = "input",
              .help = "what is read (default displacement)",
              .alwaysInCommands = true,
              .alwaysInFiles = true,
              .inForm = false},
             &TrainOptions::input, kInputKinds),
      rows(),
      choice({.name = "mode",
              .key = "mode",
              .label = "mode",
              .help = "options that are not given follow from it (default default)",
              .alwaysInCommands = true,
              .alwaysInFiles = true,
              .inForm = false},
             &TrainOptions::mode, kDecoderModes),
      choice({.name = "decoder",
              .key = "decoder",
              .label = "decoder",
              .help = "the method (default rbf)",
              .alwaysInFiles = true,
              .inForm = false},
             &TrainOptions::decoder, kDecoderKinds),
      choice({.name = "target",
              .key = "target",
              .label = "target",
              .help = "what is learned: of touches (palp sample --touch) and measured positions (palp import) the "
                      "position as well (default force)",
              .inForm = false},
             &TrainOptions::target, kDecoderTargets),
  };
}

std::vector<TrainOption> system() {
  return {
      choice({.name = "centers-by",
              .key = "centers_by",
              .label = "choice of centres",
              .help = "how centres are chosen among the samples",
              .applies = hasRbf},
             &TrainOptions::centerChoice, kCenterChoices),
      choice({.name = "solver",
              .key = "solver",
              .label = "solver",
              .help = "how the least-squares system of the weights is solved",
              .applies = hasRbf,
              .ofMode = [](const RbfOptions& mode) { return name(mode.method); }},
             &TrainOptions::solver, kLeastSquaresMethods),
      number({.name = "ridge",
              .key = "ridge",
              .label = "ridge",
              .help = "ridge of the system; not given: 0, or by leave-one-out where there is noise",
              .low = 0,
              .high = 1e100,
              .allowed = "0 or above",
              .applies = [](DecoderKind kind) { return traits(kind).hasRidge; },
              .ofMode = [](const RbfOptions& mode) { return mode.ridge ? text(*mode.ridge) : "leave-one-out"; }},
             &TrainOptions::ridge),
      choice({.name = "scaler",
              .key = "scaler",
              .label = "scaler",
              .help = "how the inputs are scaled before the spread acts on them (default: global; whiten with noise; "
                      "in mode paper as in the paper)",
              .applies = [](DecoderKind kind) { return hasRbf(kind) || kind == DecoderKind::GaussianProcess; },
              .ofMode = [](const RbfOptions& mode) { return name(mode.scaling); }},
             &TrainOptions::scaling, kScalings),
      choice({.name = "tail",
              .key = "tail",
              .label = "tail",
              .help = "what is added to the Gaussians: nothing, a bias, a linear part",
              .applies = hasRbf,
              .ofMode = [](const RbfOptions& mode) { return kTails.name(mode.tail); }},
             &TrainOptions::tail, kTails),
      choice({.name = "convention",
              .key = "convention",
              .label = "spread convention",
              .help = "what a spread means (default radbas)",
              .applies = hasRbf,
              .ofMode = [](const RbfOptions& mode) { return name(mode.convention); }},
             &TrainOptions::convention, kSpreadConventions),
  };
}

std::vector<TrainOption> noiseAndSeed() {
  return {
      number({.name = "noise",
              .key = "noise",
              .label = "noise of the training",
              .help = "relative noise of the inputs to train for (default 0)",
              .form = Form::Share,
              .low = 0,
              .high = 0.5,
              .allowed = "0 to 0.5 (relative standard deviation)",
              .alwaysInFiles = true,
              .inForm = false},
             &TrainOptions::noise),
      number({.name = "forgetting",
              .key = "forgetting",
              .label = "forgetting factor",
              .help = "of the solver rls: weight of each sample relative to the next one (default 1)",
              .low = 1e-6,
              .high = 1,
              .allowed = "above 0 up to 1",
              .applies = hasRbf},
             &TrainOptions::forgetting),
      number({.name = "seed",
              .key = "train_seed",
              .label = "seed of the training",
              .help = "seed of centres, noise and initial weights (default 1). Without noise it changes the centres "
                      "only; with a centre on every sample, the noise only",
              .form = Form::WholeNumber,
              .low = 0,
              .high = 2'147'483'647,
              .allowed = "a whole number from 0 to 2147483647",
              .alwaysInCommands = true},
             &TrainOptions::seed),
  };
}

std::vector<TrainOption> table() {
  std::vector<TrainOption> all;
  for (std::vector<TrainOption> part : {sources(), {spread(), centers()}, system(), noiseAndSeed(), ofMeasured()})
    for (TrainOption& option : part) all.push_back(std::move(option));
  for (TrainOption& option : all) option.initial = option.text(TrainOptions());
  return all;
}

} // namespace

const std::vector<TrainOption>& trainOptionTable() {
  static const std::vector<TrainOption> kTable = table();
  return kTable;
}

} // namespace palp
