#include "app/study/reports/networks/NetworksReport.h"

#include "app/study/Median.h"
#include "app/study/decoding/DecoderTraining.h"
#include "app/study/paper/PaperProtocol.h"
#include "app/study/reports/ReportWriter.h"
#include "app/study/reports/networks/CrossTable.h"
#include "app/study/reports/networks/NetworkCheck.h"
#include "app/study/reports/networks/RequirementTable.h"
#include "app/study/touch/SampleGenerator.h"
#include "model/base/Error.h"
#include "model/base/Text.h"
#include "nn/NoisyCopies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace palp {

namespace {

struct Measured {
  Eigen::Vector3d rmse_percentOfRange;
  double within = 0; ///< share of errors within the standard deviation that the decoder states
};

class NetworksWriter : ReportWriter {
public:
  NetworksWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop)
      : ReportWriter(request, std::move(progress), std::move(stop), "networks",
                     {"what", "seed", "force", "value", "asked"}),
        lines_(words_, csv_, request.seed) {
    if (request.mesh.mapped) seeds_ = 2; // a quick look
    chart_.logX = chart_.logY = true;
  }

  std::optional<ReportContent> run() {
    paragraph("scope", {{"sets", seeds_}, {"samples", request_.perArea}, {"seed", request_.seed}});
    if (!protocol() || !bySeed() || !together()) return {};
    add(lines_.table());
    add(std::move(chart_));
    add(ReportWords{common_("left out")});
    content_.summary = lines_.summary();
    return finished();
  }

private:
  const ProtocolCurve& curve(const ProtocolResult& result, const std::string& figure, const std::string& mode) const {
    return *std::find_if(result.curves.begin(), result.curves.end(),
                         [&](const ProtocolCurve& c) { return c.figure == figure && c.mode == mode; });
  }

  static const ProtocolRow& at(const ProtocolCurve& curve, double spread) {
    return *std::find_if(curve.rows.begin(), curve.rows.end(),
                         [&](const ProtocolRow& row) { return !row.spread || *row.spread == spread; });
  }

  static Triples areaErrors(const ProtocolRow& row, bool worst) {
    Triples values;
    for (const ProtocolErrors& error : row.errors)
      values.push_back(worst ? Eigen::Vector3d(error.eq13_percent.rowwise().maxCoeff())
                             : Eigen::Vector3d(error.eq13_percent.rowwise().mean()));
    return values;
  }

  /// Table 1 and Fig. 12.
  bool protocol() {
    ProtocolOptions options;
    options.perArea = request_.perArea;
    options.seeds = seeds_;
    options.firstSeed = request_.seed;
    options.mesh = request_.mesh;
    options.threads = request_.threads;
    const auto result =
        runPaperProtocol(request_.design, {"table1", "fig12"}, options, partOf(progress_, 0, 0.4), stop_);
    if (!result) return false;
    content_.stages.add(result->stages);
    const ProtocolCurve& table = curve(*result, "table1", "default");
    const ProtocolCurve& resistance = curve(*result, "fig12", "default");
    for (const ProtocolRow& row : table.rows)
      lines_.add("deformation, spread " + text(*row.spread) + ", worst area [%]; the paper's numbers",
                 *row.published_percent, areaErrors(row, true), "");
    lines_.add("deformation, spread 1.5, worst area [%]", {0.01, 0.02, 0.05}, areaErrors(at(table, 1.5), true), "");
    lines_.add("resistance, spread 1, worst area [%]", {0.02, 0.1, 0.1}, areaErrors(at(resistance, 1), true), "");
    const ProtocolRow& half = at(resistance, 0.5);
    lines_.add("resistance, spread 0.5, mean of the areas [%]; the paper's numbers, required of the median",
               *half.published_percent, areaErrors(half, false), "");
    const Triples linear = areaErrors(curve(*result, "table1", "linear").rows.front(), false);
    const Triples network = areaErrors(at(table, 1.5), false);
    lines_.add("deformation, spread 1.5: error over that of linear least squares", Eigen::Vector3d::Constant(1.0 / 50),
               ratios(network, linear), "linear: " + triple(median(linear)) + " %");
    paperMode(*result);
    return true;
  }

  void paperMode(const ProtocolResult& result) {
    const ProtocolCurve& table = curve(result, "table1", "paper");
    const Triples from = areaErrors(at(table, 0.8), false), to = areaErrors(at(table, 1.5), false);
    lines_.add("mode paper, Table 1: error at 1.5 over that at 0.8, required of the median",
               Eigen::Vector3d::Constant(0.5), ratios(to, from), "");
    for (const char* mode : {"paper", "paper-minmax"}) {
      const ProtocolCurve& figure = curve(result, "fig12", mode);
      ReportCurve drawn{.name = mode == std::string("paper") ? "one factor for all inputs"
                                                             : "each input scaled separately"};
      for (const ProtocolRow& row : figure.rows) {
        drawn.x.push_back(*row.spread);
        drawn.y.push_back(row.eq13Mean_percent().mean());
      }
      const auto least = std::min_element(drawn.y.begin(), drawn.y.end());
      const double best = drawn.x[static_cast<std::size_t>(least - drawn.y.begin())];
      double low = best, high = best; // where the curve is as good as flat
      for (std::size_t i = 0; i < drawn.x.size(); ++i) {
        if (drawn.y[i] > 1.5 * *least) continue;
        low = std::min(low, drawn.x[i]);
        high = std::max(high, drawn.x[i]);
      }
      chart_.curves.push_back(std::move(drawn));
      if (mode != std::string("paper")) continue;
      bestSpread_ = best;
      lines_.addRow({"mode paper, Fig. 12: spread of the smallest error (mean of forces and areas)", "0.8 to 2",
                     shortNumber(best), shortNumber(best),
                     "at most 1.5 times that error from " + shortNumber(low) + " to " + shortNumber(high)},
                    best >= 0.8 && best <= 2, best >= 0.8 && best <= 2);
    }
  }

  TrainOptions options(InputKind input, const std::string& rows, double noise, std::uint64_t seed) const {
    TrainOptions result;
    result.input = input;
    result.rows = rows;
    result.noise = noise;
    result.seed = seed;
    result.threads = request_.threads;
    return result;
  }

  /// A way to train that is measured on every set of samples.
  struct Case {
    std::string what;
    Eigen::Vector3d required;
    TrainOptions options;
    Triples values{}, bounds{};
    std::vector<double> within{};

    /// Without its unit.
    [[nodiscard]] std::string shortName() const { return what.substr(0, what.find(" [")); }
  };

  /// The cases by name, in the order of the table.
  struct Cases {
    Case deformationAuto, resistanceAuto, spread200, allRbf, oneRbf, oneLikelihood, allGaussian, allLikelihood;

    std::array<Case*, 8> all() {
      return {&deformationAuto, &resistanceAuto, &spread200,   &allRbf,
              &oneRbf,          &oneLikelihood,  &allGaussian, &allLikelihood};
    }
  };

  [[nodiscard]] Cases cases() const {
    const std::string centre = centreRow();
    const Eigen::Vector3d comparison = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
    const TrainOptions clean = options(InputKind::Resistance, centre, 0, 1);
    const TrainOptions one = options(InputKind::Resistance, centre, 1e-6, 1);
    const TrainOptions all = options(InputKind::Resistance, "all", 1e-4, 1);
    Cases cases{.deformationAuto = {"deformation, spread auto [% of range]", Eigen::Vector3d::Constant(0.001),
                                    options(InputKind::Displacement, centre, 0, 1)},
                .resistanceAuto = {"resistance, spread auto [% of range]", Eigen::Vector3d::Constant(0.003), clean},
                .spread200 = {"resistance, spread 200 [% of range]", Eigen::Vector3d::Constant(5), clean},
                .allRbf = {"all row-wires at noise 1e-4, rbf [% of range]", Eigen::Vector3d::Constant(3.5), all},
                .oneRbf = {"one row-wire at noise 1e-6, rbf [% of range]", {4, 11, 7}, one},
                .oneLikelihood = {"one row-wire at noise 1e-6, ml [% of range]", comparison, one},
                .allGaussian = {"all row-wires at noise 1e-4, gp [% of range]", comparison, all},
                .allLikelihood = {"all row-wires at noise 1e-4, ml [% of range]", comparison, all}};
    cases.spread200.options.spread = 200;
    cases.oneLikelihood.options.decoder = cases.allLikelihood.options.decoder = DecoderKind::MaximumLikelihood;
    cases.allGaussian.options.decoder = DecoderKind::GaussianProcess;
    return cases;
  }

  /// The spread by leave-one-out, and noise, on each set of samples.
  bool bySeed() {
    Cases cases = this->cases();
    for (int s = 0; s < seeds_; ++s) {
      ReportRequest own = request_;
      own.seed = request_.seed + static_cast<std::uint64_t>(s);
      const auto sets = twoSets(request_.design, own, content_.stages, {}, stop_);
      if (!sets) return false;
      if (s == 0) explainFactor(centreRowResistances(sets->training));
      const auto all = cases.all();
      for (std::size_t k = 0; k < all.size(); ++k) {
        if (stop_.stop_requested()) return false;
        progress(0.4 + 0.5 * (s + static_cast<double>(k) / static_cast<double>(all.size())) / seeds_, all[k]->what);
        measure(*all[k], *sets, own.seed);
      }
    }
    addLines(cases);
    return true;
  }

  void measure(Case& one, const TwoSets& sets, std::uint64_t seed) {
    one.options.seed = seed;
    const Measured found = measured(sets, one.options, seed);
    one.values.push_back(found.rmse_percentOfRange);
    one.within.push_back(found.within);
    if (one.options.noise == 0) return;
    const std::vector<int> rows = rowsNamed(one.options.rows, request_.design.rowWires());
    one.bounds.emplace_back(noiseBound(sets.test, InputKind::Resistance, rows, one.options.noise).withPriorPercent);
  }

  void addLines(Cases& cases) {
    for (const Case* one : cases.all())
      lines_.add(one->what, one->required, one->values,
                 one->bounds.empty() ? "" : "bound with prior " + triple(median(one->bounds)));
    lines_.add("one row-wire at noise 1e-6: error of ml over that of rbf", Eigen::Vector3d::Constant(0.2),
               ratios(cases.oneLikelihood.values, cases.oneRbf.values), "");
    for (const Case* one :
         {&cases.allRbf, &cases.oneRbf, &cases.allGaussian, &cases.allLikelihood, &cases.oneLikelihood})
      lines_.add(one->shortName() + ": share of errors within one standard deviation, off 0.68 by", 0.1,
                 offsets(one->within), "share " + shortNumber(median(one->within)));
  }

  [[nodiscard]] std::string centreRow() const { return std::to_string(centreRowWire(request_.design.rowWires())); }

  [[nodiscard]] Eigen::MatrixXd centreRowResistances(const SampleSet& samples) const {
    DecoderInput input;
    input.kind = InputKind::Resistance;
    input.rows = {centreRowWire(request_.design.rowWires())};
    input.rowWires = request_.design.rowWires();
    input.valuesPerRow = request_.design.columnWires();
    return inputsOf(samples, input);
  }

  /// What one factor for all inputs means for a spread.
  void explainFactor(const Eigen::MatrixXd& inputs) {
    const double farthest = (inputs.colwise() - inputs.rowwise().mean()).colwise().norm().maxCoeff();
    const double half = (inputs.rowwise().maxCoeff() - inputs.rowwise().minCoeff()).maxCoeff() / 2;
    paragraph("factor", {{"factor", farthest / half}, {"other", bestSpread_ * farthest / half}, {"best", bestSpread_}});
  }

  static std::vector<double> offsets(const std::vector<double>& within) {
    std::vector<double> result;
    for (const double share : within) result.push_back(std::abs(share - 0.683));
    return result;
  }

  Measured measured(const TwoSets& sets, const TrainOptions& options, std::uint64_t seed) {
    const Decoder decoder =
        content_.stages.measure("train", [&] { return trainDecoder(sets.training, &request_.design, options, stop_); });
    const Eigen::MatrixXd inputs =
        noisyCopies(inputsOf(sets.test, decoder.input), options.noise, 1, testSeed(seed)); // never the training's noise
    PredictOptions wanted;
    wanted.noise = options.noise;
    wanted.area = wanted.standardDeviation = options.noise > 0;
    const Prediction prediction = content_.stages.measure("predict", [&] { return predict(decoder, inputs, wanted); });
    const Eigen::MatrixXd error_N = prediction.forces_N - sets.test.forces_N;
    Measured result;
    const Eigen::Vector3d rms_N = error_N.cwiseAbs2().rowwise().mean().cwiseSqrt();
    result.rmse_percentOfRange = 100 * rms_N.cwiseQuotient(range_N_);
    if (wanted.standardDeviation)
      result.within = (error_N.array().abs() < prediction.standardDeviation_N.array()).cast<double>().mean();
    return result;
  }

  /// All areas loaded together.
  bool together() {
    progress(0.9, "all areas together");
    SampleSet sets[2];
    for (const bool test : {false, true}) {
      SampleRequest wanted;
      wanted.areas = "together";
      wanted.perArea = request_.perArea * request_.design.areas.count();
      wanted.seed = test ? testSeed(request_.seed) : request_.seed;
      wanted.mesh = request_.mesh;
      wanted.threads = request_.threads;
      SampleGenerator generator(request_.design, wanted);
      const std::size_t made = generator.generate(
          {0, generator.total()}, [&](const SampleSet& block) { append(sets[test ? 1 : 0], block); }, {}, stop_);
      content_.stages.add(generator.stages());
      if (made < generator.total()) return false;
    }
    for (const double noise : {0.0, 1e-4}) {
      if (stop_.stop_requested()) return false;
      const Decoder decoder =
          trainDecoder(sets[0], nullptr, options(InputKind::Resistance, "all", noise, request_.seed), stop_);
      PredictOptions bare;
      bare.area = bare.standardDeviation = false;
      const Eigen::MatrixXd inputs = noisyCopies(inputsOf(sets[1], decoder.input), noise, 1, testSeed(request_.seed));
      const Eigen::MatrixXd error_N = predict(decoder, inputs, bare).forces_N - sets[1].forces_N;
      const Eigen::VectorXd rms_N = error_N.cwiseAbs2().rowwise().mean().cwiseSqrt();
      Eigen::Vector3d percent;
      for (int axis = 0; axis < 3; ++axis)
        percent(axis) = 100 * rms_N.reshaped(3, rms_N.size() / 3).row(axis).maxCoeff() / range_N_(axis);
      if (noise == 0) {
        lines_.add("18 forces together from all row-wires, worst area [% of range]", Eigen::Vector3d::Constant(0.001),
                   {percent}, "spread auto");
        continue;
      }
      std::vector<int> rows = rowsNamed("all", request_.design.rowWires());
      const Eigen::VectorXd bound = noiseBound(sets[1], InputKind::Resistance, rows, noise).withoutPriorPercent;
      Eigen::Vector3d ratio;
      const Eigen::ArrayXd trainingRange_N =
          sets[1].forces_N.rowwise().maxCoeff() - sets[1].forces_N.rowwise().minCoeff();
      const Eigen::VectorXd overBound = (100 * rms_N.array() / trainingRange_N / bound.array()).matrix();
      for (int axis = 0; axis < 3; ++axis)
        ratio(axis) = overBound.reshaped(3, overBound.size() / 3).row(axis).maxCoeff();
      lines_.add("18 forces together at noise 1e-4: error over the bound without prior, worst area",
                 Eigen::Vector3d::Constant(1.3), {ratio}, "error " + triple(percent) + " % of range");
    }
    return true;
  }

  int seeds_ = 5;
  double bestSpread_ = 0;
  RequirementTable lines_;
  ReportChart chart_ = words_.chart("fig12", "figure chart");
};

} // namespace

std::optional<ReportContent> networksReport(const ReportRequest& request, const ReportProgress& progress,
                                            std::stop_token stop) {
  requireValid(request.design);
  if (request.design.field()) return crossTableReport(request, progress, std::move(stop));
  return NetworksWriter(request, progress, std::move(stop)).run();
}

} // namespace palp
