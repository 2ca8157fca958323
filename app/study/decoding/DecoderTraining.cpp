#include "app/study/decoding/DecoderTraining.h"

#include "app/study/decoding/ConstantInputs.h"
#include "app/study/decoding/KnownTouches.h"
#include "app/study/decoding/Prediction.h"
#include "app/study/decoding/TwoStep.h"
#include "app/study/decoding/measured/GroupedErrors.h"
#include "app/study/decoding/measured/MeasuredWords.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "nn/VaryingInputs.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

namespace palp {
namespace {

constexpr double kKnown = 0.6; ///< of the training time of a decoder of touches: touches computed from the design

/// The touched area of each sample as classes without gaps.
struct Classes {
  Eigen::VectorXi ofSample;
  std::vector<int> area;
};

Classes classesOf(const SampleSet& samples) {
  Classes classes;
  std::map<int, int> known;
  for (const int area : samples.area) known.emplace(area, 0);
  for (auto& [area, index] : known) {
    index = static_cast<int>(classes.area.size());
    classes.area.push_back(area);
  }
  classes.ofSample = samples.area.unaryExpr([&](int area) { return known.at(area); });
  return classes;
}

Eigen::VectorXd residualRootMeanSquare(const Eigen::MatrixXd& residuals) {
  return residuals.cols() == 0 ? Eigen::VectorXd(Eigen::VectorXd::Zero(residuals.rows()))
                               : Eigen::VectorXd(residuals.array().square().rowwise().mean().sqrt());
}

/// The work of one training, step by step; `decoder_` and its report grow on the way.
class DecoderTraining {
public:
  /// All arguments outlive the training.
  DecoderTraining(const SampleSet& samples, const SensorDesign* design, const TrainOptions& options,
                  const std::stop_token& stop, const std::function<void(double, const std::string&)>& progress);
  /// `validates`: of measured rows, the errors are those of rows that depend on each other left out together.
  Decoder run(bool validates = true);

private:
  void describe();
  void addPlace();
  void fit();
  void fitRbf();
  void fitAsMeasured();
  void fitPolynomial(int degree);
  void fitGaussianProcess();
  void fitBackPropagation();
  void fitTwoStep(bool gaussNewton);
  void fitLikelihood();
  void fitTouches();
  void validateGroups();
  void recordResiduals(const Eigen::MatrixXd& ofTargets, const Eigen::VectorXi& areas);
  void fitAreas();
  [[nodiscard]] ForwardModel forwardModel();
  void say(double share, const std::string& what) const;

  const SampleSet& samples_;
  const SensorDesign* design_;
  const TrainOptions& options_;
  const std::stop_token& stop_;
  const std::function<void(double, const std::string&)>& progress_;
  Eigen::MatrixXd inputs_;
  Eigen::MatrixXd targets_; ///< forces, and below them the position if requested
  Decoder decoder_;
};

DecoderTraining::DecoderTraining(const SampleSet& samples, const SensorDesign* design, const TrainOptions& options,
                                 const std::stop_token& stop,
                                 const std::function<void(double, const std::string&)>& progress)
    : samples_(samples), design_(design), options_(options), stop_(stop), progress_(progress) {}

Decoder DecoderTraining::run(bool validates) {
  if (samples_.size() == 0) throw Error("samples: " + gotExpected("0", "1 or more"));
  const auto start = std::chrono::steady_clock::now();
  describe();
  say(0, "fitting " + name(options_.decoder));
  fit();
  if (stop_.stop_requested()) throw Cancelled();
  if (validates && samples_.origin.imported() && !samples_.together() && !decoder_.measured) validateGroups();
  say(0.9, "learning the areas");
  fitAreas();
  if (std::string constant = constantInputs(decoder_.input, inputs_); !constant.empty())
    decoder_.report.warnings.push_back(std::move(constant));
  for (std::string& warning : measuredWarnings(decoder_)) decoder_.report.warnings.push_back(std::move(warning));
  decoder_.report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  say(1, "trained");
  return std::move(decoder_);
}

void DecoderTraining::describe() {
  const bool displacement = options_.input == InputKind::Displacement;
  decoder_.kind = options_.decoder;
  decoder_.input.kind = options_.input;
  decoder_.input.rows = rowsNamed(options_.rows, samples_.rowWires);
  decoder_.input.rowWires = samples_.rowWires;
  decoder_.input.valuesPerRow = displacement ? 3 * samples_.electrodesPerRowWire : samples_.columnWires;
  decoder_.designFingerprint = samples_.origin.designFingerprint;
  if (!displacement) decoder_.readout = samples_.origin.readout;
  decoder_.trainedWith = "palp train" + asCommand(options_);
  decoder_.mode = options_.mode;
  decoder_.seed = options_.seed;
  decoder_.noise = options_.noise;
  decoder_.areaCount = samples_.areaCount;
  decoder_.together = samples_.together();
  decoder_.low_N = samples_.forces_N.rowwise().minCoeff();
  decoder_.high_N = samples_.forces_N.rowwise().maxCoeff();
  decoder_.touches = samples_.origin.touches;
  targets_ = samples_.forces_N;
  if (options_.target == DecoderTarget::ForceAndPlace) addPlace();
  inputs_ = inputsOf(samples_, decoder_.input);
  requireVarying(inputs_);
  decoder_.input.low = inputs_.rowwise().minCoeff();
  decoder_.input.high = inputs_.rowwise().maxCoeff();
}

void DecoderTraining::addPlace() {
  if (!samples_.hasPlaces())
    throw Error("target: force+place needs samples of touches (Network scene, palp sample --touch) or with measured "
                "positions (palp import); these load complete areas");
  if (!traits(options_.decoder).givesPosition)
    throw Error("target: " + name(options_.decoder) + " predicts the force only; force+place takes " +
                namesOfDecodersWith(&DecoderTraits::givesPosition));
  const Eigen::Matrix2Xd places_mm = samples_.touchedPlaces_mm();
  decoder_.place = DecoderPlace{places_mm.rowwise().minCoeff(), places_mm.rowwise().maxCoeff(), {}};
  targets_.conservativeResize(targets_.rows() + 2, Eigen::NoChange);
  targets_.bottomRows<2>() = places_mm;
}

void DecoderTraining::fit() {
  switch (options_.decoder) {
  case DecoderKind::Rbf:
    return fitRbf();
  case DecoderKind::Linear:
    return fitPolynomial(1);
  case DecoderKind::Polynomial2:
    return fitPolynomial(2);
  case DecoderKind::Polynomial3:
    return fitPolynomial(3);
  case DecoderKind::GaussianProcess:
    return fitGaussianProcess();
  case DecoderKind::BackPropagation:
    return fitBackPropagation();
  case DecoderKind::TwoStepBackPropagation:
    return fitTwoStep(false);
  case DecoderKind::TwoStepGaussNewton:
    return fitTwoStep(true);
  case DecoderKind::MaximumLikelihood:
    return fitLikelihood();
  case DecoderKind::TouchInversion:
    return fitTouches();
  }
}

void DecoderTraining::fitAsMeasured() {
  const MeasuredRows rows = measuredRows(samples_, inputs_, targets_);
  MeasuredOptions options;
  options.order = options_.order;
  options.transform = options_.transform;
  options.memory_s = memoryTimes_s(options_.memory);
  options.rowsAreClock = options_.clock == MemoryClock::Rows;
  options.spread = options_.spread;
  options.ridge = options_.ridge;
  options.centers = options_.centers;
  options.seed = options_.seed;
  options.forces = samples_.forces_N.rows();
  MeasuredFit fit = fitMeasured(rows, options, stop_, [this](double share) { say(0.9 * share, "validating"); });
  FitReport& report = decoder_.report;
  report.spread = fit.network.centers.cols() > 0 ? fit.network.spread : 0;
  report.ridge = fit.validation.lambda;
  report.centers = static_cast<int>(fit.network.centers.cols());
  report.rank = report.centers + static_cast<int>(fit.network.tail.cols());
  report.condition = 1 / fit.validation.lambda;
  report.largestWeight = std::max(fit.network.weights.size() > 0 ? fit.network.weights.cwiseAbs().maxCoeff() : 0.0,
                                  fit.network.tail.cwiseAbs().maxCoeff());
  MeasuredTraining& measured = decoder_.measured.emplace();
  measured.stage = std::move(fit.stage);
  measured.deviation = std::move(fit.deviation);
  measured.ellipse = std::move(fit.ellipse);
  measured.dependence = fit.validation.dependence;
  measured.stated = fit.validation.stated;
  measured.relative = fit.validation.score;
  measured.singleRows = fit.validation.singleRow;
  if (fit.validation.recordingScore) {
    measured.recording = fit.validation.recording;
    measured.relativeRecording = fit.validation.recordingScore;
  }
  decoder_.model = std::move(fit.network);
  recordResiduals(fit.validation.errors, samples_.area(fit.validation.fittedRows));
}

void DecoderTraining::fitRbf() {
  if (trainsAsMeasured(samples_, options_)) return fitAsMeasured();
  RbfFit fit = trainRbf(inputs_, targets_, rbfOptions(options_, samples_.size()), stop_);
  decoder_.model = std::move(fit.network);
  decoder_.report = std::move(fit.report);
  recordResiduals(decoder_.report.leaveOneOutResiduals, samples_.area);
}

void DecoderTraining::fitPolynomial(int degree) {
  PolynomialOptions options;
  options.degree = degree;
  options.ridge = options_.ridge;
  options.relativeInputNoise = options_.noise;
  options.seed = options_.seed;
  PolynomialFit fit = trainPolynomial(inputs_, targets_, options, stop_);
  decoder_.report.ridge = fit.ridge;
  decoder_.report.condition = fit.condition;
  decoder_.report.rank = fit.rank;
  decoder_.report.centers = static_cast<int>(fit.model.centers.cols());
  decoder_.report.largestWeight = fit.model.weights.cwiseAbs().maxCoeff();
  decoder_.report.warnings = std::move(fit.warnings);
  decoder_.model = std::move(fit.model);
  recordResiduals(fit.leaveOneOutResiduals, samples_.area);
}

void DecoderTraining::fitGaussianProcess() {
  GaussianProcessOptions options;
  options.scaling = options_.scaling.value_or(Scaling::Global);
  options.relativeInputNoise = options_.noise;
  options.seed = options_.seed;
  GaussianProcessFit fit = trainGaussianProcess(inputs_, targets_, options, stop_);
  FitReport& report = decoder_.report;
  report.spread = fit.process.mean.spread;
  report.ridge = fit.process.noiseVariance;
  report.centers = static_cast<int>(fit.process.mean.centers.cols());
  report.condition = fit.condition;
  report.rank = report.centers;
  report.largestWeight = fit.process.mean.weights.cwiseAbs().maxCoeff();
  report.warnings = std::move(fit.warnings);
  decoder_.model = std::move(fit.process);
  recordResiduals(fit.leaveOneOutResiduals, samples_.area(fit.used));
}

void DecoderTraining::fitBackPropagation() {
  BackPropagationOptions options;
  options.relativeInputNoise = options_.noise;
  options.seed = options_.seed;
  BackPropagationFit fit = trainBackPropagation(inputs_, targets_, options, stop_,
                                                [this](double share) { say(0.9 * share, "back-propagation"); });
  decoder_.report.warnings = std::move(fit.warnings);
  decoder_.report.largestWeight =
      std::max(fit.network.hiddenWeights.cwiseAbs().maxCoeff(), fit.network.outputWeights.cwiseAbs().maxCoeff());
  decoder_.model = std::move(fit.network);
  recordResiduals(fit.heldOutResiduals, samples_.area(fit.heldOut));
}

void DecoderTraining::fitTwoStep(bool gaussNewton) {
  if (gaussNewton && !design_)
    throw Error("decoder: two-step-gn inverts the resistance law of the design; give the design with --design");
  TwoStepFit fit = trainTwoStep(samples_, gaussNewton ? design_ : nullptr, decoder_.input, options_, stop_,
                                [this](double share, const std::string& what) { say(0.9 * share, what); });
  decoder_.report = std::move(fit.report);
  decoder_.model = std::move(fit.decoder);
  recordResiduals(fit.residuals_N, samples_.area);
}

void DecoderTraining::fitLikelihood() {
  ForwardModel model = forwardModel();
  decoder_.report.rank = static_cast<int>(model.coefficients.front().cols());
  decoder_.report.centers = 0;
  decoder_.model = std::move(model);
  // The samples serve again, with the noise: the model has few unknowns against their number.
  decoder_.residual_N = Eigen::MatrixXd::Zero(samples_.forces_N.rows(), 1);
  recordResiduals(samples_.forces_N -
                      likelihoodForces(std::get<ForwardModel>(decoder_.model), inputs_, options_, stop_),
                  samples_.area);
}

void DecoderTraining::fitTouches() {
  if (!decoder_.place)
    throw Error("target: got force, expected force+place: the touch decoder learns force and position together");
  // Size and friction are estimated too: where they vary, the deviations of force and position depend on them.
  Eigen::MatrixXd parameters = Eigen::MatrixXd::Zero(targets_.rows() + 2, targets_.cols());
  parameters.topRows(targets_.rows()) = targets_;
  if (samples_.hasTouches()) // unknown for the indenter of a rig, which stays the same
    parameters.bottomRows<2>() << samples_.touches.row(kTouchSize_mm), samples_.touches.row(kTouchFriction);
  Eigen::VectorXi groups(parameters.rows());
  groups << 1, 1, 1, 0, 0, 2, 2;
  KernelForwardOptions options{options_.noise, options_.threads};
  if (design_ && samples_.hasTouches()) {
    options.priorMean = knownReadings(
        *design_, samples_, decoder_.input, options_.threads, stop_,
        [this](double share, const std::string& what) { say(kKnown * share, "Prior mean from the design: " + what); });
    options.mirrors = mirrorsOfTouches(*design_, parameters, decoder_.input);
    say(kKnown, "Correction learned from the samples");
  }
  KernelForwardFit fit = fitKernelForwardModel(inputs_, parameters, groups, options, stop_);
  decoder_.report.centers = static_cast<int>(samples_.size());
  decoder_.report.rank = static_cast<int>(fit.model.components());
  decoder_.report.spread = fit.width;
  decoder_.report.largestWeight = fit.model.table.coefficients.cwiseAbs().maxCoeff();
  decoder_.model = std::move(fit.model);
  recordResiduals(fit.heldOutResiduals.topRows(targets_.rows()), samples_.area(fit.heldOut));
}

ForwardModel DecoderTraining::forwardModel() {
  const Classes classes = classesOf(samples_);
  decoder_.areaOfClass = classes.area;
  ForwardModelOptions options;
  options.relativeNoise = options_.noise;
  return fitForwardModel(inputs_, samples_.forces_N, classes.ofSample, options, &decoder_.report.warnings);
}

void DecoderTraining::fitAreas() {
  if (decoder_.measured) return;
  if (samples_.hasTouches() || decoder_.place) return; // they lie on no area
  if (samples_.together() || samples_.areaCount < 2 || options_.decoder == DecoderKind::MaximumLikelihood) return;
  const Eigen::VectorXi& area = samples_.area;
  if (area.minCoeff() == area.maxCoeff()) return; // one area only: nothing to distinguish
  decoder_.areas = forwardModel();
}

/// The same decoder, with spread and ridge as chosen, without the rows of each fold.
void DecoderTraining::validateGroups() {
  TrainOptions same = options_;
  if (options_.decoder == DecoderKind::Rbf) {
    same.spread = decoder_.report.spread;
    same.ridge = decoder_.report.ridge;
  }
  const auto train = [&](const SampleSet& part) { return DecoderTraining(part, design_, same, stop_, {}).run(false); };
  try {
    const GroupedErrors found =
        groupedErrors(samples_, measuredRows(samples_, inputs_, targets_), options_.order, train, stop_,
                      [this](double share) { say(0.3 + 0.6 * share, "validating"); });
    recordResiduals(found.errors, samples_.area);
    decoder_.report.leftOut = leftOutInWords(found.dependence, static_cast<std::size_t>(samples_.size()));
  } catch (const Error& failed) {
    decoder_.report.warnings.push_back(std::string("the error is of single rows left out, as without a part of the "
                                                   "rows no decoder can be trained: ") +
                                       failed.what());
  }
}

/// Root mean square of each area's residuals; of all of them where an area has none.
void DecoderTraining::recordResiduals(const Eigen::MatrixXd& ofTargets, const Eigen::VectorXi& areas) {
  decoder_.report.leaveOneOut = residualRootMeanSquare(ofTargets);
  if (decoder_.place) decoder_.place->residual_mm = decoder_.report.leaveOneOut.tail<2>();
  const Eigen::MatrixXd residuals = ofTargets.topRows(samples_.forces_N.rows());
  const Eigen::VectorXd all = residualRootMeanSquare(residuals);
  const bool together = samples_.together();
  decoder_.residual_N = all.replicate(1, together ? 1 : std::max(1, samples_.areaCount));
  if (together) return;
  for (int area = 0; area < samples_.areaCount; ++area) {
    std::vector<Eigen::Index> members;
    for (Eigen::Index i = 0; i < areas.size(); ++i)
      if (areas(i) == area) members.push_back(i);
    if (!members.empty()) decoder_.residual_N.col(area) = residualRootMeanSquare(residuals(Eigen::all, members));
  }
}

void DecoderTraining::say(double share, const std::string& what) const {
  if (progress_) progress_(share, what);
}

} // namespace

Decoder trainDecoder(const SampleSet& samples, const SensorDesign* design, const TrainOptions& options,
                     const std::stop_token& stop, const std::function<void(double, const std::string&)>& progress) {
  return DecoderTraining(samples, design, options, stop, progress).run();
}

} // namespace palp
