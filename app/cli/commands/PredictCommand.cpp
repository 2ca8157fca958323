#include "app/cli/MeshCostLine.h"
#include "app/cli/Options.h"
#include "app/cli/commands/TrainArguments.h"
#include "app/study/decoding/NoiseBound.h"
#include "app/study/decoding/Prediction.h"
#include "app/study/reports/map/TouchBound.h"
#include "io/AtomicFile.h"
#include "io/DecoderFile.h"
#include "io/SampleFile.h"
#include "model/TouchRange.h"
#include "model/base/Cancelled.h"
#include "model/base/GotExpected.h"
#include "model/base/NumberText.h"
#include "model/base/Text.h"
#include "nn/NoisyCopies.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace palp {
namespace {

struct PredictArguments {
  std::string network;
  std::string samples;
  std::string noise;
  std::string seed = "1";
  std::string design;
  bool bare = false;
  OutputFile output;
};

constexpr std::size_t kErrorColumn = 33; // letters before the errors of each force

nlohmann::ordered_json columnsJson(const Eigen::MatrixXd& matrix) {
  nlohmann::ordered_json columns = nlohmann::ordered_json::array();
  for (Eigen::Index i = 0; i < matrix.cols(); ++i) columns.push_back(listJson(matrix.col(i)));
  return columns;
}

/// Forces or their deviations; NaN, which is null in JSON and an empty cell in CSV, where the decoder does not give a
/// component: it never varied in the training.
Eigen::MatrixXd measured(const Decoder& decoder, Eigen::MatrixXd values) {
  for (Eigen::Index o = 0; o < values.rows(); ++o)
    if (!(decoder.high_N(o) > decoder.low_N(o))) values.row(o).setConstant(std::numeric_limits<double>::quiet_NaN());
  return values;
}

std::string cell(double value) {
  return std::isfinite(value) ? palp::text(value) : std::string();
}

std::string outputName(const Decoder& decoder, Eigen::Index output) {
  const std::string axis(1, "xyz"[output % 3]);
  return (decoder.together ? "a" + std::to_string(output / 3) + "_" : "") + "f" + axis + "_N";
}

std::string csv(const Decoder& decoder, const Prediction& prediction) {
  std::string text = "sample";
  const bool deviation = prediction.standardDeviation_N.size() > 0, area = prediction.area.size() > 0;
  for (Eigen::Index o = 0; o < decoder.outputs(); ++o) text += "," + outputName(decoder, o);
  if (deviation)
    for (Eigen::Index o = 0; o < decoder.outputs(); ++o) text += ",sd_" + outputName(decoder, o);
  const bool place = prediction.places_mm.size() > 0;
  if (place) text += deviation ? ",x_mm,y_mm,sd_x_mm,sd_y_mm" : ",x_mm,y_mm";
  text += ",outside_training_range" + std::string(area ? ",area,area_confidence" : "") +
          (prediction.pressing.empty() ? "\n" : ",pressing\n");
  const Eigen::MatrixXd forces_N = measured(decoder, prediction.forces_N);
  const Eigen::MatrixXd deviation_N = measured(decoder, prediction.standardDeviation_N);
  for (Eigen::Index i = 0; i < forces_N.cols(); ++i) {
    text += std::to_string(i);
    for (const double force : forces_N.col(i)) text += "," + cell(force);
    if (deviation)
      for (const double sd : deviation_N.col(i)) text += "," + cell(sd);
    if (place)
      for (const double at : prediction.places_mm.col(i)) text += "," + palp::text(at);
    if (place && deviation)
      for (const double sd : prediction.placeDeviation_mm.col(i)) text += "," + palp::text(sd);
    text += prediction.outsideTrainingRange[static_cast<std::size_t>(i)] ? ",1" : ",0";
    if (area) text += "," + std::to_string(prediction.area(i)) + "," + palp::text(prediction.areaConfidence(i));
    if (!prediction.pressing.empty()) text += std::string(",") + name(prediction.pressing[static_cast<std::size_t>(i)]);
    text += '\n';
  }
  return text;
}

void fill(const Decoder& decoder, const Prediction& prediction, const std::optional<DecoderError>& error,
          Session& session) {
  nlohmann::ordered_json& result = session.result;
  result["forces_N"] = columnsJson(measured(decoder, prediction.forces_N));
  result["standard_deviation_N"] = columnsJson(measured(decoder, prediction.standardDeviation_N));
  result["outside_training_range"] = prediction.outsideTrainingRange;
  if (prediction.area.size() > 0) {
    result["area"] = std::vector<int>(prediction.area.begin(), prediction.area.end());
    result["area_confidence"] = listJson(prediction.areaConfidence);
  }
  if (error) result["error"] = errorJson(error->error);
  if (error && error->rightAreas) result["right_areas"] = *error->rightAreas;
  if (prediction.places_mm.size() > 0) {
    result["place_mm"] = columnsJson(prediction.places_mm);
    result["place_standard_deviation_mm"] = columnsJson(prediction.placeDeviation_mm);
  }
  if (!prediction.pressing.empty()) {
    nlohmann::ordered_json& pressing = result["pressing"] = nlohmann::ordered_json::array();
    for (const Pressing each : prediction.pressing) pressing.push_back(name(each));
  }
  if (error && error->place) {
    result["place_error"] = {{"rms_mm", listJson(error->place->rms_mm)}, {"median_mm", error->place->median_mm}};
    if (error->place->withinOneDeviation)
      result["place_error"]["share_within_one_deviation"] = *error->place->withinOneDeviation;
  }
  result["microseconds_per_sample"] = prediction.microsecondsPerSample;
  result["decoder"] = name(decoder.kind);
}

void print(const Prediction& prediction, const std::optional<DecoderError>& error) {
  const auto count = std::count(prediction.outsideTrainingRange.begin(), prediction.outsideTrainingRange.end(), true);
  std::string floored = error ? "Eq. (13), |F| >= " + withDigits(error->error.floor, 2) + " N [%]: " : "";
  floored.resize(std::max<std::size_t>(floored.size(), kErrorColumn), ' ');
  if (error)
    std::cout << "Eq. (13) [%]:                    " << error->error.eq13Percent.transpose() << '\n'
              << floored << error->error.eq13FlooredPercent.transpose() << '\n'
              << "mean absolute error [N]:         " << error->error.meanAbsolute.transpose() << '\n'
              << "RMSE [% of training range]:      " << error->error.rmsePercentOfRange.transpose() << '\n';
  std::cout << prediction.forces_N.cols() << " samples, " << count << " outside the training range, "
            << prediction.microsecondsPerSample << " us per sample\n";
  if (error && error->place)
    std::cout << "position: rms " << error->place->rms_mm.transpose() << " mm along x, y; median distance "
              << error->place->median_mm << " mm\n";
  const auto pressing = [&](Pressing which) {
    return std::count(prediction.pressing.begin(), prediction.pressing.end(), which);
  };
  if (!prediction.pressing.empty())
    std::cout << "detected: no touch in " << pressing(Pressing::None) << ", one touch in " << pressing(Pressing::One)
              << ", unlike the training in " << pressing(Pressing::Other) << '\n';
  if (error && error->rightAreas) std::cout << "right areas: " << 100 * *error->rightAreas << " %\n";
  if (!error) std::cout << "two touches per sample: a decoder gives one, so errors are not computed\n";
}

nlohmann::ordered_json boundJson(const ErrorsOverBounds& over) {
  return {{"force_N", over.force_N},
          {"place_mm", over.place_mm},
          {"force_error_over_bound", over.forceRatio},
          {"place_error_over_bound", over.placeRatio}};
}

void printBound(const std::string& who, const ErrorsOverBounds& over) {
  std::cout << "bounds (medians), " << who << ": Fz " << over.force_N << " N, position " << over.place_mm
            << " mm; errors / bounds: Fz " << over.forceRatio << ", position " << over.placeRatio << '\n';
}

/// Errors of force and position as multiples of the Cramer-Rao bounds, for what each bound takes as known.
std::vector<std::pair<std::string, ErrorsOverBounds>> besideBounds(const SensorDesign& design, const SampleSet& samples,
                                                                   const Decoder& decoder, const Prediction& prediction,
                                                                   double noise, Session& session) {
  printMeshCost(design, meshForTouches(design, touchesOf(design), {}), session);
  const auto bounds = session.stages.measure(
      "bounds", [&] { return touchBounds(samples, design, noise, {}, session.threads, session.stop); });
  if (!bounds) throw Cancelled();
  const auto beside = [&](const std::vector<TouchDeviations>& those) {
    return errorsOverBounds(those, prediction.forces_N - samples.forces_N,
                            prediction.places_mm - samples.touchedPlaces_mm());
  };
  std::vector<std::pair<std::string, ErrorsOverBounds>> over{{"indenter known", beside(bounds->known)}};
  session.result["touch_bound"] = boundJson(over.back().second);
  if (!bounds->sizeUnknown.empty()) {
    over.emplace_back("indenter's size unknown", beside(bounds->sizeUnknown));
    session.result["touch_bound_size_unknown"] = boundJson(over.back().second);
  }
  const auto learned = learnedBounds(decoder, samples, noise, session.stop);
  if (session.stop.stop_requested()) throw Cancelled();
  if (!learned.empty()) {
    over.emplace_back("at each touch, by the learned slopes", beside(learned));
    session.result["touch_bound_learned"] = boundJson(over.back().second);
  }
  return over;
}

Exit run(const PredictArguments& arguments, Session& session) {
  if (!arguments.output.path.empty()) arguments.output.requireWritable();
  PredictOptions options;
  options.standardDeviation = options.area = !arguments.bare;
  if (!arguments.noise.empty()) {
    options.noise = number("--noise", arguments.noise);
    if (!(options.noise >= 0 && options.noise <= 0.5))
      throw badValue("--noise", arguments.noise, "0 to 0.5 (relative standard deviation)");
  }
  const int seed = wholeNumber("--seed", arguments.seed, 0, 2'147'483'647);
  std::optional<SensorDesign> design;
  if (!arguments.design.empty()) design = designOption(arguments.design);
  const Decoder decoder = readNetwork(arguments.network);
  if (design && !(decoder.place && options.noise > 0))
    throw UsageError("--design: bounds need a network of force and position, and --noise above 0");
  const SampleSet samples = loadSamples(arguments.samples, session.stop, true);
  requireReadout(decoder, samples.origin.readout, "the samples are");
  if (design && samples.secondTouch.rows() > 0)
    throw UsageError("--design: samples: " + gotExpected("two touches per sample", "one"));
  const Eigen::MatrixXd clean = inputsOf(samples, decoder.input);
  const Eigen::MatrixXd inputs = noisyCopies(clean, options.noise, 1, static_cast<std::uint64_t>(seed));
  Prediction prediction = session.stages.measure("predict", [&] { return predict(decoder, samples, inputs, options); });
  for (const std::string& warning : prediction.warnings) std::cerr << "palp predict: " << warning << '\n';
  session.warnings.insert(session.warnings.end(), prediction.warnings.begin(), prediction.warnings.end());
  throwIfStopped(session.stop);
  std::optional<DecoderError> error; // a decoder gives one touch: two have no error
  if (samples.secondTouch.rows() == 0) error = decoderError(decoder, prediction, samples);
  fill(decoder, prediction, error, session);
  if (options.noise > 0 && !samples.hasTouches() && !decoder.place) { // the bound is of forces on known areas
    const NoiseBound bound = noiseBound(samples, decoder.input.kind, decoder.input.rows, options.noise);
    session.result["noise_bound"] = {{"without_prior_percent_of_range", listJson(bound.withoutPriorPercent)},
                                     {"with_prior_percent_of_range", listJson(bound.withPriorPercent)}};
  }
  std::vector<std::pair<std::string, ErrorsOverBounds>> bounds;
  if (design) bounds = besideBounds(*design, samples, decoder, prediction, options.noise, session);
  throwIfStopped(session.stop);
  if (!arguments.output.path.empty()) {
    writeFile(arguments.output.path, csv(decoder, prediction), arguments.output.force);
    session.result["file"] = arguments.output.path.string();
  }
  if (session.json) return Exit::Done;
  print(prediction, error);
  for (const auto& [who, over] : bounds) printBound(who, over);
  return Exit::Done;
}

} // namespace

void addPredict(Cli& cli) {
  auto arguments = std::make_shared<PredictArguments>();
  Command command = cli.command("predict", "Predicts the forces of samples with a trained network, and its error.",
                                "palp predict network.json test.csv --noise 1e-4 -o forces.csv",
                                [arguments](Session& session) { return run(*arguments, session); });
  command.option("network", arguments->network, "FILE", "network file").required();
  command.option("samples", arguments->samples, "FILE", "sample file").required();
  command.group("Noise");
  command.option("--noise", arguments->noise, "NUMBER",
                 "relative noise added to the samples and included in the standard deviations (default 0)");
  command.option("--seed", arguments->seed, "N", "seed of the noise (default 1)");
  command.group("Bounds");
  command.option("--design", arguments->design, "DESIGN",
                 "design of samples of touches: compares the errors of force and position with their bounds");
  command.group("Output");
  command.flag("--bare", arguments->bare, "forces only: no standard deviations, no areas");
  arguments->output.declare(command, "CSV file to write the forces to");
}

} // namespace palp
