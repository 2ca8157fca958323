#include "app/cli/MeshCostLine.h"
#include "app/cli/ProgressBar.h"
#include "app/cli/commands/TrainArguments.h"
#include "app/study/decoding/DecoderTraining.h"
#include "app/study/decoding/KnownTouches.h"
#include "app/study/decoding/NoiseBound.h"
#include "app/study/decoding/Prediction.h"
#include "app/study/decoding/measured/MeasuredWords.h"
#include "io/DecoderFile.h"
#include "io/SampleFile.h"

#include <cmath>
#include <iostream>
#include <memory>

namespace palp {
namespace {

struct TrainCommandArguments {
  std::string samples;
  std::string design;
  TrainArguments train;
  SplitOption split;
  OutputFile output;
};

nlohmann::ordered_json boundJson(const NoiseBound& bound) {
  return {{"without_prior_percent_of_range", listJson(bound.withoutPriorPercent)},
          {"with_prior_percent_of_range", listJson(bound.withPriorPercent)}};
}

void describe(const Decoder& decoder, Session& session) {
  const FitReport& report = decoder.report;
  session.result["decoder"] = name(decoder.kind);
  session.result["mode"] = name(decoder.mode);
  session.result["spread"] = report.spread;
  if (const auto* network = std::get_if<RbfNetwork>(&decoder.model)) {
    session.result["spread_convention"] = name(network->convention);
    session.result["scaler"] = name(network->scaler.scaling);
  }
  session.result["ridge"] = report.ridge;
  session.result["centers"] = report.centers;
  session.result["condition"] =
      std::isfinite(report.condition) ? nlohmann::ordered_json(report.condition) : nlohmann::ordered_json();
  session.result["rank"] = report.rank;
  session.result["largest_weight"] = report.largestWeight;
  if (decoder.measured)
    session.result["measured"] = {{"order", kRowOrders.name(decoder.measured->dependence.order)},
                                  {"correlation", decoder.measured->dependence.correlation},
                                  {"leaders", decoder.measured->dependence.leaders},
                                  {"transform", kReadingTransforms.name(decoder.measured->stage.transform)},
                                  {"memory_s", decoder.measured->stage.times_s},
                                  {"stated", listJson(decoder.measured->stated)},
                                  {"stated_relative", decoder.measured->relative},
                                  {"single_rows", listJson(decoder.measured->singleRows)}};
  session.result["leave_one_out_N"] = listJson(report.leaveOneOut);
  session.result["seconds"] = report.seconds;
  session.warnings.insert(session.warnings.end(), report.warnings.begin(), report.warnings.end());
}

void print(const Decoder& decoder, const SampleSet& samples, const Session& session) {
  const FitReport& report = decoder.report;
  for (const std::string& warning : report.warnings) std::cerr << "palp train: " << warning << '\n';
  if (decoder.measured) {
    for (const std::string& sentence :
         measuredSentences(decoder, static_cast<std::size_t>(samples.size()), samples.times_s.rows() > 0))
      std::cout << sentence << '\n';
    return;
  }
  std::cout << name(decoder.kind) << " on " << decoder.inputs() << " " << name(decoder.input.kind) << "s";
  if (decoder.kind == DecoderKind::Rbf)
    std::cout << ": " << report.centers << " centres, spread " << report.spread << " ("
              << session.result["spread_convention"].get<std::string>() << ", scaler "
              << session.result["scaler"].get<std::string>() << "), ridge " << report.ridge << ", condition "
              << report.condition << ", rank " << report.rank << ", largest weight " << report.largestWeight;
  if (!report.leftOut.empty()) std::cout << '\n' << report.leftOut;
  std::cout << "\nerror " << (report.leftOut.empty() ? "found in training" : "on later rows") << " [N"
            << (decoder.place ? ", mm" : "") << "]: " << report.leaveOneOut.transpose() << "; " << report.seconds
            << " s\n";
}

/// How well it predicts the samples that --split kept back.
void tryOn(const Decoder& decoder, const SampleSet& kept, Session& session) {
  const Prediction prediction = session.stages.measure("predict", [&] { return predict(decoder, kept); });
  const DecoderError error = decoderError(decoder, prediction, kept);
  session.result["kept_back"] = {{"samples", kept.size()}, {"error", errorJson(error.error)}};
  if (!session.json) std::cout << keptBackInWords(decoder, prediction, kept) << '\n';
}

/// Options of measured rows where none are trained.
void requireMeasured(const SampleSet& samples, const TrainOptions& options) {
  if (trainsAsMeasured(samples, options)) return;
  if (options.order && !samples.origin.imported())
    throw UsageError("--order: is for measured samples (palp import); these samples were computed");
  for (const auto& [name, given] : {std::pair{"transform", options.transform.has_value()},
                                    {"memory", !options.memory.empty()},
                                    {"clock", options.clock.has_value()}})
    if (given)
      throw UsageError("--" + std::string(name) +
                       ": is for measured samples (palp import), of decoder rbf without noise and "
                       "without options of its system; these samples are trained otherwise");
}

Exit run(const TrainCommandArguments& arguments, Session& session) {
  TrainOptions options = arguments.train.options();
  options.threads = session.threads;
  arguments.output.requireWritable();
  SampleSet samples = loadSamples(arguments.samples, session.stop);
  std::optional<SampleSet> kept;
  if (arguments.split.given()) {
    SplitSamples parts = arguments.split.of(samples);
    samples = std::move(parts.training);
    kept = std::move(parts.test);
  }
  std::optional<SensorDesign> design;
  if (!arguments.design.empty()) design = designOption(arguments.design);
  if (design && options.decoder == DecoderKind::TouchInversion && samples.hasTouches())
    printMeshCost(*design, meshOfKnownTouches(*design, samples.size()), session);
  takeDefaultsOf(samples, arguments.train.isGiven("input"), arguments.train.isGiven("rows"), options);
  requireMeasured(samples, options);
  const Decoder decoder = session.stages.measure("train", [&] {
    ProgressBar bar("training", 1000);
    return trainDecoder(samples, design ? &*design : nullptr, options, session.stop,
                        [&](double share, const std::string&) { bar.show(static_cast<std::size_t>(1000 * share)); });
  });
  writeNetwork(decoder, arguments.output.path, arguments.output.force);
  describe(decoder, session);
  session.result["file"] = arguments.output.path.string();
  if (options.noise > 0 && !samples.hasTouches() && !decoder.place) { // the bound is of forces on known areas
    const NoiseBound bound = noiseBound(samples, options.input, decoder.input.rows, options.noise);
    session.result["noise_bound"] = boundJson(bound);
    if (!session.json) std::cout << "bound of the design at this noise, % of range: " << inWords(bound) << '\n';
  }
  if (!session.json) print(decoder, samples, session);
  if (kept) tryOn(decoder, *kept, session);
  return Exit::Done;
}

} // namespace

void addTrain(Cli& cli) {
  auto arguments = std::make_shared<TrainCommandArguments>();
  Command command = cli.command("train", "Trains a network, or another decoder, with samples.",
                                "palp train samples.csv --input resistance --rows all --noise 1e-4 -o network.json",
                                [arguments](Session& session) { return run(*arguments, session); });
  command.option("samples", arguments->samples, "FILE", "sample file to train with").required();
  arguments->train.declare(command);
  arguments->split.declare(command);
  command.option("--design", arguments->design, "DESIGN",
                 "design file, or paper; two-step-gn inverts its resistance law, touch takes its prior mean from it");
  arguments->output.declare(command, "network file to write").required();
}

} // namespace palp
