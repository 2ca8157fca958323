#include "app/study/decoding/Calibration.h"

#include "io/SampleFile.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "nn/rivals/RecursiveLeastSquares.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr Eigen::Index kFewestFrames = 8; // 4 unknowns for each force, and as many again to judge them by
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
  if (frames.size() < kFewestFrames)
    throw Error(std::to_string(frames.size()) + " labelled frames; at least " + std::to_string(kFewestFrames) +
                " are needed");
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

  const Affine affine = inNewton(fit(scaled, -1), range_N);
  if (auto* network = std::get_if<RbfNetwork>(&result.decoder.model)) apply(*network, affine);
  if (auto* model = std::get_if<ForwardModel>(&result.decoder.model)) apply(*model, affine);
  result.decoder.residual_N = report.rmseAfter_N.replicate(1, std::max<Eigen::Index>(1, decoder.residual_N.cols()));
  return result;
}

FrameAverage::FrameAverage(const Decoder& decoder, const SensorDesign& design, const AreaLoad& label) {
  set_.origin.designFingerprint = decoder.designFingerprint;
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
}

void FrameAverage::add(const DecodedForces& forces) {
  if (!forces.valid) return;
  sum_ += forces.resistances_ohm;
  ++count_;
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
