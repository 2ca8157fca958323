#include "app/study/decoding/Calibration.h"

#include "app/study/Median.h"
#include "app/study/decoding/CalibrationMark.h"
#include "io/SampleFile.h"
#include "model/TouchRange.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "model/base/NumberText.h"
#include "nn/baselines/RecursiveLeastSquares.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr double kBadError = 0.1;    // of the force range
constexpr double kBadMismatch = 0.5; // of the change of R
constexpr double kLoaded = 0.05;     // of the force range: less is rest
constexpr std::size_t kFewestToJudge = 4;
constexpr double kSure = 0.9;        // of the area
constexpr double kOpposed = -0.5;    // correlation of labels and readings about 0: 1 where they agree
constexpr double kMovedNoise = 2.5;  // times the noise from frame to frame
constexpr double kMovedRange = 0.01; // of the force range: labels are good to 1 %
// Prior variance of gain and offset over that of a label: gains within 30 % are expected, labels are good to 1 %.
constexpr double kPriorVariance = 1e3;

using Correction = Eigen::MatrixXd; ///< rows: gains of the forces (or of x and y of a place), offset [range]

/// Forces over their range, or places, so that one prior fits all; one column per sample.
struct Scaled {
  Eigen::MatrixXd predicted, truth;
};

Correction start(Eigen::Index outputs) {
  Correction correction = Correction::Zero(outputs + 1, outputs);
  correction.topRows(outputs).setIdentity();
  return correction;
}

Eigen::VectorXd regressors(const Eigen::VectorXd& predicted) {
  Eigen::VectorXd all(predicted.size() + 1);
  all << predicted, 1;
  return all;
}

/// The correction from all samples but `left`.
Correction fit(const Scaled& samples, Eigen::Index left) {
  RecursiveLeastSquares estimate(start(samples.predicted.rows()), kPriorVariance);
  for (Eigen::Index i = 0; i < samples.predicted.cols(); ++i)
    if (i != left) estimate.update(regressors(samples.predicted.col(i)), samples.truth.col(i));
  return estimate.weights();
}

/// Each sample's error [range] after a fit without it; the work grows with the square of the frames.
Eigen::MatrixXd unseenErrors(const Scaled& samples, const std::stop_token& stop) {
  Eigen::MatrixXd errors(samples.predicted.rows(), samples.predicted.cols());
  for (Eigen::Index i = 0; i < errors.cols(); ++i) {
    throwIfStopped(stop);
    errors.col(i) = fit(samples, i).transpose() * regressors(samples.predicted.col(i)) - samples.truth.col(i);
  }
  return errors;
}

Eigen::VectorXd rms(const Eigen::MatrixXd& errors) {
  return (errors.rowwise().squaredNorm() / static_cast<double>(errors.cols())).cwiseSqrt();
}

void requireUsable(const Decoder& decoder, const SampleSet& frames) {
  if (!traits(decoder.kind).canBeCalibrated || decoder.outputs() != 3)
    throw Error("calibrate refines a network of one force by " + namesOfDecodersWith(&DecoderTraits::canBeCalibrated) +
                "; this network is " + name(decoder.kind) + " with " + std::to_string(decoder.outputs()) + " outputs");
  if (frames.together()) throw Error("calibrate takes frames with one area loaded at a time");
  if (frames.size() < kFewestCalibrationFrames)
    throw Error(std::to_string(frames.size()) + (frames.size() == 1 ? " labelled frame" : " labelled frames") +
                "; at least " + std::to_string(kFewestCalibrationFrames) + " are needed");
  requireReadout(decoder, frames.origin.readout, "the frames are");
  if (frames.origin.designFingerprint != decoder.designFingerprint)
    throw Error("the frames are of design " + frames.origin.designFingerprint + ", the network of " +
                decoder.designFingerprint);
}

/// F = A N + b in newton; of places in mm.
OutputCorrection inUnits(const Correction& correction, const Eigen::VectorXd& range) {
  const Eigen::Index outputs = range.size();
  return {range.asDiagonal() * correction.topRows(outputs).transpose() * range.cwiseInverse().asDiagonal(),
          range.cwiseProduct(correction.row(outputs).transpose())};
}

/// Forces, and below them places, which stay as they are where nothing is known of them.
OutputCorrection ofAll(const OutputCorrection& forces, const std::optional<OutputCorrection>& places,
                       Eigen::Index outputs) {
  if (outputs == forces.offset.size()) return forces;
  OutputCorrection all{Eigen::MatrixXd::Identity(outputs, outputs), Eigen::VectorXd::Zero(outputs)};
  all.gains.topLeftCorner(forces.gains.rows(), forces.gains.cols()) = forces.gains;
  all.offset.head(forces.offset.size()) = forces.offset;
  if (!places) return all;
  all.gains.bottomRightCorner<2, 2>() = places->gains;
  all.offset.tail<2>() = places->offset;
  return all;
}

/// Into the network's weights.
void apply(RbfNetwork& network, const OutputCorrection& affine) {
  network.weights = (affine.gains * network.weights).eval();
  if (network.tail.size() > 0) network.tail = (affine.gains * network.tail).eval();
  network.bias = affine.gains * network.bias + affine.offset;
}

/// After the existing correction.
void apply(std::optional<OutputCorrection>& there, const OutputCorrection& affine) {
  if (!there) {
    there = affine;
    return;
  }
  there->gains = (affine.gains * there->gains).eval();
  there->offset = affine.gains * there->offset + affine.offset;
}

/// Into the polynomials x(N): x(A^-1 (F - b)) is one of the same degree, found again through enough of its points.
void apply(ForwardModel& model, const OutputCorrection& affine) {
  const Eigen::Vector3d half = model.parameterFactor.cwiseInverse();
  const int side = 2 * (model.degree + 1); // a grid, so that twice the monomials are there at any degree
  const Eigen::Index points = static_cast<Eigen::Index>(side) * side * side;
  const auto classes = static_cast<Eigen::Index>(model.classes());
  Eigen::MatrixXd measurements(model.measurements(), points * classes);
  Eigen::MatrixXd parameters(3, points * classes);
  Eigen::VectorXi classOf(points * classes);
  const Eigen::PartialPivLU<Eigen::MatrixXd> gains(affine.gains);
  for (Eigen::Index i = 0; i < parameters.cols(); ++i) {
    const Eigen::Index place = i % points;
    const Eigen::Array3d step(static_cast<double>(place % side), static_cast<double>(place / side % side),
                              static_cast<double>(place / side / side));
    classOf(i) = static_cast<int>(i / points);
    parameters.col(i) = model.parameterOffset + half.cwiseProduct((2 * step / (side - 1) - 1).matrix());
    measurements.col(i) =
        model.measurementsOf(static_cast<std::size_t>(classOf(i)), gains.solve(parameters.col(i) - affine.offset));
  }
  ForwardModelOptions options;
  options.degree = model.degree;
  // About the mean, which keeps the digits that the small changes of R need.
  const Eigen::VectorXd mean = measurements.rowwise().mean();
  ForwardModel refined = fitForwardModel(measurements.colwise() - mean, parameters, classOf, options);
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
  if (model == nullptr || model->parameters() != 3) return {};
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

/// Components of which both labels and readings are more than rest, and of opposite signs in nearly all frames.
std::string opposedComponents(const Scaled& frames) {
  std::string components;
  const double rest = kLoaded * std::sqrt(static_cast<double>(frames.predicted.cols()));
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double predicted = frames.predicted.row(axis).norm(), truth = frames.truth.row(axis).norm();
    if (std::min(predicted, truth) < rest) continue;
    if (frames.predicted.row(axis).dot(frames.truth.row(axis)) < kOpposed * predicted * truth)
      components += "xyz"[axis];
  }
  return components;
}

std::string percent(double share) {
  return std::to_string(std::lround(100 * share)) + " %";
}

} // namespace

std::vector<std::string> warningsOf(const CalibrationReport& report) {
  std::vector<std::string> warnings;
  for (const char axis : report.opposed)
    warnings.push_back(std::string("the labels have the opposite sign of F") + axis +
                       " that the network reads: are their signs right (a push is negative in z)?");
  const double error = report.rmseAfter_percentOfRange.maxCoeff() / 100;
  if (!report.improved) warnings.push_back("on unseen frames it is no better than the previous network");
  if (error > kBadError) warnings.push_back("on unseen frames its error is " + percent(error) + " of the force range");
  if (report.place && !report.place->improved) warnings.emplace_back("its positions are no better on unseen frames");
  if (report.modelMismatch && *report.modelMismatch > kBadMismatch)
    warnings.push_back("the model under these labels gives other readings than the frames contain (" +
                       percent(*report.modelMismatch) + " of their change apart): areas, signs or loads are mixed up");
  return warnings;
}

namespace {

/// The correction of the places; none where the network or the frames have none.
std::optional<OutputCorrection> refinePlaces(const Decoder& decoder, const SampleSet& frames,
                                             const Eigen::MatrixXd& predicted_mm, CalibrationReport& report,
                                             const std::stop_token& stop) {
  if (!decoder.place || !frames.hasPlaces()) return {};
  const Eigen::VectorXd range_mm = decoder.place->high_mm - decoder.place->low_mm;
  if (!(range_mm.minCoeff() > 0)) return {}; // trained along a line
  const Eigen::MatrixXd truth_mm = frames.touchedPlaces_mm();
  const Scaled scaled{range_mm.cwiseInverse().asDiagonal() * predicted_mm,
                      range_mm.cwiseInverse().asDiagonal() * truth_mm};
  PlaceCalibration place;
  place.rmseBefore_mm = rms(predicted_mm - truth_mm);
  place.rmseAfter_mm = rms(range_mm.asDiagonal() * unseenErrors(scaled, stop));
  place.improved = place.rmseAfter_mm.norm() < place.rmseBefore_mm.norm();
  report.place = place;
  return inUnits(fit(scaled, -1), range_mm);
}

} // namespace

Calibration calibrate(const Decoder& decoder, const SampleSet& frames, const std::stop_token& stop) {
  requireUsable(decoder, frames);
  PredictOptions forcesAlone;
  forcesAlone.standardDeviation = forcesAlone.area = false;
  const Prediction predicted = frames.times_s.rows() > 0
                                   ? predict(decoder, frames, forcesAlone)
                                   : predict(decoder, inputsOf(frames, decoder.input), forcesAlone);
  const Eigen::Vector3d range_N = decoder.high_N - decoder.low_N;
  // A force that never varied in training has no part in the fit's scale.
  const Eigen::Vector3d scale_N = (range_N.array() > 0).select(range_N, range_N.maxCoeff());
  const Scaled scaled{scale_N.cwiseInverse().asDiagonal() * predicted.forces_N,
                      scale_N.cwiseInverse().asDiagonal() * frames.forces_N};

  Calibration result{decoder, {}};
  CalibrationReport& report = result.report;
  report.samples = frames.size();
  report.samplesPerArea.assign(static_cast<std::size_t>(frames.areaCount), 0);
  for (const int area : frames.area) ++report.samplesPerArea[static_cast<std::size_t>(area)];
  report.lowest_N = frames.forces_N.rowwise().minCoeff();
  report.highest_N = frames.forces_N.rowwise().maxCoeff();
  report.coverage_percent =
      (range_N.array() > 0).select(100 * (report.highest_N - report.lowest_N).cwiseQuotient(scale_N), 100.);

  const Eigen::MatrixXd unseen_N = scale_N.asDiagonal() * unseenErrors(scaled, stop);
  report.rmseBefore_N = rms(predicted.forces_N - frames.forces_N);
  report.rmseAfter_N = rms(unseen_N);
  report.rmseAfter_percentOfRange = 100 * report.rmseAfter_N.cwiseQuotient(scale_N);
  report.worstError_N = unseen_N.colwise().norm().maxCoeff(&report.worstSample);
  report.improved =
      report.rmseAfter_N.cwiseQuotient(scale_N).norm() < report.rmseBefore_N.cwiseQuotient(scale_N).norm();
  const std::optional<OutputCorrection> places = refinePlaces(decoder, frames, predicted.places_mm, report, stop);

  report.modelMismatch = modelMismatch(decoder, frames);
  report.opposed = opposedComponents(scaled);

  const OutputCorrection affine = ofAll(inUnits(fit(scaled, -1), scale_N), places, decoder.answers());
  if (keepsCorrection(decoder))
    apply(result.decoder.correction, affine);
  else if (auto* network = std::get_if<RbfNetwork>(&result.decoder.model))
    apply(*network, affine);
  else if (auto* model = std::get_if<ForwardModel>(&result.decoder.model))
    apply(*model, affine);
  result.decoder.residual_N = report.rmseAfter_N.replicate(1, std::max<Eigen::Index>(1, decoder.residual_N.cols()));
  result.decoder.trainedWith = withCalibrationMark(decoder.trainedWith, frames.size());
  if (report.place) result.decoder.place->residual_mm = report.place->rmseAfter_mm;
  return result;
}

KnownTouch knownTouch(const SensorDesign& design, const Eigen::Vector2d& place_mm, const Eigen::Vector3d& force_N) {
  if (!((place_mm.array() >= 0) && (place_mm.array() <= design.block_mm.head<2>().array())).all())
    throw Error("label: position: " +
                gotExpected(shortTexts(place_mm) + " mm",
                            "(0, 0) to " + shortTexts(design.block_mm.head<2>()) + " mm, on the face"));
  return {{areaUnder(design, place_mm), force_N}, place_mm};
}

FrameAverage::FrameAverage(const Decoder& decoder, const SensorDesign& design, const KnownTouch& label) {
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
  set_.area = Eigen::VectorXi::Constant(1, label.load.area);
  set_.forces_N = label.load.force_N;
  if (label.place_mm) set_.places_mm = *label.place_mm;
  set_.displacements_mm.resize(0, 1);
  sum_ = Eigen::MatrixXd::Zero(set_.rowWires, set_.columnWires);
  range_N_ = (decoder.high_N - decoder.low_N).head<3>();
}

void FrameAverage::add(const DecodedForces& forces) {
  if (!forces.valid || forces.missingReadings > 0) return; // a label needs all readings
  sum_ += forces.resistances_ohm;
  ++count_;
  if (forces.forces_N.cols() == 1) predicted_N_.push_back(forces.forces_N.col(0));
  const bool sure = forces.area && forces.areaConfidence > kSure && !forces.shown.empty() && forces.shown.front();
  if (sure) ++seenOn_[*forces.area];
}

std::string FrameAverage::onAnotherArea() const {
  for (const auto& [area, frames] : seenOn_)
    if (area != set_.area(0) && 2 * frames > count_)
      return "the network detects this load on area " + std::to_string(area) + ", the label has area " +
             std::to_string(set_.area(0));
  return {};
}

Eigen::Vector3d FrameAverage::predicted_N() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& predicted : predicted_N_) sum += predicted;
  return sum / static_cast<double>(predicted_N_.size()); // NaN where there is none
}

/// Noise jumps from frame to frame, a load that moves does not: its scatter is more than that of neighbours.
std::string FrameAverage::moved() const {
  if (predicted_N_.size() < kFewestToJudge) return {};
  const Eigen::Vector3d mean = predicted_N();
  Eigen::Array3d scatter = Eigen::Array3d::Zero(), neighbours = Eigen::Array3d::Zero();
  for (std::size_t i = 0; i < predicted_N_.size(); ++i) {
    scatter += (predicted_N_[i] - mean).array().square();
    if (i > 0) neighbours += (predicted_N_[i] - predicted_N_[i - 1]).array().square() / 2;
  }
  const auto count = static_cast<double>(predicted_N_.size());
  const Eigen::Array3d deviation = (scatter / (count - 1)).sqrt(), noise = (neighbours / (count - 1)).sqrt();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (deviation(axis) <= std::max(kMovedNoise * noise(axis), kMovedRange * range_N_(axis))) continue;
    const auto [low, high] =
        std::minmax_element(predicted_N_.begin(), predicted_N_.end(),
                            [axis](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a(axis) < b(axis); });
    return std::string("F") + "xyz"[axis] + " lay between " + withDigits((*low)(axis), 3) + " and " +
           withDigits((*high)(axis), 3) + " N";
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
    if (const std::string differs = differenceOfHeads(all, frames); !differs.empty())
      throw Error(path.string() + ": contains other frames: " + differs);
    for (Eigen::Index k = 0; k < all.size(); ++k)
      if (all.resistances_ohm.col(k) == frames.resistances_ohm.col(0) &&
          all.forces_N.col(k) == frames.forces_N.col(0) && all.area(k) == frames.area(0))
        throw Error(path.string() + ": duplicate frame (sample " + std::to_string(k + 1) + " of " +
                    std::to_string(all.size()) + "); it would count twice");
  }
  append(all, frames);
  saveSamples(path, all, true);
}

} // namespace palp
