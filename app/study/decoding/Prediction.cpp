#include "app/study/decoding/Prediction.h"

#include "app/study/Median.h"
#include "app/study/decoding/CalibrationMark.h"
#include "app/study/decoding/ConstantInputs.h"
#include "app/study/decoding/PredictionParts.h"
#include "app/study/decoding/TwoStep.h"
#include "app/study/decoding/measured/MeasuredWords.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"

#include <chrono>
#include <cmath>

namespace palp {
namespace {

/// An input may lie this share of its training range, or this many standard deviations of noise, beyond the range.
constexpr double marginOfRange = 0.02;
constexpr double marginDeviations = 4;

/// Predictions of measured rows stay within the training range and so much of it on both sides.
constexpr double limitBeyondRange = 0.1;

Eigen::MatrixXd limited(const Decoder& decoder, Eigen::MatrixXd outputs) {
  const auto limit = [&outputs](Eigen::Index first, const Eigen::VectorXd& low, const Eigen::VectorXd& high) {
    const Eigen::VectorXd margin = limitBeyondRange * (high - low);
    for (auto column : outputs.middleRows(first, low.size()).colwise())
      column = column.cwiseMax(low - margin).cwiseMin(high + margin).eval();
  };
  limit(0, decoder.low_N, decoder.high_N);
  if (decoder.place) limit(decoder.outputs(), decoder.place->low_mm, decoder.place->high_mm);
  return outputs;
}

/// What the decoder's model reads, for readings that have been held for long.
Eigen::MatrixXd heldInputs(const Decoder& decoder, const Eigen::Ref<const Eigen::MatrixXd>& inputs) {
  return decoder.measured ? decoder.measured->stage.held(inputs) : Eigen::MatrixXd(inputs);
}

/// `inputs` are those of the model.
Eigen::MatrixXd forcesOf(const Decoder& decoder, const Eigen::Ref<const Eigen::MatrixXd>& inputs) {
  return std::visit(
      [&](const auto& model) -> Eigen::MatrixXd {
        using Model = std::decay_t<decltype(model)>;
        if constexpr (std::is_same_v<Model, TwoStep>)
          return predict(model, inputs);
        else if constexpr (std::is_same_v<Model, ForwardModel> || std::is_same_v<Model, KernelForwardModel>)
          return {};
        else
          return model.predict(inputs);
      },
      decoder.model);
}

/// dF/dx by central differences, for decoders that have no derivative of their own.
Eigen::MatrixXd differences(const Decoder& decoder, const Eigen::VectorXd& input) {
  const Eigen::Index n = input.size();
  const Eigen::VectorXd step = (1e-5 * (decoder.input.high - decoder.input.low)).cwiseMax(1e-9 * input.cwiseAbs());
  Eigen::MatrixXd shifted(n, 2 * n);
  for (Eigen::Index d = 0; d < n; ++d) {
    shifted.col(2 * d) = shifted.col(2 * d + 1) = input;
    shifted(d, 2 * d) += step(d);
    shifted(d, 2 * d + 1) -= step(d);
  }
  const Eigen::MatrixXd forces = forcesOf(decoder, shifted);
  Eigen::MatrixXd slope(forces.rows(), n);
  for (Eigen::Index d = 0; d < n; ++d)
    slope.col(d) = step(d) > 0 ? Eigen::VectorXd((forces.col(2 * d) - forces.col(2 * d + 1)) / (2 * step(d)))
                               : Eigen::VectorXd::Zero(forces.rows());
  return slope;
}

} // namespace

Eigen::MatrixXd slopeAt(const Decoder& decoder, const Eigen::VectorXd& input) {
  return std::visit(
      [&](const auto& model) -> Eigen::MatrixXd {
        if constexpr (requires { model.jacobian(input); }) {
          if (!decoder.measured) return model.jacobian(input);
          const InputStage& stage = decoder.measured->stage;
          return model.jacobian(stage.held(input).col(0)) * stage.slope(input);
        }
        return differences(decoder, input);
      },
      decoder.model);
}

namespace {

/// Noise of the inputs beyond what the decoder was trained with; its variance relative to the square of an input.
double furtherNoise(const Decoder& decoder, const PredictOptions& options) {
  return std::max(0.0, options.noise * options.noise - decoder.noise * decoder.noise);
}

} // namespace

double noiseBeyond(const Decoder& decoder, const PredictOptions& options) {
  const double counted = std::max(decoder.noise, leastTouchNoise);
  return furtherNoise(decoder, options) / (counted * counted);
}

ForwardModel withNoise(ForwardModel model, const Decoder& decoder, const PredictOptions& options) {
  const Eigen::ArrayXd size = (decoder.input.low.array().square() + decoder.input.high.array().square()) / 2;
  model.deviation = (model.deviation.array().square() + furtherNoise(decoder, options) * size).sqrt();
  return model;
}

KernelForwardModel withNoise(KernelForwardModel model, const Decoder& decoder, const PredictOptions& options) {
  model.deviation = (model.deviation.array().square() + noiseBeyond(decoder, options)).sqrt();
  return model;
}

namespace {

int areaOf(const Decoder& decoder, int classIndex) {
  return decoder.areaOfClass.empty() ? classIndex : decoder.areaOfClass[static_cast<std::size_t>(classIndex)];
}

void decodeByLikelihood(const Decoder& decoder, const ForwardModel& model, const LikelihoodInversion& inversion,
                        const Eigen::Ref<const Eigen::MatrixXd>& inputs, const PredictOptions& options,
                        Prediction& result) {
  result.forces_N.resize(decoder.outputs(), inputs.cols());
  result.chiSquare.resize(inputs.cols());
  if (options.standardDeviation) result.standardDeviation_N.resize(decoder.outputs(), inputs.cols());
  const bool withArea = options.area && model.classes() > 1;
  if (withArea) {
    result.area.resize(inputs.cols());
    result.areaConfidence.resize(inputs.cols());
  }
  for (Eigen::Index i = 0; i < inputs.cols(); ++i) {
    const LikelihoodEstimate estimate = inversion.estimate(inputs.col(i));
    result.forces_N.col(i) = estimate.parameters;
    result.chiSquare(i) = estimate.chiSquare;
    if (options.standardDeviation) result.standardDeviation_N.col(i) = estimate.standardDeviation;
    if (!withArea) continue;
    result.area(i) = areaOf(decoder, estimate.classIndex);
    result.areaConfidence(i) = estimate.confidence;
  }
}

} // namespace

void addAreas(const Decoder& decoder, const LikelihoodInversion& inversion,
              const Eigen::Ref<const Eigen::MatrixXd>& inputs, Prediction& result) {
  result.area.resize(inputs.cols());
  result.areaConfidence.resize(inputs.cols());
  result.chiSquare.resize(inputs.cols());
  result.likely_N.resize(decoder.outputs(), inputs.cols());
  for (Eigen::Index i = 0; i < inputs.cols(); ++i) {
    const LikelihoodEstimate estimate = inversion.estimate(inputs.col(i));
    result.chiSquare(i) = estimate.chiSquare;
    result.likely_N.col(i) = estimate.parameters;
    result.area(i) = areaOf(decoder, estimate.classIndex);
    result.areaConfidence(i) = estimate.confidence;
  }
}

namespace {

/// False where the decoder's model states no deviation of its own.
bool setOwnDeviation(const Decoder& decoder, const Eigen::Ref<const Eigen::MatrixXd>& inputs, Prediction& result) {
  return std::visit(
      [&](const auto& model) {
        constexpr bool kStates = requires {
          model.standardDeviation(inputs);
        };
        if constexpr (kStates) result.standardDeviation_N = model.standardDeviation(inputs);
        return kStates;
      },
      decoder.model);
}

/// The error found in training (of the touched area, where it is known) and the inputs' further noise through dF/dx;
/// never less than all their noise there, which training averaged over the range.
void addDeviations(const Decoder& decoder, const Eigen::Ref<const Eigen::MatrixXd>& inputs,
                   const PredictOptions& options, Prediction& result) {
  const double further = furtherNoise(decoder, options);
  if (decoder.measured) {
    result.standardDeviation_N = decoder.measured->deviation.at(result.forces_N);
  } else if (!setOwnDeviation(decoder, inputs, result)) {
    const Eigen::VectorXd all = decoder.residual_N.rowwise().squaredNorm() / decoder.residual_N.cols();
    result.standardDeviation_N.resize(decoder.answers(), inputs.cols());
    if (decoder.place) result.standardDeviation_N.bottomRows<2>().colwise() = decoder.place->residual_mm;
    for (Eigen::Index i = 0; i < inputs.cols(); ++i)
      result.standardDeviation_N.col(i).head(decoder.outputs()) =
          result.area.size() > 0 && result.area(i) < decoder.residual_N.cols()
              ? Eigen::VectorXd(decoder.residual_N.col(result.area(i)))
              : Eigen::VectorXd(all.cwiseSqrt());
  }
  if (options.noise == 0) return;
  for (Eigen::Index i = 0; i < inputs.cols(); ++i) {
    const Eigen::MatrixXd slope = slopeAt(decoder, inputs.col(i)) * inputs.col(i).asDiagonal();
    const Eigen::VectorXd square = slope.rowwise().squaredNorm();
    const Eigen::VectorXd found = result.standardDeviation_N.col(i).cwiseAbs2() + further * square;
    result.standardDeviation_N.col(i) = found.cwiseMax(options.noise * options.noise * square).cwiseSqrt();
  }
}

/// The 99th percentile of the mean of the squares of `count` normal numbers (Wilson and Hilferty 1931).
double commonMeanSquare(Eigen::Index count) {
  constexpr double quantile = 2.326;
  const double spread = 2 / (9 * static_cast<double>(count));
  return std::pow(1 - spread + quantile * std::sqrt(spread), 3);
}

} // namespace

void decodeTouches(const Decoder& decoder, const KernelForwardModel& model, const KernelInversion& inversion,
                   const FewerTouchReadings* fewer, const Eigen::Ref<const Eigen::MatrixXd>& inputs,
                   const PredictOptions& options, Prediction& result) {
  const double seen = (1 + noiseBeyond(decoder, options)) * commonMeanSquare(model.components());
  const Eigen::Index outputs = decoder.outputs() + 2;
  const bool sized = inversion.finds(outputs); // after force and position: size, friction
  if (sized) result.indenterSize_mm.resize(inputs.cols());
  result.forces_N.resize(outputs, inputs.cols());
  result.standardDeviation_N.resize(outputs, inputs.cols());
  result.chiSquare.resize(inputs.cols());
  for (Eigen::Index i = 0; i < inputs.cols(); ++i) {
    const KernelEstimate estimate =
        fewer != nullptr ? fewer->estimate(inversion, inputs.col(i)) : inversion.estimate(inputs.col(i));
    result.forces_N.col(i) = estimate.parameters.head(outputs);
    result.standardDeviation_N.col(i) = estimate.standardDeviation.head(outputs);
    result.chiSquare(i) = estimate.chiSquare;
    if (sized) result.indenterSize_mm(i) = estimate.parameters(outputs);
    if (model.residualLimit == 0) continue;
    result.pressing.push_back(estimate.change < seen                      ? Pressing::None
                              : estimate.chiSquare <= model.residualLimit ? Pressing::One
                                                                          : Pressing::Other);
  }
}

namespace {

/// What a calibration made of the answers and, as far as they are independent, of their deviations.
void correct(const OutputCorrection& correction, Prediction& result) {
  result.forces_N = ((correction.gains * result.forces_N).colwise() + correction.offset).eval();
  if (result.standardDeviation_N.size() > 0)
    result.standardDeviation_N =
        (correction.gains.cwiseAbs2() * result.standardDeviation_N.cwiseAbs2()).cwiseSqrt().eval();
}

/// The last two rows of what a model gives of a touch are its place.
void splitPlace(Eigen::MatrixXd& all, Eigen::MatrixXd& place) {
  if (all.size() == 0) return;
  place = all.bottomRows<2>();
  all.conservativeResize(all.rows() - 2, Eigen::NoChange);
}

/// Deviations with a further error, of each of their rows.
void widen(const Eigen::VectorXd& error, Eigen::MatrixXd& deviation) {
  if (deviation.size() == 0 || error.isZero(0)) return;
  deviation = (deviation.cwiseAbs2().colwise() + error.cwiseAbs2()).cwiseSqrt().eval();
}

} // namespace

void finish(const Decoder& decoder, Prediction& result) {
  if (decoder.correction) correct(*decoder.correction, result); // after limits: it leaves the range where a board does
  if (decoder.place) {
    splitPlace(result.forces_N, result.places_mm);
    splitPlace(result.standardDeviation_N, result.placeDeviation_mm);
  }
  widen(calibrationError_N(decoder), result.standardDeviation_N);
  const bool placesCalibrated = decoder.place && decoder.correction && !decoder.correction->offset.tail<2>().isZero(0);
  if (placesCalibrated) widen(decoder.place->residual_mm, result.placeDeviation_mm);
}

namespace {

/// Measured rows: by their distance from the training rows in their covariance.
std::vector<bool> outsideEllipse(const Decoder& decoder, const Eigen::Ref<const Eigen::MatrixXd>& staged) {
  std::vector<bool> flags;
  const Eigen::MatrixXd scaled = std::get<RbfNetwork>(decoder.model).scaler.apply(staged);
  for (const auto column : scaled.colwise())
    flags.push_back(decoder.measured->ellipse.distance(column) > decoder.measured->ellipse.limit);
  return flags;
}

std::vector<bool> outside(const Decoder& decoder, const Eigen::Ref<const Eigen::MatrixXd>& inputs, double noise) {
  const DecoderInput& input = decoder.input;
  const Eigen::ArrayXd size = input.low.array().abs().max(input.high.array().abs());
  const Eigen::ArrayXd margin = marginOfRange * (input.high - input.low).array() + 1e-12 * size +
                                marginDeviations * std::max(noise, decoder.noise) * size;
  std::vector<bool> flags;
  for (Eigen::Index i = 0; i < inputs.cols(); ++i) {
    const Eigen::ArrayXd x = inputs.col(i);
    flags.push_back(!((x >= input.low.array() - margin) && (x <= input.high.array() + margin)).all());
  }
  return flags;
}

void requireNumbers(const Decoder& decoder, const Eigen::Ref<const Eigen::MatrixXd>& inputs) {
  if (inputs.rows() != decoder.inputs())
    throw Error("inputs: " + std::to_string(inputs.rows()) + " values a sample; the decoder takes " +
                std::to_string(decoder.inputs()));
  if (!inputs.allFinite()) throw Error("inputs: a value is not finite; expected finite numbers");
}

} // namespace

const char* name(Pressing pressing) {
  return pressing == Pressing::None ? "none" : pressing == Pressing::One ? "one" : "other";
}

Eigen::MatrixXd inputsOf(const SampleSet& samples, const DecoderInput& input) {
  const bool displacement = input.kind == InputKind::Displacement;
  const Eigen::MatrixXd& all = displacement ? samples.displacements_mm : samples.resistances_ohm;
  const int valuesPerRow = displacement ? 3 * samples.electrodesPerRowWire : samples.columnWires;
  if (samples.rowWires != input.rowWires || valuesPerRow != input.valuesPerRow)
    throw Error("samples: " + std::to_string(samples.rowWires) + " row-wires with " + std::to_string(valuesPerRow) +
                " values each; the decoder takes " + std::to_string(input.rowWires) + " with " +
                std::to_string(input.valuesPerRow));
  if (all.rows() != static_cast<Eigen::Index>(samples.rowWires) * valuesPerRow)
    throw Error("samples: no " + name(input.kind) + "s in the file; the decoder reads them");
  Eigen::MatrixXd result(static_cast<Eigen::Index>(input.rows.size()) * valuesPerRow, samples.size());
  for (std::size_t r = 0; r < input.rows.size(); ++r)
    result.middleRows(static_cast<Eigen::Index>(r) * valuesPerRow, valuesPerRow) =
        all.middleRows(static_cast<Eigen::Index>(input.rows[r]) * valuesPerRow, valuesPerRow);
  return result;
}

Predictor::Predictor(const Decoder& decoder, const PredictOptions& options) : decoder_(decoder), options_(options) {
  if (!(options.noise >= 0 && options.noise < 1))
    throw Error("noise: " + gotExpected(options.noise, "", "0 up to below 1 (relative)"));
  if (const auto* touches = std::get_if<KernelForwardModel>(&decoder.model)) {
    touches_ = std::make_shared<KernelForwardModel>(withNoise(*touches, decoder, options));
    touchInversion_.emplace(*touches_);
  } else if (const auto* likelihood = std::get_if<ForwardModel>(&decoder.model))
    inversion_.emplace(withNoise(*likelihood, decoder, options));
  else if (options.area && decoder.areas)
    inversion_.emplace(withNoise(*decoder.areas, decoder, options));
}

Prediction Predictor::operator()(const Eigen::Ref<const Eigen::MatrixXd>& inputs) const {
  requireNumbers(decoder_, inputs);
  return (*this)(inputs, heldInputs(decoder_, inputs));
}

Prediction Predictor::operator()(const Eigen::Ref<const Eigen::MatrixXd>& inputs,
                                 const Eigen::Ref<const Eigen::MatrixXd>& staged) const {
  const Decoder& decoder = decoder_;
  const PredictOptions& options = options_;
  requireNumbers(decoder, inputs);
  Prediction result;
  result.outsideTrainingRange =
      decoder.measured ? outsideEllipse(decoder, staged) : outside(decoder, inputs, options.noise);
  if (options.noise > 1.5 * decoder.noise && !decoder.measured)
    result.warnings.push_back("noise of " + text(options.noise) +
                              " exceeds the noise that the decoder was trained for (" + text(decoder.noise) +
                              "): the decoder may amplify it; train with this noise");
  const auto* likelihood = std::get_if<ForwardModel>(&decoder.model);
  const auto start = std::chrono::steady_clock::now();
  if (likelihood)
    decodeByLikelihood(decoder, *likelihood, *inversion_, inputs, options, result);
  else if (touchInversion_)
    decodeTouches(decoder, *touches_, *touchInversion_, nullptr, inputs, options, result);
  else
    result.forces_N = forcesOf(decoder, staged);
  if (decoder.measured) result.forces_N = limited(decoder, std::move(result.forces_N));
  const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - start;
  result.microsecondsPerSample = inputs.cols() > 0 ? time.count() / static_cast<double>(inputs.cols()) : 0;
  if (likelihood) {
    finish(decoder, result);
    return result;
  }
  if (options.area && decoder.areas) addAreas(decoder, *inversion_, inputs, result);
  if (!options.standardDeviation)
    result.standardDeviation_N.resize(0, 0);
  else if (!touchInversion_)
    addDeviations(decoder, inputs, options, result);
  finish(decoder, result);
  return result;
}

Prediction predict(const Decoder& decoder, const Eigen::Ref<const Eigen::MatrixXd>& inputs,
                   const PredictOptions& options) {
  return Predictor(decoder, options)(inputs);
}

Prediction predict(const Decoder& decoder, const SampleSet& samples, const PredictOptions& options) {
  return predict(decoder, samples, inputsOf(samples, decoder.input), options);
}

Prediction predict(const Decoder& decoder, const SampleSet& samples, const Eigen::Ref<const Eigen::MatrixXd>& inputs,
                   const PredictOptions& options) {
  Prediction result = Predictor(decoder, options)(inputs, stagedInputs(decoder, samples, inputs));
  for (std::string& warning : otherSamples(decoder, samples)) result.warnings.push_back(std::move(warning));
  if (std::string warning = decoder.measured ? outsideWarning(result.outsideTrainingRange) : ""; !warning.empty())
    result.warnings.push_back(std::move(warning));
  return result;
}

Eigen::MatrixXd stagedInputs(const Decoder& decoder, const SampleSet& samples, const Eigen::MatrixXd& inputs) {
  if (!decoder.measured) return inputs;
  const InputStage& stage = decoder.measured->stage;
  if (stage.transform != ReadingTransform::None && inputs.size() > 0 && !(inputs.minCoeff() > 0))
    throw Error("readings: " +
                gotExpected(inputs.minCoeff(), "",
                            "above 0, as the network takes their " + kReadingTransforms.name(stage.transform)));
  const bool byTime = stage.hasMemory() && !stage.rowsAreClock;
  if (byTime && samples.times_s.rows() == 0 && samples.size() > 1)
    throw Error("the network has a memory and needs the time of each sample; the samples have no time");
  for (Eigen::Index i = 1; byTime && i < samples.size(); ++i)
    if (samples.times_s(0, i) < samples.times_s(0, i - 1) &&
        (samples.runs.rows() == 0 || samples.runs(0, i) == samples.runs(0, i - 1)))
      throw Error("samples: row " + std::to_string(i) +
                  " is earlier than the row before; the network has a memory and needs the rows in order of time");
  return stage.apply(inputs, samples.times_s, samples.runs);
}

std::vector<std::string> otherSamples(const Decoder& decoder, const SampleSet& samples) {
  std::vector<std::string> differences;
  if (samples.origin.designFingerprint != decoder.designFingerprint)
    differences.push_back("the samples are of another design (" + samples.origin.designFingerprint +
                          ") than the decoder (" + decoder.designFingerprint + "): its forces are meaningless there");
  if (samples.hasTouches() && decoder.touches.empty() && !decoder.place)
    differences.emplace_back("the decoder was trained on forces that are spread over complete areas, the samples are "
                             "touches by an indenter: its forces may be wrong by their own size; train on touches");
  if (!samples.hasPlaces() && !decoder.touches.empty())
    differences.push_back("the decoder was trained on touches (" + decoder.touches +
                          "), the samples load complete areas: its forces may be wrong by their own size");
  if (std::string constant = constantInputs(decoder.input, inputsOf(samples, decoder.input)); !constant.empty())
    differences.push_back(std::move(constant));
  return differences;
}

void requireReadout(const Decoder& decoder, const std::optional<Readout>& readout, const std::string& whatIs) {
  if (!decoder.readout || !readout || *decoder.readout == *readout) return;
  throw Error("the network was trained for read-out " + kReadouts.name(*decoder.readout) + ", " + whatIs +
              " of read-out " + kReadouts.name(*readout) + "; train a network for this read-out");
}

namespace {

PlaceError placeError(const Prediction& prediction, const SampleSet& samples) {
  const Eigen::Matrix2Xd off = prediction.places_mm - samples.touchedPlaces_mm();
  PlaceError error;
  error.rms_mm = off.array().square().rowwise().mean().sqrt();
  std::vector<double> distances;
  for (Eigen::Index i = 0; i < off.cols(); ++i) distances.push_back(off.col(i).norm());
  error.median_mm = median(std::move(distances));
  if (prediction.placeDeviation_mm.cols() == off.cols())
    error.withinOneDeviation =
        static_cast<double>((off.array().abs() <= prediction.placeDeviation_mm.array()).count()) /
        static_cast<double>(off.size());
  return error;
}

} // namespace

DecoderError decoderError(const Decoder& decoder, const Prediction& prediction, const SampleSet& samples) {
  if (samples.forces_N.rows() != decoder.outputs())
    throw Error("forces per sample: " + gotExpected(std::to_string(samples.forces_N.rows()),
                                                    std::to_string(decoder.outputs()) + ", as the decoder gives"));
  DecoderError result;
  result.error = predictionError(prediction.forces_N, samples.forces_N, decoder.high_N - decoder.low_N);
  if (prediction.area.size() == samples.area.size() && samples.area.size() > 0)
    result.rightAreas = static_cast<double>((prediction.area.array() == samples.area.array()).count()) /
                        static_cast<double>(samples.area.size());
  if (prediction.places_mm.cols() > 0 && samples.hasPlaces()) result.place = placeError(prediction, samples);
  return result;
}

} // namespace palp
