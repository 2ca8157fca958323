#pragma once

#include "app/study/decoding/TrainOptions.h"
#include "io/Decoder.h"
#include "model/SampleSet.h"
#include "model/SensorDesign.h"
#include "nn/RelativeError.h"

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>

namespace palp {

/// Returns a decoder's inputs from a set, inputs x samples: displacements [mm] or resistances [ohm] of its row-wires.
/// Throws Error if the sizes of the set do not match.
Eigen::MatrixXd inputsOf(const SampleSet& samples, const DecoderInput& input);

/// Applies the decoder's input stage (transform and memory) to the inputs of a set, run by run. Throws Error if a
/// memory has no times, or if rows are out of order.
Eigen::MatrixXd stagedInputs(const Decoder& decoder, const SampleSet& samples, const Eigen::MatrixXd& inputs);

/// What the readings indicate: no touch above the noise, one touch of the trained kind, or something else (two touches
/// together, another body).
enum class Pressing { None, One, Other };
const char* name(Pressing pressing); ///< none, one, other

/// Result of a decoder; one column per sample.
struct Prediction {
  Eigen::MatrixXd forces_N;
  Eigen::MatrixXd standardDeviation_N;    ///< of each force: training error and input noise; empty: not requested
  Eigen::MatrixXd places_mm;              ///< 2 x samples: position of the touch; empty: not determined
  Eigen::MatrixXd placeDeviation_mm;      ///< of each position; empty: not requested
  Eigen::VectorXd indenterSize_mm;        ///< estimated with the touch; empty: not determined
  std::vector<bool> outsideTrainingRange; ///< whether some input lies outside its training range
  Eigen::VectorXi area;                   ///< most likely touched area; empty: not determined
  Eigen::VectorXd areaConfidence;         ///< its probability
  /// Mean square of the residuals of the inputs after the most likely touch, in units of their standard deviations
  /// (noise and model); empty without a forward model.
  Eigen::VectorXd chiSquare;
  std::vector<Pressing> pressing;   ///< empty: not determined
  Eigen::MatrixXd likely_N;         ///< forces of the most likely touch, if they differ from the decoder's own
  double microsecondsPerSample = 0; ///< of the forces alone
  std::vector<std::string> warnings;
};

struct PredictOptions {
  double noise = 0; ///< relative noise of the inputs, for the standard deviation
  bool standardDeviation = true;
  bool area = true;
};

/// Predicts for many calls: keeps what depends on decoder and noise only. The decoder must outlive it.
class Predictor {
public:
  explicit Predictor(const Decoder& decoder, const PredictOptions& options = {});
  /// Predicts from inputs x samples. Throws Error if the number of inputs differs.
  /// For a decoder with a memory, each sample is taken as held for a long time.
  [[nodiscard]] Prediction operator()(const Eigen::Ref<const Eigen::MatrixXd>& inputs) const;
  /// The same, with the outputs of the decoder's input stage for these inputs (stage inputs x samples).
  [[nodiscard]] Prediction operator()(const Eigen::Ref<const Eigen::MatrixXd>& inputs,
                                      const Eigen::Ref<const Eigen::MatrixXd>& staged) const;

private:
  const Decoder& decoder_;
  PredictOptions options_;
  std::optional<LikelihoodInversion> inversion_; ///< for the forces, or for the touched area only
  std::shared_ptr<KernelForwardModel> touches_;  ///< with the noise of the options
  std::optional<KernelInversion> touchInversion_;
};

/// Predicts forces from inputs (inputs x samples, as inputsOf returns them). Throws Error if the number of inputs
/// differs.
Prediction predict(const Decoder& decoder, const Eigen::Ref<const Eigen::MatrixXd>& inputs,
                   const PredictOptions& options = {});
/// The same from a set, with its times and runs for a memory; the result has a warning if the set belongs to another
/// design.
Prediction predict(const Decoder& decoder, const SampleSet& samples, const PredictOptions& options = {});
/// The same from these inputs of the set (inputs x samples), as where noise was added to them.
Prediction predict(const Decoder& decoder, const SampleSet& samples, const Eigen::Ref<const Eigen::MatrixXd>& inputs,
                   const PredictOptions& options);

/// Returns how the samples differ from those the decoder was trained for (another design, touches instead of forces on
/// complete areas), one sentence each; empty if they do not.
std::vector<std::string> otherSamples(const Decoder& decoder, const SampleSet& samples);

/// Throws Error if the network's read-out and this one are both known and differ. `whatIs` begins the clause about this
/// one in the message: "the board is".
void requireReadout(const Decoder& decoder, const std::optional<Readout>& readout, const std::string& whatIs);

/// Errors of the decoded positions of touches.
struct PlaceError {
  Eigen::Vector2d rms_mm = Eigen::Vector2d::Zero(); ///< along x and y
  double median_mm = 0;                             ///< median distance from the true position
  std::optional<double> withinOneDeviation;         ///< share of the coordinates (0.68 expected)
};

/// Errors against the forces in the set, in % of the training range; if areas or positions were determined, also the
/// share of correct areas and the errors of the positions.
struct DecoderError {
  PredictionError error;
  std::optional<double> rightAreas;
  std::optional<PlaceError> place;
};
DecoderError decoderError(const Decoder& decoder, const Prediction& prediction, const SampleSet& samples);

} // namespace palp
