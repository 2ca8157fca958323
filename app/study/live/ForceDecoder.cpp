#include "app/study/live/ForceDecoder.h"

#include "app/study/decoding/CalibrationMark.h"
#include "io/DesignFile.h"
#include "model/FieldAtRest.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "model/base/NumberText.h"
#include "nn/NetworkError.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace palp {

namespace {

// At rest, 3 components of 10,000 frames stay below 6 standard deviations with a probability of 0.99994.
constexpr double kShowAbove = 6;
constexpr double kHideBelow = 4;
constexpr int kMostTareFrames = 100000;
constexpr double kSameNoise = 0.1;  // nearer than this is the same noise
constexpr double kMostNoise = 0.99; // relative
constexpr Eigen::Index kRestCopies = 32;
constexpr double kMoving = 2.5;      // times the noise of a frame: the sensor moved during the tare
constexpr double kDrowned = 0.5;     // of the force range: a deviation that leaves nothing of the force
constexpr double kFewestShare = 0.5; // of the readings, from which a force is found
constexpr double kRestReach = 4;     // deviations from rest, at which half of its error counts

std::string sizes(int rows, int columns) {
  return std::to_string(rows) + " row-wires x " + std::to_string(columns) + " column-wires";
}

void requireFit(const Decoder& decoder, const BoardInfo& info) {
  if (decoder.input.kind != InputKind::Resistance)
    throw Error("the network reads " + name(decoder.input.kind) +
                "s, but a board gives resistances; train a network with resistance as its input");
  if (decoder.input.rowWires != info.rowWires || decoder.input.valuesPerRow != info.columnWires)
    throw Error("the network is for " + sizes(decoder.input.rowWires, decoder.input.valuesPerRow) + ", the board has " +
                sizes(info.rowWires, info.columnWires) + ": only raw readings can be shown");
  requireReadout(decoder, info.readout, "the board is");
}

/// Resistances at rest; empty where the network's design is not known.
Eigen::MatrixXd restResistances(const Decoder& decoder, const std::optional<SensorDesign>& design) {
  const SensorDesign known = design.value_or(paperDesign());
  if (designFingerprint(known) == decoder.designFingerprint) return resistancesAtRest_ohm(known);
  if (design)
    throw Error("the network is of design " + decoder.designFingerprint + ", the given design is " +
                designFingerprint(known) + "; give the design that the network was trained for");
  return {};
}

/// The rows that the decoder reads, one after the other.
Eigen::VectorXd inputOf(const Eigen::MatrixXd& resistances_ohm, const DecoderInput& input) {
  Eigen::VectorXd values(input.low.size());
  for (std::size_t i = 0; i < input.rows.size(); ++i)
    values.segment(static_cast<Eigen::Index>(i) * input.valuesPerRow, input.valuesPerRow) =
        resistances_ohm.row(input.rows[i]).transpose();
  return values;
}

} // namespace

Eigen::Matrix3Xd DecodedForces::measuredAlone(const Eigen::Matrix3Xd& values) const {
  Eigen::Matrix3Xd all = values;
  for (Eigen::Index column = 0; column < all.cols(); ++column)
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      if (!measures(axis, column)) all(axis, column) = std::numeric_limits<double>::quiet_NaN();
  return all;
}

ForceDecoder::ForceDecoder(Decoder decoder, const BoardInfo& info, std::optional<SensorDesign> design)
    : decoder_(std::make_unique<const Decoder>(std::move(decoder))) {
  requireFit(*decoder_, info);
  rest_ohm_ = restResistances(*decoder_, design);
  factor_ = Eigen::MatrixXd::Ones(info.rowWires, info.columnWires);
  measured_.resize(3, decoder_->outputs() / 3);
  for (Eigen::Index k = 0; k < measured_.size(); ++k) measured_(k) = decoder_->high_N(k) > decoder_->low_N(k);
  calibrationError_N_ = calibrationError_N(*decoder_).reshaped(3, measured_.cols());
  shown_.assign(static_cast<std::size_t>(decoder_->outputs() / 3), false);
  plausibility_.emplace(*decoder_);
  if (decoder_->measured && decoder_->measured->stage.hasMemory())
    memory_.emplace(decoder_->measured->stage.times_s, decoder_->measured->stage.longestGap_s);
  setNoise(decoder_->noise);
}

void ForceDecoder::setNoise(double noise) {
  if (predictor_ && std::abs(noise - noise_) <= kSameNoise * noise_) return;
  noise_ = noise;
  PredictOptions options;
  // The noise of the mean of the tare's frames is in every frame since.
  options.noise = std::min(tared_ ? noise * std::sqrt(1 + 1.0 / tareFrames_) : noise, kMostNoise);
  fewer_.reset();
  predictorOptions_ = options;
  predictor_.emplace(*decoder_, options);
  predictedNoise_ = options.noise;
  restError_N_ = Eigen::Matrix3Xd::Zero(3, decoder_->outputs() / 3);
  if (rest_ohm_.size() == 0) return;
  // The mean over noise: it is not the answer for readings without any.
  const Eigen::VectorXd rest_ohm = inputOf(rest_ohm_, decoder_->input);
  Eigen::MatrixXd noisy_ohm = rest_ohm.replicate(1, kRestCopies);
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  for (double& reading_ohm : noisy_ohm.reshaped()) reading_ohm *= 1 + options.noise * normal(engine);
  PredictOptions forcesAlone = options;
  forcesAlone.standardDeviation = forcesAlone.area = false;
  const Eigen::VectorXd mean_N = predict(*decoder_, noisy_ohm, forcesAlone).forces_N.rowwise().mean();
  restError_N_ = mean_N.reshaped(3, restError_N_.cols());
}

/// Without a tare the board's noise is unknown.
void ForceDecoder::followNoise(const Eigen::VectorXd& raw_ohm) {
  meter_.add(raw_ohm);
  if (!tared_ && meter_.noise() > 0) setNoise(std::max(decoder_->noise, meter_.noise()));
}

std::string ForceDecoder::tareProblem() const {
  if (rest_ohm_.size() > 0) return {};
  return "tare needs the resistances at rest of design " + decoder_->designFingerprint +
         ", for which the network was trained; give that design";
}

void ForceDecoder::startTare(int frames) {
  if (const std::string problem = tareProblem(); !problem.empty()) throw Error(problem);
  if (frames < 1 || frames > kMostTareFrames)
    throw Error("tare: " + gotExpected(std::to_string(frames) + " frames", "1 to " + std::to_string(kMostTareFrames)));
  tareFrames_ = tareLeft_ = frames;
  tareSum_ = tareSquares_ = tareCounts_ = Eigen::MatrixXd::Zero(factor_.rows(), factor_.cols());
  tareFirst_.resize(0, 0);
}

void ForceDecoder::clearTare() {
  tareLeft_ = 0;
  tared_ = false;
  if (memory_) memory_->reset();
  factor_.setOnes();
  meter_.restart();
  predictor_.reset();
  setNoise(decoder_->noise);
}

PresentReadings ForceDecoder::presentIn(const BoardFrame& frame) const {
  PresentReadings readings;
  Eigen::Index k = 0;
  for (const int row : decoder_->input.rows)
    for (Eigen::Index column = 0; column < decoder_->input.valuesPerRow; ++column, ++k)
      (frame.state(row, column) == ReadingState::Good ? readings.present : readings.missing).push_back(k);
  return readings;
}

Prediction ForceDecoder::predicted(double time_s, const Eigen::VectorXd& readings_ohm,
                                   const PresentReadings& readings) {
  if (readings.missing.empty() && memory_) {
    const InputStage& stage = decoder_->measured->stage;
    Eigen::MatrixXd staged = stage.held(readings_ohm);
    const double clock = stage.rowsAreClock ? static_cast<double>(memoryFrames_++) : time_s;
    const Eigen::VectorXd& differences = memory_->next(clock, stage.rememberedOf(staged.topRows(readings_ohm.size())));
    staged.bottomRows(differences.size()) = differences;
    return (*predictor_)(readings_ohm, staged);
  }
  if (readings.missing.empty()) return (*predictor_)(readings_ohm);
  if (!fewer_) fewer_ = std::make_unique<PartialPredictor>(*decoder_, predictorOptions_);
  return (*fewer_)(readings_ohm, readings);
}

/// Empty where the readings that came give a force.
std::string ForceDecoder::reasonAgainst(const BoardFrame& frame, const PresentReadings& readings) const {
  if (readings.missing.empty()) return {};
  for (const int row : decoder_->input.rows)
    if (!frame.rowExpected[static_cast<std::size_t>(row)])
      return "the board does not scan row-wire " + std::to_string(row) + ", which the network reads";
  const std::string whyNot = whyNotFewer(*decoder_);
  const auto present = static_cast<double>(readings.present.size());
  if (whyNot.empty() && present >= kFewestShare * static_cast<double>(decoder_->inputs())) return {};
  if (!frame.complete) return "a report of the frame is lost";
  const std::vector<std::string> faults = wireFaults(frame);
  std::string all;
  for (const std::string& fault : faults) {
    if (all.size() > 200) return all + ", ...";
    all += (all.empty() ? "" : "; ") + fault;
  }
  return all;
}

/// Mean for the scale, scatter for the noise; sums about each reading's first, because the scatter is 1e-6 of the mean.
void ForceDecoder::addToTare(const BoardFrame& frame) {
  const Eigen::MatrixXd& raw_ohm = frame.resistances_ohm;
  if (tareFirst_.size() == 0) tareFirst_ = Eigen::MatrixXd::Zero(raw_ohm.rows(), raw_ohm.cols());
  const auto good = (frame.state.array() == ReadingState::Good && raw_ohm.array() > 0).eval();
  tareFirst_ = (good && tareFirst_.array() == 0).select(raw_ohm, tareFirst_);
  const Eigen::MatrixXd relative = good.select(raw_ohm.array() / tareFirst_.array() - 1, 0.0);
  tareSum_ += relative;
  tareSquares_ += relative.cwiseAbs2();
  tareCounts_ += good.cast<double>().matrix();
  if (--tareLeft_ > 0) return;
  const Eigen::ArrayXXd counts = tareCounts_.array().max(1);
  const Eigen::ArrayXXd mean = tareSum_.array() / counts;
  double noise = noise_;
  if (tareFrames_ > 1) {
    const Eigen::MatrixXd square = (tareSquares_.array() - counts * mean.square()).cwiseMax(0.0);
    const double freedom = inputOf((counts - 1).matrix(), decoder_->input).sum();
    if (freedom > 0) noise = std::sqrt(inputOf(square, decoder_->input).sum() / freedom);
    if (meter_.ready() && noise > kMoving * meter_.noise()) return startTare(tareFrames_);
  }
  const Eigen::ArrayXXd seen_ohm = tareFirst_.array() * (1 + mean);
  setTare({(seen_ohm > 0).select(seen_ohm, rest_ohm_.array()), noise, tareFrames_});
  ++tares_;
}

void ForceDecoder::setTare(const Tare& tare) {
  if (tare.rest_ohm.rows() != rest_ohm_.rows() || tare.rest_ohm.cols() != rest_ohm_.cols()) return;
  tare_ = tare;
  if (memory_) memory_->reset();
  factor_ = (tare.rest_ohm.array() > 0).select(rest_ohm_.array() / tare.rest_ohm.array(), 1.0);
  tareFrames_ = tare.frames;
  tareLeft_ = 0;
  tared_ = true;
  predictor_.reset(); // also where the noise is the same: the mean has its own
  setNoise(tare.noise);
}

DecodedForces ForceDecoder::decode(const BoardFrame& frame) {
  DecodedForces decoded;
  const PresentReadings readings = presentIn(frame);
  decoded.reason = reasonAgainst(frame, readings);
  if (!decoded.reason.empty()) return decoded;
  decoded.readings = static_cast<int>(decoder_->inputs());
  decoded.missingReadings = static_cast<int>(readings.missing.size());
  if (taring()) addToTare(frame);
  Eigen::VectorXd raw_ohm = inputOf(frame.resistances_ohm, decoder_->input);
  raw_ohm(readings.missing).setConstant(std::numeric_limits<double>::quiet_NaN());
  followNoise(raw_ohm);
  decoded.resistances_ohm = frame.resistances_ohm.cwiseProduct(factor_);
  const Eigen::VectorXd readings_ohm = inputOf(decoded.resistances_ohm, decoder_->input);
  Prediction prediction;
  try {
    prediction = predicted(frame.time_s, readings_ohm, readings);
  } catch (const NetworkError& undetermined) { // by the readings of this frame; the next one may have others
    decoded.reason = undetermined.what();
    return decoded;
  }
  const Eigen::Index columns = decoder_->outputs() / 3;
  decoded.forces_N = prediction.forces_N.reshaped(3, columns);
  decoded.standardDeviation_N = prediction.standardDeviation_N.reshaped(3, columns);
  decoded.measured = measured_;
  if (prediction.area.size() > 0) {
    decoded.area = prediction.area(0);
    decoded.areaConfidence = prediction.areaConfidence(0);
  }
  decoded.valid = decoded.forces_N.allFinite();
  if (!decoded.valid) decoded.reason = "the network's output is not a number for these readings";
  addRestError(decoded);
  threshold(decoded);
  if (prediction.places_mm.cols() == 1 && decoded.shown.front()) {
    decoded.place_mm = prediction.places_mm.col(0);
    if (prediction.placeDeviation_mm.cols() == 1) decoded.placeDeviation_mm = prediction.placeDeviation_mm.col(0);
    if (prediction.indenterSize_mm.size() == 1) decoded.indenterSize_mm = prediction.indenterSize_mm(0);
  }
  if (decoded.valid) judge(frame, prediction, readings_ohm, readings, decoded);
  return decoded;
}

Eigen::Vector3d ForceDecoder::drifted_N(double relative) const {
  if (rest_ohm_.size() == 0 || decoder_->outputs() != 3) return Eigen::Vector3d::Zero();
  const Eigen::VectorXd rest_ohm = inputOf(rest_ohm_, decoder_->input);
  Eigen::MatrixXd both(rest_ohm.size(), 2);
  both << rest_ohm, rest_ohm * (1 + relative);
  const Eigen::MatrixXd forces_N = (*predictor_)(both).forces_N;
  return forces_N.col(1) - forces_N.col(0);
}

void ForceDecoder::judge(const BoardFrame& frame, const Prediction& prediction, const Eigen::VectorXd& readings_ohm,
                         const PresentReadings& readings, DecodedForces& decoded) {
  PlausibilityInput input;
  input.readings_ohm = readings_ohm;
  if (!readings.missing.empty()) input.present = readings.present;
  input.forces_N = decoded.forces_N.reshaped();
  input.standardDeviation_N = decoded.standardDeviation_N.reshaped();
  if (prediction.chiSquare.size() > 0) input.chiSquare = prediction.chiSquare(0);
  if (prediction.likely_N.size() > 0) input.likely_N = prediction.likely_N.col(0);
  input.outsideInputs = prediction.outsideTrainingRange[0];
  input.predictedNoise = predictedNoise_;
  input.noiseUncertainty = meter_.uncertainty();
  // The noise of the mean of the tare's frames is in every frame since.
  if (meter_.ready()) input.noise = meter_.noise() * (tared_ ? std::sqrt(1 + 1.0 / tareFrames_) : 1.0);
  input.time_s = frame.time_s;
  const Plausibility::Verdict verdict = plausibility_->judge(input);
  decoded.outsideTrainingRange = verdict.outside;
  decoded.misfit = verdict.misfit;
  decoded.doubted = verdict.doubted;
  decoded.doubt = verdict.reason;
  if (!decoded.doubt.empty() || !(tared_ || meter_.ready())) return;
  const double deviation_N = withoutCalibration_N(decoded).maxCoeff();
  if (!(deviation_N > kDrowned * range_N())) return;
  decoded.doubted = true;
  decoded.doubt = decoded.missingReadings > 0
                      ? "without the missing readings the force is known to " + withDigits(deviation_N, 2) + " N only"
                      : "the noise of the readings alone gives " + withDigits(deviation_N, 2) +
                            " N with this network; train a network for this noise, on all row-wires";
}

/// A decoder that was trained with noise is drawn towards the middle of its range, most at rest, which lies at the
/// range's edge. How far is known there: it counts in full for a force that may be rest, and fades as the force leaves
/// it.
void ForceDecoder::addRestError(DecodedForces& decoded) const {
  const Eigen::Array3Xd off = (decoded.forces_N - restError_N_).array();
  const Eigen::Array3Xd away = (off != 0).select(off / (kRestReach * decoded.standardDeviation_N.array()), 0);
  const Eigen::RowVectorXd share = (1 + away.square().colwise().sum()).inverse();
  decoded.standardDeviation_N =
      (decoded.standardDeviation_N.array().square() + (restError_N_ * share.asDiagonal()).array().square()).sqrt();
}

/// The residual of a calibration is an error of an existing force: it hides none.
Eigen::Matrix3Xd ForceDecoder::withoutCalibration_N(const DecodedForces& decoded) const {
  const Eigen::Array3Xd all = decoded.standardDeviation_N.array().square() - calibrationError_N_.array().square();
  return all.max(0).sqrt();
}

/// An arrow appears where a component exceeds the noise, and disappears when all are below it again.
void ForceDecoder::threshold(DecodedForces& decoded) {
  const bool known = tared_ || meter_.ready(); // else the noise is unknown
  const Eigen::Matrix3Xd deviation_N = withoutCalibration_N(decoded);
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const Eigen::Array3d force = decoded.forces_N.col(column).array().abs();
    const auto says = measured_.col(column) && force > 0;
    const double size = says.select(force / deviation_N.col(column).array(), 0).maxCoeff();
    shown_[i] = decoded.valid && known && size > (shown_[i] ? kHideBelow : kShowAbove);
  }
  decoded.shown = shown_;
}

} // namespace palp
