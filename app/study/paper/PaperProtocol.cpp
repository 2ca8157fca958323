#include "app/study/paper/PaperProtocol.h"

#include "app/study/Median.h"
#include "app/study/decoding/DecoderTraining.h"
#include "app/study/touch/SampleGenerator.h"
#include "model/base/Cancelled.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr std::uint64_t kTestSeedOffset = 1'000'000'007;

/// How one curve trains.
struct CurvePlan {
  std::string mode;
  std::string what;
  TrainOptions options;
};

struct FigurePlan {
  std::string figure;
  InputKind input;
  std::vector<double> spreads;
  double traceSpread; ///< Figs. 8-11 show spread 1, Figs. 13-16 spread 0.5
  std::vector<CurvePlan> curves;
};

FigurePlan figurePlan(const std::string& figure, int rowWires) {
  FigurePlan plan;
  plan.figure = figure;
  const bool table = figure == "table1";
  plan.input = table ? InputKind::Displacement : InputKind::Resistance;
  plan.traceSpread = table ? 1.0 : 0.5;
  if (table)
    plan.spreads = {0.8, 0.9, 1.0, 1.2, 1.5};
  else
    plan.spreads = {0.3, 0.5, 0.8, 1.0, 1.2, 1.5, 2, 3, 5, 8};

  TrainOptions options;
  options.input = plan.input;
  options.rows = std::to_string(centreRowWire(rowWires)); // the centre row-wire
  plan.curves.push_back(
      {"default", "one scale for all inputs, one centre a sample, radbas, linear tail, pivoted QR", options});
  options.mode = DecoderMode::Paper;
  plan.curves.push_back({"paper",
                         table ? "min-max to [-1, 1] for each input, one centre a sample, radbas, bias, pivoted QR"
                               : "one scale for all inputs, one centre a sample, radbas, bias, pivoted QR",
                         options});
  if (!table) {
    options.scaling = Scaling::MinMax;
    plan.curves.push_back({"paper-minmax", "as paper, but min-max to [-1, 1] for each input", options});
  }
  TrainOptions linear;
  linear.input = plan.input;
  linear.rows = options.rows;
  linear.decoder = DecoderKind::Linear;
  plan.curves.push_back({"linear", "linear least squares, the baseline", linear});
  return plan;
}

template <class Reduce> Eigen::Vector3d medianOf(const std::vector<ProtocolErrors>& errors, Reduce&& reduce) {
  std::vector<Eigen::Vector3d> values;
  for (const ProtocolErrors& error : errors) values.push_back(reduce(error));
  return median(values);
}

/// Trains, tests on every area and adds the outcome to the row.
class Experiment {
public:
  Experiment(const SensorDesign& design, const ProtocolSamples& samples, int threads, ProtocolResult& result)
      : design_(design), samples_(samples), threads_(threads), result_(result) {
    for (int area = 0; area < design.areas.count(); ++area) tests_.push_back(areaPart(samples.test, area));
  }

  void run(const FigurePlan& plan, const CurvePlan& curve, ProtocolRow& row, bool trace, const std::stop_token& stop) {
    TrainOptions options = curve.options;
    options.spread = row.spread;
    options.threads = threads_;
    const Decoder decoder =
        result_.stages.measure("train", [&] { return trainDecoder(samples_.training, &design_, options, stop); });
    row.condition.push_back(decoder.report.condition);
    if (row.errors.empty()) row.warnings = decoder.report.warnings;
    const int areas = design_.areas.count();
    ProtocolErrors errors;
    for (Eigen::Matrix3Xd* part :
         {&errors.eq13_percent, &errors.eq13Floored_percent, &errors.meanAbsolute_N, &errors.rmse_percentOfRange})
      part->resize(3, areas);
    const Eigen::Vector3d range = design_.forceRange.high_N - design_.forceRange.low_N;
    PredictOptions bare;
    bare.standardDeviation = false;
    bare.area = false;
    for (int area = 0; area < areas; ++area) {
      const SampleSet& test = tests_[static_cast<std::size_t>(area)];
      const Eigen::MatrixXd forces =
          result_.stages.measure("predict", [&] { return predict(decoder, test, bare).forces_N; });
      const PredictionError error = predictionError(forces, test.forces_N, range);
      errors.eq13_percent.col(area) = error.eq13Percent;
      errors.eq13Floored_percent.col(area) = error.eq13FlooredPercent;
      errors.meanAbsolute_N.col(area) = error.meanAbsolute;
      errors.rmse_percentOfRange.col(area) = error.rmsePercentOfRange;
      if (trace && row.spread && *row.spread == plan.traceSpread)
        result_.traces.push_back({plan.figure, curve.mode, *row.spread, area, test.forces_N, forces});
    }
    row.errors.push_back(std::move(errors));
  }

private:
  const SensorDesign& design_;
  const ProtocolSamples& samples_;
  int threads_;
  ProtocolResult& result_;
  std::vector<SampleSet> tests_;
};

std::vector<ProtocolCurve> emptyCurves(const std::vector<FigurePlan>& plans) {
  std::vector<ProtocolCurve> curves;
  for (const FigurePlan& plan : plans) {
    const std::vector<PublishedPoint> published = publishedPoints(plan.figure);
    for (const CurvePlan& curve : plan.curves) {
      ProtocolCurve result{plan.figure, curve.mode, curve.what, {}};
      if (curve.options.decoder == DecoderKind::Linear)
        result.rows.resize(1);
      else
        for (const double spread : plan.spreads) {
          ProtocolRow row;
          row.spread = spread;
          for (const PublishedPoint& point : published)
            if (point.spread == spread) row.published_percent = point.error_percent;
          result.rows.push_back(std::move(row));
        }
      curves.push_back(std::move(result));
    }
  }
  return curves;
}

/// Training and test samples of one repetition; empty where it was stopped.
std::optional<ProtocolSamples> samples(const SensorDesign& design, const ProtocolOptions& options, std::uint64_t seed,
                                       ProtocolResult& result, const std::function<void(double)>& progress,
                                       const std::stop_token& stop) {
  ProtocolSamples made;
  for (const bool training : {true, false}) {
    SampleRequest request;
    request.perArea = options.perArea;
    request.seed = training ? seed : testSeed(seed);
    request.mesh = options.mesh;
    request.threads = options.threads;
    SampleGenerator generator(design, request);
    SampleSet& set = training ? made.training : made.test;
    const auto total = static_cast<double>(generator.total());
    const std::size_t count = generator.generate(
        {0, generator.total()}, [&](const SampleSet& block) { append(set, block); },
        [&](std::size_t done) { progress((static_cast<double>(done) / total + (training ? 0 : 1)) / 2); }, stop);
    result.stages.add(generator.stages());
    if (count < generator.total()) return {};
    result.samples += count;
    result.solves += generator.solves();
    result.batchError = std::max(result.batchError, generator.measuredError());
    result.mesh = generator.origin().mesh;
  }
  return made;
}

} // namespace

Eigen::Vector3d ProtocolRow::eq13Mean_percent() const {
  return medianOf(errors, [](const ProtocolErrors& e) -> Eigen::Vector3d { return e.eq13_percent.rowwise().mean(); });
}

Eigen::Vector3d ProtocolRow::eq13Worst_percent() const {
  return medianOf(errors,
                  [](const ProtocolErrors& e) -> Eigen::Vector3d { return e.eq13_percent.rowwise().maxCoeff(); });
}

Eigen::Vector3d ProtocolRow::eq13FlooredMean_percent() const {
  return medianOf(errors,
                  [](const ProtocolErrors& e) -> Eigen::Vector3d { return e.eq13Floored_percent.rowwise().mean(); });
}

Eigen::Vector3d ProtocolRow::meanAbsolute_N() const {
  return medianOf(errors, [](const ProtocolErrors& e) -> Eigen::Vector3d { return e.meanAbsolute_N.rowwise().mean(); });
}

Eigen::Vector3d ProtocolRow::rmse_percentOfRange() const {
  return medianOf(errors, [](const ProtocolErrors& e) -> Eigen::Vector3d {
    return e.rmse_percentOfRange.cwiseAbs2().rowwise().mean().cwiseSqrt();
  });
}

std::uint64_t testSeed(std::uint64_t trainingSeed) {
  return trainingSeed + kTestSeedOffset;
}

std::vector<RunPart> protocolParts(double networks_s) {
  return {{"samples for training", 0.35, 3.5}, {"samples for testing", 0.7, 2.2}, {"networks", 1, networks_s}};
}

std::optional<ProtocolResult> runPaperProtocol(const SensorDesign& design, const std::vector<std::string>& figures,
                                               const ProtocolOptions& options,
                                               const std::function<void(double, const std::string&)>& progress,
                                               const std::stop_token& stop) try {
  std::vector<FigurePlan> plans;
  for (const std::string& figure : figures) plans.push_back(figurePlan(figure, design.rowWires()));
  ProtocolResult result;
  result.curves = emptyCurves(plans);
  for (int repetition = 0; repetition < options.seeds; ++repetition) {
    const auto report = [&](double share, const std::string& what) {
      if (progress) progress((repetition + share) / options.seeds, what);
    };
    const auto made = samples(
        design, options, options.firstSeed + static_cast<std::uint64_t>(repetition), result,
        [&](double share) { report(share * 0.7, share < 0.5 ? "samples for training" : "samples for testing"); }, stop);
    if (!made) return {};
    Experiment experiment(design, *made, options.threads, result);
    std::size_t place = 0;
    for (const FigurePlan& plan : plans)
      for (const CurvePlan& curve : plan.curves) {
        for (ProtocolRow& row : result.curves[place].rows) {
          if (stop.stop_requested()) return {};
          experiment.run(plan, curve, row, repetition == 0, stop);
        }
        ++place;
        report(0.7 + 0.3 * static_cast<double>(place) / static_cast<double>(result.curves.size()), "networks");
      }
  }
  return result;
} catch (const Cancelled&) { // within a training
  return {};
}

} // namespace palp
