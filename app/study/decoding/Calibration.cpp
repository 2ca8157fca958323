#include "app/study/decoding/Calibration.h"

#include "app/study/Median.h"
#include "io/SampleFile.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "nn/rivals/RecursiveLeastSquares.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace palp {

namespace {

constexpr double kBadError = 0.1;    // of the force range
constexpr double kBadMismatch = 0.5; // of the change of R
constexpr double kLoaded = 0.05;     // of the force range: less is rest
constexpr std::size_t kFewestToJudge = 4;
constexpr double kSure = 0.9;        // of the area
constexpr double kMovedNoise = 2.5;  // times the noise from frame to frame
constexpr double kMovedRange = 0.01; // of the force range: labels are good to 1 %
// Prior variance of gain and offset over that of a label: gains within 30 % are expected, labels are good to 1 %.
constexpr double kPriorVariance = 1e3;

using Correction = Eigen::Matrix<double, 4, 3>; ///< rows: gains of the three forces, offset [range]

/// Forces over their range, so that one prior fits all.
struct Scaled {
  Eigen::Matrix3Xd said, truth;
};

Correction start() {
  Correction correction = Correction::Zero();
  correction.topRows<3>().setIdentity();
  return correction;
}

Eigen::Vector4d regressors(const Eigen::Vector3d& said) {
  return {said.x(), said.y(), said.z(), 1};
}

/// The correction from all samples but `left`.
Correction fit(const Scaled& samples, Eigen::Index left) {
  RecursiveLeastSquares estimate(start(), kPriorVariance);
  for (Eigen::Index i = 0; i < samples.said.cols(); ++i)
    if (i != left) estimate.update(regressors(samples.said.col(i)), samples.truth.col(i));
  return estimate.weights();
}

Eigen::Vector3d rms(const Eigen::Matrix3Xd& errors) {
  return (errors.rowwise().squaredNorm() / static_cast<double>(errors.cols())).cwiseSqrt();
}

void requireUsable(const Decoder& decoder, const SampleSet& frames) {
  const bool refinable =
      std::holds_alternative<RbfNetwork>(decoder.model) || std::holds_alternative<ForwardModel>(decoder.model);
  if (!refinable || decoder.outputs() != 3)
    throw Error("calibrate refines an rbf or ml network of one force; this network is " + name(decoder.kind) +
                " with " + std::to_string(decoder.outputs()) + " outputs");
  if (frames.together()) throw Error("calibrate takes frames with one area loaded at a time");
  if (frames.size() < kFewestCalibrationFrames)
    throw Error(std::to_string(frames.size()) + " labelled frames; at least " +
                std::to_string(kFewestCalibrationFrames) + " are needed");
  requireReadout(decoder, frames.origin.readout, "the frames are");
  if (frames.origin.designFingerprint != decoder.designFingerprint)
    throw Error("the frames are of design " + frames.origin.designFingerprint + ", the network of " +
                decoder.designFingerprint);
}

/// F = A N + b in newton.
struct Affine {
  Eigen::Matrix3d gains;
  Eigen::Vector3d offset_N;
};

Affine inNewton(const Correction& correction, const Eigen::Vector3d& range_N) {
  return {range_N.asDiagonal() * correction.topRows<3>().transpose() * range_N.cwiseInverse().asDiagonal(),
          range_N.cwiseProduct(correction.row(3).transpose())};
}

/// Into the network's weights.
void apply(RbfNetwork& network, const Affine& affine) {
  network.weights = (affine.gains * network.weights).eval();
  if (network.tail.size() > 0) network.tail = (affine.gains * network.tail).eval();
  network.bias = affine.gains * network.bias + affine.offset_N;
}

/// Into the polynomials x(N): x(A^-1 (F - b)) is one of the same degree, found again through enough of its points.
void apply(ForwardModel& model, const Affine& affine) {
  const Eigen::Vector3d half = model.causeFactor.cwiseInverse();
  const int side = 2 * (model.degree + 1); // a grid, so that twice the monomials are there at any degree
  const Eigen::Index points = static_cast<Eigen::Index>(side) * side * side;
  const auto classes = static_cast<Eigen::Index>(model.classes());
  Eigen::MatrixXd measurements(model.measurements(), points * classes);
  Eigen::MatrixXd causes(3, points * classes);
  Eigen::VectorXi classOf(points * classes);
  const Eigen::PartialPivLU<Eigen::Matrix3d> gains(affine.gains);
  for (Eigen::Index i = 0; i < causes.cols(); ++i) {
    const Eigen::Index place = i % points;
    const Eigen::Array3d step(static_cast<double>(place % side), static_cast<double>(place / side % side),
                              static_cast<double>(place / side / side));
    classOf(i) = static_cast<int>(i / points);
    causes.col(i) = model.causeOffset + half.cwiseProduct((2 * step / (side - 1) - 1).matrix());
    measurements.col(i) =
        model.measurementsOf(static_cast<std::size_t>(classOf(i)), gains.solve(causes.col(i) - affine.offset_N));
  }
  ForwardModelOptions options;
  options.degree = model.degree;
  // About the mean, which keeps the digits that the small changes of R need.
  const Eigen::VectorXd mean = measurements.rowwise().mean();
  ForwardModel refined = fitForwardModel(measurements.colwise() - mean, causes, classOf, options);
  for (Eigen::MatrixXd& coefficients : refined.coefficients) coefficients.col(0) += mean;
  refined.deviation = model.deviation;
  model = std::move(refined);
}

} // namespace

namespace {

/// Class of an area in a forward model; none where the model does not know it.
std::optional<std::size_t> classOf(const Decoder& decoder, const ForwardModel& model, int area) {
  if (decoder.areaOfClass.empty())
    return area < static_cast<int>(model.classes()) ? std::optional(static_cast<std::size_t>(area)) : std::nullopt;
  const auto found = std::find(decoder.areaOfClass.begin(), decoder.areaOfClass.end(), area);
  if (found == decoder.areaOfClass.end()) return {};
  return static_cast<std::size_t>(found - decoder.areaOfClass.begin());
}

std::optional<double> modelMismatch(const Decoder& decoder, const SampleSet& frames) {
  const ForwardModel* model = decoder.areas ? &*decoder.areas : std::get_if<ForwardModel>(&decoder.model);
  if (model == nullptr || model->causes() != 3) return {};
  const Eigen::MatrixXd inputs = inputsOf(frames, decoder.input);
  const Eigen::Vector3d range_N = decoder.high_N - decoder.low_N;
  std::vector<double> shares;
  for (Eigen::Index i = 0; i < frames.size(); ++i) {
    const std::optional<std::size_t> c = classOf(decoder, *model, frames.area(i));
    if (!c || frames.forces_N.col(i).cwiseQuotient(range_N).norm() < kLoaded) continue;
    const Eigen::VectorXd rest = model->measurementsOf(*c, Eigen::Vector3d::Zero());
    const Eigen::VectorXd expected = model->measurementsOf(*c, frames.forces_N.col(i));
    const double size = std::max((inputs.col(i) - rest).norm(), (expected - rest).norm());
    shares.push_back((inputs.col(i) - expected).norm() / size);
  }
  return shares.empty() ? std::nullopt : std::optional(median(std::move(shares)));
}

std::string percent(double share) {
  return std::to_string(std::lround(100 * share)) + " %";
}

} // namespace

std::vector<std::string> warningsOf(const CalibrationReport& report) {
  std::vector<std::string> warnings;
  const double error = report.rmseAfter_percentOfRange.maxCoeff() / 100;
  if (!report.improved) warnings.push_back("on frames that it has not seen it is no better than the network before");
  if (error > kBadError)
    warnings.push_back("on frames that it has not seen it is off by " + percent(error) + " of the force range");
  if (report.modelMismatch && *report.modelMismatch > kBadMismatch)
    warnings.push_back("the model under these labels gives other readings than the frames hold (" +
                       percent(*report.modelMismatch) + " of their change apart): areas, signs or loads are mixed up");
  return warnings;
}

Calibration calibrate(const Decoder& decoder, const SampleSet& frames, const std::stop_token& stop) {
  requireUsable(decoder, frames);
  PredictOptions forcesAlone;
  forcesAlone.standardDeviation = forcesAlone.area = false;
  const Eigen::Matrix3Xd said_N = predict(decoder, inputsOf(frames, decoder.input), forcesAlone).forces_N;
  const Eigen::Vector3d range_N = decoder.high_N - decoder.low_N;
  const Scaled scaled{range_N.cwiseInverse().asDiagonal() * said_N,
                      range_N.cwiseInverse().asDiagonal() * frames.forces_N};

  Calibration result{decoder, {}};
  CalibrationReport& report = result.report;
  report.samples = frames.size();
  report.samplesPerArea.assign(static_cast<std::size_t>(frames.areaCount), 0);
  for (const int area : frames.area) ++report.samplesPerArea[static_cast<std::size_t>(area)];
  report.lowest_N = frames.forces_N.rowwise().minCoeff();
  report.highest_N = frames.forces_N.rowwise().maxCoeff();
  report.coverage_percent = 100 * (report.highest_N - report.lowest_N).cwiseQuotient(range_N);

  Eigen::Matrix3Xd unseen_N(3, frames.size());
  for (Eigen::Index i = 0; i < frames.size(); ++i) {
    stopIfAsked(stop); // the work grows with the square of the frames
    const Eigen::Vector3d corrected = fit(scaled, i).transpose() * regressors(scaled.said.col(i));
    unseen_N.col(i) = range_N.cwiseProduct(corrected - scaled.truth.col(i));
  }
  report.rmseBefore_N = rms(said_N - frames.forces_N);
  report.rmseAfter_N = rms(unseen_N);
  report.rmseAfter_percentOfRange = 100 * report.rmseAfter_N.cwiseQuotient(range_N);
  report.worstError_N = unseen_N.colwise().norm().maxCoeff(&report.worstSample);
  report.improved =
      report.rmseAfter_N.cwiseQuotient(range_N).norm() < report.rmseBefore_N.cwiseQuotient(range_N).norm();

  report.modelMismatch = modelMismatch(decoder, frames);

  const Affine affine = inNewton(fit(scaled, -1), range_N);
  if (auto* network = std::get_if<RbfNetwork>(&result.decoder.model)) apply(*network, affine);
  if (auto* model = std::get_if<ForwardModel>(&result.decoder.model)) apply(*model, affine);
  result.decoder.residual_N = report.rmseAfter_N.replicate(1, std::max<Eigen::Index>(1, decoder.residual_N.cols()));
  return result;
}

FrameAverage::FrameAverage(const Decoder& decoder, const SensorDesign& design, const AreaLoad& label) {
  set_.origin.designFingerprint = decoder.designFingerprint;
  set_.origin.readout = decoder.readout;
  set_.origin.seed = 0;
  set_.origin.areas = "each";
  set_.origin.perArea = 1;
  set_.origin.mesh = "measured on a board";
  set_.origin.solverTolerance = 0;
  set_.rowWires = decoder.input.rowWires;
  set_.electrodesPerRowWire = design.electrodesPerRowWire();
  set_.columnWires = decoder.input.valuesPerRow;
  set_.areaCount = design.areas.count();
  set_.area = Eigen::VectorXi::Constant(1, label.area);
  set_.forces_N = label.force_N;
  set_.displacements_mm.resize(0, 1);
  sum_ = Eigen::MatrixXd::Zero(set_.rowWires, set_.columnWires);
  range_N_ = (decoder.high_N - decoder.low_N).head<3>();
}

void FrameAverage::add(const DecodedForces& forces) {
  if (!forces.valid) return;
  sum_ += forces.resistances_ohm;
  ++count_;
  if (forces.forces_N.cols() == 1) said_N_.push_back(forces.forces_N.col(0));
  const bool sure = forces.area && forces.areaConfidence > kSure && !forces.shown.empty() && forces.shown.front();
  if (sure) ++seenOn_[*forces.area];
}

std::string FrameAverage::onAnotherArea() const {
  for (const auto& [area, frames] : seenOn_)
    if (area != set_.area(0) && 2 * frames > count_)
      return "the network sees this load on area " + std::to_string(area) + ", the label says area " +
             std::to_string(set_.area(0));
  return {};
}

Eigen::Vector3d FrameAverage::said_N() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& said : said_N_) sum += said;
  return sum / static_cast<double>(said_N_.size()); // NaN where there is none
}

/// Noise jumps from frame to frame, a load that moves does not: its scatter is more than that of neighbours.
std::string FrameAverage::moved() const {
  if (said_N_.size() < kFewestToJudge) return {};
  const Eigen::Vector3d mean = said_N();
  Eigen::Array3d scatter = Eigen::Array3d::Zero(), neighbours = Eigen::Array3d::Zero();
  for (std::size_t i = 0; i < said_N_.size(); ++i) {
    scatter += (said_N_[i] - mean).array().square();
    if (i > 0) neighbours += (said_N_[i] - said_N_[i - 1]).array().square() / 2;
  }
  const auto count = static_cast<double>(said_N_.size());
  const Eigen::Array3d deviation = (scatter / (count - 1)).sqrt(), noise = (neighbours / (count - 1)).sqrt();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (deviation(axis) <= std::max(kMovedNoise * noise(axis), kMovedRange * range_N_(axis))) continue;
    const auto [low, high] =
        std::minmax_element(said_N_.begin(), said_N_.end(),
                            [axis](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a(axis) < b(axis); });
    std::array<char, 80> text{};
    std::snprintf(text.data(), text.size(), "F%c lay between %.3g and %.3g N", "xyz"[axis], (*low)(axis),
                  (*high)(axis));
    return text.data();
  }
  return {};
}

SampleSet FrameAverage::sample() const {
  SampleSet mean = set_;
  mean.resistances_ohm = (sum_ / std::max(1, count_)).reshaped<Eigen::RowMajor>();
  return mean;
}

void appendFrames(const std::filesystem::path& path, const SampleSet& frames) {
  SampleSet all;
  if (std::filesystem::exists(path)) {
    all = loadSamples(path);
    if (const std::string differs = difference(all.origin, frames.origin); !differs.empty())
      throw Error(path.string() + ": holds other frames: " + differs);
  }
  append(all, frames);
  saveSamples(path, all, true);
}

} // namespace palp
