#include "app/cli/ProgressBar.h"
#include "app/cli/commands/TrainArguments.h"
#include "app/study/decoding/DecoderTraining.h"
#include "app/study/decoding/Prediction.h"
#include "app/study/paper/PaperProtocol.h"
#include "io/SampleFile.h"
#include "model/base/Cancelled.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"
#include "nn/NoisyCopies.h"
#include "nn/SpreadSweep.h"

#include <cmath>
#include <functional>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>

namespace palp {
namespace {

struct SweepArguments {
  std::string samples;
  std::string test;
  std::string spreads = "0.3:30:21";
  std::string testNoise = "0";
  TrainArguments train;
  SplitOption split;
};

/// "0.8,0.9,1" or "FROM:TO:COUNT", evenly on a logarithmic scale.
std::vector<double> spreadsOption(const std::string& value) {
  std::vector<std::string> parts;
  const bool range = value.find(':') != std::string::npos;
  std::istringstream stream(value);
  for (std::string part; std::getline(stream, part, range ? ':' : ',');) parts.push_back(part);
  const UsageError wrong =
      badValue("--spreads", value, "numbers above 0 separated by commas, or FROM:TO:COUNT, for example 0.3:30:21");
  std::vector<double> spreads;
  if (range) {
    if (parts.size() != 3) throw wrong;
    const double from = number("--spreads", parts[0]), to = number("--spreads", parts[1]);
    const int count = wholeNumber("--spreads (COUNT)", parts[2], 1, 10'000);
    if (!(from > 0 && from <= to)) throw wrong;
    return logarithmicRange(from, to, count);
  }
  for (const std::string& part : parts) {
    spreads.push_back(number("--spreads", part));
    if (!(spreads.back() > 0)) throw wrong;
  }
  if (spreads.empty()) throw wrong;
  return spreads;
}

nlohmann::ordered_json rowJson(const SweepRow& row) {
  return {{"spread", row.spread},
          {"error", errorJson(row.error)},
          {"leave_one_out_N", listJson(row.report.leaveOneOut)},
          {"ridge", row.report.ridge},
          {"condition", std::isfinite(row.report.condition) ? nlohmann::ordered_json(row.report.condition)
                                                            : nlohmann::ordered_json()},
          {"train_seconds", row.report.seconds}};
}

void print(const std::vector<SweepRow>& rows) {
  std::cout << "    spread  Eq. (13) [%] ...            RMSE [% of range] ...       condition  s\n"
            << std::setprecision(3);
  for (const SweepRow& row : rows)
    std::cout << std::setw(10) << row.spread << "  " << row.error.eq13Percent.transpose() << "  |  "
              << row.error.rmsePercentOfRange.transpose() << "  |  " << row.report.condition << "  "
              << row.report.seconds << '\n';
}

/// Training and test samples: of two files, or of one that is divided.
SplitSamples samplesOf(const SweepArguments& arguments, const std::stop_token& stop) {
  if (arguments.split.given() == !arguments.test.empty())
    throw UsageError("--test: got " +
                     std::string(arguments.test.empty() ? "neither --test nor --split" : "both --test and --split") +
                     ", expected one of them");
  SampleSet training = loadSamples(arguments.samples, stop);
  if (arguments.split.given()) return arguments.split.of(training);
  return {std::move(training), loadSamples(arguments.test, stop)};
}

/// Measured rows: transform and memory are chosen once, then each spread is trained and tested with them.
std::vector<SweepRow> sweepMeasured(const SplitSamples& samples, const TrainOptions& given,
                                    const std::vector<double>& spreads, double testNoise,
                                    const std::function<void(std::size_t)>& progress, const std::stop_token& stop) {
  const Decoder chosen = trainDecoder(samples.training, nullptr, given, stop);
  const InputStage& stage = chosen.measured->stage;
  TrainOptions options = given;
  options.order = chosen.measured->dependence.order;
  options.transform = stage.transform;
  if (!stage.hasMemory()) options.memory = "none";
  for (const double time : stage.times_s) options.memory += (options.memory.empty() ? "" : ",") + text(time);
  PredictOptions bare;
  bare.standardDeviation = bare.area = false;
  const Eigen::MatrixXd inputs =
      noisyCopies(inputsOf(samples.test, chosen.input), testNoise, 1, testSeed(options.seed), stop);
  std::vector<SweepRow> rows;
  try {
    for (const double spread : spreads) {
      options.spread = spread;
      Decoder decoder = trainDecoder(samples.training, nullptr, options, stop);
      Prediction prediction = predict(decoder, samples.test, inputs, bare);
      rows.push_back({spread, decoderError(decoder, prediction, samples.test).error, std::move(decoder.report),
                      std::move(prediction.forces_N)});
      progress(rows.size());
    }
  } catch (const Cancelled&) { // as sweepSpreads: the rows so far
  }
  return rows;
}

std::vector<SweepRow> sweepComputed(const SplitSamples& samples, const TrainOptions& options,
                                    const std::vector<double>& spreads, double testNoise,
                                    const std::function<void(std::size_t)>& progress, const std::stop_token& stop) {
  const auto& [training, test] = samples;
  DecoderInput input;
  input.kind = options.input;
  input.rowWires = training.rowWires;
  input.rows = rowsNamed(options.rows, training.rowWires);
  input.valuesPerRow = input.kind == InputKind::Displacement ? 3 * training.electrodesPerRowWire : training.columnWires;
  const SweepInput data{inputsOf(training, input), training.forces_N,
                        noisyCopies(inputsOf(test, input), testNoise, 1, testSeed(options.seed)), test.forces_N,
                        training.forces_N.rowwise().maxCoeff() - training.forces_N.rowwise().minCoeff()};
  return sweepSpreads(data, spreads, rbfOptions(options, training.size()), progress, stop);
}

Exit run(const SweepArguments& arguments, Session& session) {
  TrainOptions options = arguments.train.options();
  options.threads = session.threads;
  if (options.decoder != DecoderKind::Rbf)
    throw badValue("--decoder", name(options.decoder), "rbf, the only decoder with a spread");
  const std::vector<double> spreads = spreadsOption(arguments.spreads);
  const double testNoise = number("--test-noise", arguments.testNoise);
  if (!(testNoise >= 0 && testNoise <= 0.5))
    throw badValue("--test-noise", arguments.testNoise, "0 to 0.5 (relative standard deviation)");
  const SplitSamples samples = samplesOf(arguments, session.stop);
  if (samples.training.forces_N.rows() != samples.test.forces_N.rows())
    throw Error(arguments.test + ": forces per sample: " +
                gotExpected(std::to_string(samples.test.forces_N.rows()),
                            std::to_string(samples.training.forces_N.rows()) + ", as in the training samples"));
  takeDefaultsOf(samples.training, arguments.train.isGiven("input"), arguments.train.isGiven("rows"), options);
  auto* const sweep = trainsAsMeasured(samples.training, options) ? &sweepMeasured : &sweepComputed;
  ProgressBar bar("spreads", spreads.size());
  const std::vector<SweepRow> rows = session.stages.measure("train", [&] {
    return sweep(
        samples, options, spreads, testNoise, [&](std::size_t done) { bar.show(done); }, session.stop);
  });
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  const SweepRow* best = nullptr;
  for (const SweepRow& row : rows) {
    list.push_back(rowJson(row));
    if (!best || row.error.rmsePercentOfRange.norm() < best->error.rmsePercentOfRange.norm()) best = &row;
  }
  session.result["rows"] = list;
  session.result["best_spread"] = best ? nlohmann::ordered_json(best->spread) : nlohmann::ordered_json();
  if (best) session.warnings.insert(session.warnings.end(), best->report.warnings.begin(), best->report.warnings.end());
  if (!session.json) {
    print(rows);
    if (best) std::cout << "smallest RMSE at spread " << best->spread << '\n';
  }
  return rows.size() == spreads.size() ? Exit::Done : Exit::NoResult;
}

} // namespace

void addSweep(Cli& cli) {
  auto arguments = std::make_shared<SweepArguments>();
  Command command =
      cli.command("sweep", "Computes error, leave-one-out error, condition and time over the spread of a network.",
                  "palp sweep samples.csv --test test.csv --input resistance --mode paper --spreads 0.3:10:20",
                  [arguments](Session& session) { return run(*arguments, session); });
  command.option("samples", arguments->samples, "FILE", "sample file to train with").required();
  command.group("Sweep");
  command.option("--test", arguments->test, "FILE", "sample file to test with");
  arguments->split.declare(command);
  command.option("--spreads", arguments->spreads, "SPREADS",
                 "0.8,0.9,1 or FROM:TO:COUNT (logarithmic; default 0.3:30:21)");
  command.option("--test-noise", arguments->testNoise, "NUMBER",
                 "relative noise of the test samples, with another seed than the training (default 0)");
  arguments->train.declare(command, {"target", "spread"});
}

} // namespace palp
