#include "app/study/decoding/TwoStep.h"

#include "app/study/decoding/BlockInversion.h"
#include "app/study/decoding/Prediction.h"
#include "io/DesignFile.h"
#include "model/RowColumnResistance.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"
#include "nn/NoisyCopies.h"

#include <Eigen/QR>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

namespace palp {
namespace {

constexpr int mostIterations = 50;
/// Relative residual of R that counts as solved: a few roundings of Eq. (1)'s sums.
constexpr double solved = 1e-13;
/// A pivot below this share of the largest is taken as 0: the direction cannot be seen.
constexpr double leastPivot = 1e-12;
/// Beyond this condition the paper's step 1 multiplies every error of R that much.
constexpr double fragile = 1e5;

void requireInvertible(const SensorDesign& design) {
  if (const auto problem = whyNotSquare(design)) throw Error("decoder: two-step-gn: " + *problem);
  if (design.lowerFollowsRubber)
    throw Error("decoder: two-step-gn: the design's lower electrodes follow the rubber; Eq. (1) gives the upper "
                "electrodes' displacements only with fixed lower electrodes");
  if (design.pressureLaw)
    throw Error("decoder: two-step-gn: the design has a pressure law; Eq. (1) gives displacements only where the "
                "resistivity is constant (resistance.pressure_law null)");
}

/// ln R of one row-wire and its derivative, over the displacements of the row-wire's own electrodes.
class RowSystem {
public:
  RowSystem(const SensorDesign& design, int rowWire)
      : design_(design), row_(rowWire), electrodes_(design.electrodesPerRowWire()),
        state_(ElectrodeDisplacements::atRest(design)) {}

  Eigen::VectorXd logarithms(const Eigen::VectorXd& u, Eigen::MatrixXd* slope) {
    state_.upper_mm.middleCols(static_cast<Eigen::Index>(row_) * electrodes_, electrodes_) = u.reshaped(3, electrodes_);
    RowResistanceJacobian jacobian;
    const Eigen::VectorXd resistance = rowResistances(design_, state_, row_, slope ? &jacobian : nullptr);
    if (slope) *slope = resistance.cwiseInverse().asDiagonal() * jacobian.upper;
    return resistance.array().log();
  }
  [[nodiscard]] Eigen::Index unknowns() const { return 3 * static_cast<Eigen::Index>(electrodes_); }

private:
  const SensorDesign& design_;
  int row_;
  int electrodes_;
  ElectrodeDisplacements state_;
};

struct OneInversion {
  Eigen::VectorXd u;
  int iterations = 0;
  double residual = 0;
};

OneInversion invert(RowSystem& system, const Eigen::VectorXd& wanted) {
  OneInversion result{Eigen::VectorXd::Zero(system.unknowns())};
  Eigen::MatrixXd slope;
  Eigen::VectorXd rest = wanted - system.logarithms(result.u, &slope);
  for (; result.iterations < mostIterations && rest.cwiseAbs().maxCoeff() > solved; ++result.iterations) {
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> qr;
    qr.setThreshold(leastPivot);
    qr.compute(slope);
    const Eigen::VectorXd step = qr.solve(rest);
    double length = 1;
    Eigen::VectorXd next = result.u + step, nextRest = wanted - system.logarithms(next, nullptr);
    while (!(nextRest.squaredNorm() < rest.squaredNorm()) && length > 1e-3) {
      length /= 2;
      next = result.u + length * step;
      nextRest = wanted - system.logarithms(next, nullptr);
    }
    if (!(nextRest.squaredNorm() < rest.squaredNorm())) break;
    result.u = next;
    rest = wanted - system.logarithms(result.u, &slope);
  }
  result.residual = rest.cwiseAbs().maxCoeff();
  return result;
}

/// Step 1 by Gauss-Newton for all rows, with what a reader must know of it.
Eigen::MatrixXd inverted(const SensorDesign& design, const std::vector<int>& rows,
                         const Eigen::Ref<const Eigen::MatrixXd>& resistances_ohm, const std::stop_token& stop,
                         FitReport* report) {
  const Eigen::Index columns = design.columnWires(),
                     unknowns = 3 * static_cast<Eigen::Index>(design.electrodesPerRowWire());
  Eigen::MatrixXd result(static_cast<Eigen::Index>(rows.size()) * unknowns, resistances_ohm.cols());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Eigen::Index at = static_cast<Eigen::Index>(r);
    const Inversion inversion =
        invertRowResistances(design, rows[r], resistances_ohm.middleRows(at * columns, columns), stop);
    result.middleRows(at * unknowns, unknowns) = inversion.displacements_mm;
    if (!report) continue;
    report->condition = std::max(report->condition, inversion.condition);
    if (inversion.condition > fragile || inversion.rank < unknowns)
      report->warnings.push_back("Eq. (1) of row-wire " + std::to_string(rows[r]) + " has condition " +
                                 text(inversion.condition) + " and rank " + std::to_string(inversion.rank) + " of " +
                                 std::to_string(unknowns) +
                                 ": errors of the resistances are amplified by as much in the displacements");
    if (inversion.worstResidual > 1e-9)
      report->warnings.push_back("Gauss-Newton left up to " + text(inversion.worstResidual) +
                                 " of R unexplained on row-wire " + std::to_string(rows[r]));
  }
  return result;
}

} // namespace

Inversion invertRowResistances(const SensorDesign& design, int rowWire,
                               const Eigen::Ref<const Eigen::MatrixXd>& resistances_ohm, const std::stop_token& stop) {
  requireInvertible(design);
  if (rowWire < 0 || rowWire >= design.rowWires())
    throw Error("rows: " + gotExpected(std::to_string(rowWire), "0 to " + std::to_string(design.rowWires() - 1)));
  if (resistances_ohm.rows() != design.columnWires())
    throw Error("resistances of a row-wire: " +
                gotExpected(std::to_string(resistances_ohm.rows()),
                            std::to_string(design.columnWires()) + ", one per column-wire"));
  if (!(resistances_ohm.array() > 0).all())
    throw Error("resistances: " + gotExpected(resistances_ohm.minCoeff(), " ohm", "above 0, as Eq. (1) gives"));
  RowSystem system(design, rowWire);
  Inversion result;
  Eigen::MatrixXd slope;
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(system.unknowns());
  static_cast<void>(system.logarithms(rest, &slope));
  const Eigen::VectorXd singular = Eigen::JacobiSVD<Eigen::MatrixXd>(slope).singularValues();
  result.rank = static_cast<int>((singular.array() > leastPivot * singular(0)).count());
  result.condition = singular(0) / singular(singular.size() - 1);
  result.displacements_mm.resize(system.unknowns(), resistances_ohm.cols());
  for (Eigen::Index i = 0; i < resistances_ohm.cols(); ++i) {
    if (stop.stop_requested()) throw Cancelled();
    const OneInversion one = invert(system, resistances_ohm.col(i).array().log());
    result.displacements_mm.col(i) = one.u;
    result.worstIterations = std::max(result.worstIterations, one.iterations);
    result.worstResidual = std::max(result.worstResidual, one.residual);
  }
  return result;
}

Eigen::MatrixXd displacementsOf(const TwoStep& decoder, const Eigen::Ref<const Eigen::MatrixXd>& resistances_ohm) {
  if (decoder.network) return decoder.network->predict(resistances_ohm);
  if (decoder.block) {
    if (!(resistances_ohm.array() > 0).all())
      throw Error("resistances: one is not above 0; expected positive resistances, as the field law gives");
    return decoder.block->displacements_mm(resistances_ohm);
  }
  return inverted(*decoder.design, decoder.rows, resistances_ohm, {}, nullptr);
}

Eigen::MatrixXd predict(const TwoStep& decoder, const Eigen::Ref<const Eigen::MatrixXd>& resistances_ohm) {
  return decoder.force.predict(displacementsOf(decoder, resistances_ohm));
}

TwoStepFit trainTwoStep(const SampleSet& samples, const SensorDesign* design, const DecoderInput& input,
                        const TrainOptions& options, const std::stop_token& stop,
                        const std::function<void(double, const std::string&)>& progress) {
  if (input.kind != InputKind::Resistance)
    throw Error("input: " + gotExpected("displacement", "resistance, from which step 1 gives the displacements"));
  DecoderInput between = input;
  between.kind = InputKind::Displacement;
  between.valuesPerRow = 3 * samples.electrodesPerRowWire;
  const Eigen::MatrixXd truth_mm = inputsOf(samples, between);
  const Eigen::MatrixXd clean_ohm = inputsOf(samples, input);
  const Eigen::MatrixXd measured_ohm = noisyCopies(clean_ohm, options.noise, 1, options.seed);

  TwoStepFit fit;
  fit.decoder.rows = input.rows;
  Eigen::MatrixXd seen_mm;
  if (design && design->field()) {
    progress(0, "step 1: inverting the field at rest");
    if (design->rowWires() != samples.rowWires || design->columnWires() != samples.columnWires ||
        design->electrodesPerRowWire() != samples.electrodesPerRowWire)
      throw Error("decoder: two-step-gn: the samples have other wires or electrodes than the design whose field it "
                  "inverts");
    fit.decoder.block = blockInversion(*design, input.rows, options.noise, options.threads, stop, fit.report);
    if (samples.origin.designFingerprint != designFingerprint(*design))
      fit.report.warnings.push_back("the samples are of another design than the one whose field is inverted");
    seen_mm = displacementsOf(fit.decoder, measured_ohm);
  } else if (design) {
    progress(0, "step 1: inverting Eq. (1)");
    fit.decoder.design = *design;
    seen_mm = inverted(*design, input.rows, measured_ohm, stop, &fit.report);
  } else {
    BackPropagationOptions step1;
    step1.relativeInputNoise = options.noise;
    step1.seed = options.seed;
    BackPropagationFit network = trainBackPropagation(
        clean_ohm, truth_mm, step1, stop, [&](double share) { progress(0.7 * share, "step 1: back-propagation"); });
    fit.report.warnings = std::move(network.warnings);
    fit.decoder.network = std::move(network.network);
    seen_mm = fit.decoder.network->predict(measured_ohm);
  }
  progress(0.8, "step 2: displacement to force");
  TrainOptions step2 = options;
  step2.input = InputKind::Displacement;
  step2.noise = 0; // the noise is in what step 1 gives
  RbfOptions rbf = rbfOptions(step2, samples.size());
  // What step 1 gives is never clean: its errors are to be averaged, not interpolated.
  rbf.method = options.solver.value_or(LeastSquaresMethod::Cholesky);
  rbf.tail = options.tail.value_or(Tail::LinearPenalised);
  rbf.ridge = options.ridge;
  RbfFit force = trainRbf(seen_mm, samples.forces_N, rbf, stop);
  const double condition = std::max(fit.report.condition, force.report.condition);
  std::vector<std::string> warnings = std::move(fit.report.warnings);
  warnings.insert(warnings.end(), force.report.warnings.begin(), force.report.warnings.end());
  fit.residuals_N = force.report.leaveOneOutResiduals;
  fit.report = std::move(force.report);
  fit.report.condition = condition;
  fit.report.warnings = std::move(warnings);
  fit.decoder.force = std::move(force.network);
  return fit;
}

Eigen::MatrixXd likelihoodForces(const ForwardModel& model, const Eigen::Ref<const Eigen::MatrixXd>& inputs,
                                 const TrainOptions& options, const std::stop_token& stop) {
  const Eigen::MatrixXd measured = noisyCopies(inputs, options.noise, 1, options.seed);
  const LikelihoodInversion inversion(model);
  Eigen::MatrixXd forces(model.parameters(), inputs.cols());
  for (Eigen::Index i = 0; i < inputs.cols(); ++i) {
    if (stop.stop_requested()) throw Cancelled();
    forces.col(i) = inversion.estimate(measured.col(i)).parameters;
  }
  return forces;
}

} // namespace palp
