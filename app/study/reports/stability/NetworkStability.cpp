#include "app/study/decoding/DecoderTraining.h"
#include "app/study/reports/ReportPage.h"
#include "app/study/reports/networks/NetworkCheck.h"
#include "app/study/reports/stability/StabilityRow.h"

#include "model/base/Text.h"
#include "nn/NoisyCopies.h"
#include "nn/RbfTrainer.h"
#include "nn/RelativeError.h"

#include <cmath>
#include <limits>
#include <optional>

namespace palp {

namespace {

constexpr double kNothing_percent = 28.9; // of range: the error of predicting the mean
/// A leave-one-out error may miss the true one by this factor: it is found on other points.
constexpr double kEstimateFactor = 3;
constexpr double kPoor_percent = 5; ///< of range: no such network is called right

/// Resistances of the centre row-wire as inputs of a network.
struct NetworkData {
  Eigen::MatrixXd samples, targets, tests, truth;
  Eigen::VectorXd range_N;
};

NetworkData dataOf(const SensorDesign& design, const TwoSets& sets) {
  DecoderInput input;
  input.kind = InputKind::Displacement;
  input.rows = {centreRowWire(design.rowWires())};
  input.rowWires = design.rowWires();
  input.valuesPerRow = 3 * design.electrodesPerRowWire();
  return {inputsOf(sets.training, input), sets.training.forces_N, inputsOf(sets.test, input), sets.test.forces_N,
          design.forceRange.high_N - design.forceRange.low_N};
}

/// Trains, tests, and compares the fit's own error estimate with its error.
void train(StabilityRow& row, const NetworkData& data, const RbfOptions& options, const std::stop_token& stop) {
  const RbfFit fit = trainRbf(data.samples, data.targets, options, stop);
  row.condition = fit.report.condition;
  const Eigen::MatrixXd predicted = fit.network.predict(data.tests);
  row.errorOf = "true forces [% of range]";
  const PredictionError error = predictionError(predicted, data.truth, data.range_N);
  row.error = predicted.allFinite() ? error.rmsePercentOfRange.maxCoeff() : std::numeric_limits<double>::infinity();
  const double promised_percent = fit.report.leaveOneOut.size() == 0
                                      ? row.error
                                      : 100 * fit.report.leaveOneOut.cwiseQuotient(data.range_N).maxCoeff();
  const bool poor = !(row.error < kNothing_percent);
  const bool honest = !poor || promised_percent > kNothing_percent / kEstimateFactor || !fit.report.warnings.empty();
  if (poor) row.outcome = honest ? StabilityOutcome::Warned : StabilityOutcome::Wrong;
  if (poor)
    row.words = "worse than predicting the mean; its leave-one-out error is " + shortNumber(promised_percent) + " %. ";
  if (!poor && row.error > kEstimateFactor * promised_percent && row.error > 1 && fit.report.warnings.empty()) {
    row.outcome = StabilityOutcome::Wrong;
    row.words = "its leave-one-out error is only " + shortNumber(promised_percent) + " %. ";
  }
  if (row.outcome == StabilityOutcome::Right && row.error > kPoor_percent) {
    row.outcome = StabilityOutcome::Warned;
    row.words = "a poor network; its leave-one-out error is " + shortNumber(promised_percent) + " % of range. ";
  }
  for (const std::string& warning : fit.report.warnings) row.words += warning + ". ";
  if (row.outcome == StabilityOutcome::Right && !fit.report.warnings.empty()) row.outcome = StabilityOutcome::Warned;
}

Eigen::MatrixXd twice(const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd result(columns.rows(), 2 * columns.cols());
  result << columns, columns;
  return result;
}

void addData(StabilityCases& cases, const NetworkData& data) {
  const auto add = [&](const std::string& what, const NetworkData& changed) {
    cases.add("network: data", what, [&](StabilityRow& row) { train(row, changed, {}, cases.stop()); });
  };
  NetworkData changed = data;
  changed.samples = twice(data.samples);
  changed.targets = twice(data.targets);
  add("every sample twice", changed);
  changed.targets.rightCols(data.targets.cols()).array() += 0.1;
  add("every sample twice with forces that differ by 0.1 N", changed);
  changed = data;
  changed.samples.row(0).setConstant(7);
  changed.tests.row(0).setConstant(7);
  add("an input that never changes", changed);
  changed = data;
  changed.samples.setConstant(1);
  changed.tests.setConstant(1);
  add("all inputs constant", changed);
  for (const double factor : {1e-12, 1e12, 1e200}) {
    changed = data;
    changed.samples *= factor;
    changed.tests *= factor;
    add("inputs times " + text(factor), changed);
  }
  changed = data;
  changed.targets *= 1e-9;
  changed.truth *= 1e-9;
  changed.range_N *= 1e-9;
  add("near-zero forces (times 1e-9)", changed);
  changed = data;
  changed.samples(0, 0) = std::numeric_limits<double>::quiet_NaN();
  add("an input that is not a number", changed);
  changed = data;
  changed.samples = data.samples.leftCols(1);
  changed.targets = data.targets.leftCols(1);
  add("a single sample", changed);
}

/// An open or shorted wire read by a network: a force may come out, but never as if nothing were wrong.
void addBrokenWires(StabilityCases& cases, const SensorDesign& design, const TwoSets& sets) {
  TrainOptions options;
  options.input = InputKind::Resistance;
  options.rows = std::to_string(centreRowWire(design.rowWires()));
  options.noise = 1e-4;
  const Decoder decoder = trainDecoder(sets.training, &design, options, cases.stop());
  for (const auto& [what, ohm] :
       {std::pair{"open wire (R infinite)", std::numeric_limits<double>::infinity()},
        std::pair{"nearly open wire (R = 1e12 ohm)", 1e12}, std::pair{"shorted wire (R = 0)", 0.0}})
    cases.add("network: broken wires", what, [&, ohm = ohm](StabilityRow& row) {
      Eigen::MatrixXd inputs = inputsOf(sets.test, decoder.input).leftCols(1);
      inputs(0, 0) = ohm;
      const Prediction prediction = predict(decoder, inputs);
      row.error = prediction.forces_N.allFinite() ? (prediction.forces_N - sets.test.forces_N.leftCols(1)).norm()
                                                  : std::numeric_limits<double>::infinity();
      row.errorOf = "true force [N]";
      const bool marked = !prediction.outsideTrainingRange.empty() && prediction.outsideTrainingRange[0];
      row.outcome = marked ? StabilityOutcome::Warned : StabilityOutcome::Wrong;
      row.words = marked ? "marked as outside of what was trained" : "not marked as outside of what was trained";
    });
}

} // namespace

void addNetworkCases(StabilityCases& cases, const ReportRequest& request, StageLog& stages) {
  ReportRequest coarse = request;
  if (!coarse.mesh.mapped && !coarse.mesh.meshSize_mm) coarse.mesh.mapped = std::array<int, 3>{10, 10, 5};
  std::optional<TwoSets> sets;
  const StabilityRow made = runCase("network", "samples of the design", [&](StabilityRow&) {
    sets = twoSets(request.design, coarse, stages, {}, cases.stop());
  });
  if (made.outcome != StabilityOutcome::Right) cases.add(made);
  if (!sets) return;
  const NetworkData data = dataOf(request.design, *sets);
  for (const Tail tail : {Tail::Linear, Tail::Bias})
    for (const double spread : {1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e4, 1e6})
      cases.add(tail == Tail::Linear ? "network: spread, linear tail" : "network: spread, bias only",
                "spread " + text(spread), [&](StabilityRow& row) {
                  RbfOptions options;
                  options.spread = spread;
                  options.tail = tail;
                  train(row, data, options, cases.stop());
                });
  for (const double ridge : {0.0, 1e-12, 1e-6, 1e-3, 1.0, 10.0})
    cases.add("network: ridge", "ridge " + text(ridge) + ", spread 1", [&](StabilityRow& row) {
      RbfOptions options;
      options.spread = 1;
      options.ridge = ridge;
      train(row, data, options, cases.stop());
    });
  for (const LeastSquaresMethod method : {LeastSquaresMethod::PivotedQr, LeastSquaresMethod::Cholesky,
                                          LeastSquaresMethod::TruncatedSvd, LeastSquaresMethod::Recursive})
    cases.add("network: solver", name(method) + ", spread 10", [&](StabilityRow& row) {
      RbfOptions options;
      options.spread = 10;
      options.method = method;
      options.tail = Tail::Bias;
      train(row, data, options, cases.stop());
    });
  addData(cases, data);
  addBrokenWires(cases, request.design, *sets);
}

} // namespace palp
