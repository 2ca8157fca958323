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

/// Inputs x samples: the rows' displacements [mm] or resistances [ohm] out of a set. Throws Error where the set has
/// other sizes than the input needs.
Eigen::MatrixXd inputsOf(const SampleSet& samples, const DecoderInput& input);

/// What a decoder's stage makes of the inputs of a set: its transform and its memory of what was before, run by run.
/// Throws Error where a memory has no times, or rows out of order.
Eigen::MatrixXd stagedInputs(const Decoder& decoder, const SampleSet& samples, const Eigen::MatrixXd& inputs);

/// What presses, as far as the readings tell it: nothing that is seen above the noise, one touch as they were learned,
/// or neither of these: two together, another body.
enum class Pressing { None, One, Other };
const char* name(Pressing pressing); ///< none, one, other

/// Result of a decoder; one column per sample.
struct Prediction {
  Eigen::MatrixXd forces_N;
  Eigen::MatrixXd standardDeviation_N;    ///< of each force: training error and input noise; empty: not requested
  Eigen::MatrixXd places_mm;              ///< 2 x samples: of the touch; empty: the decoder gives none
  Eigen::MatrixXd placeDeviation_mm;      ///< of each position; empty: not requested
  Eigen::VectorXd indenterSize_mm;        ///< of the touch, estimated with it; empty: the decoder does not
  std::vector<bool> outsideTrainingRange; ///< some input lies outside what was trained
  Eigen::VectorXi area;                   ///< most likely touched area; empty: not determined
  Eigen::VectorXd areaConfidence;         ///< its probability
  /// Mean square of what the most likely touch leaves of the inputs, in their standard deviations (noise and model);
  /// empty without a forward model.
  Eigen::VectorXd chiSquare;
  std::vector<Pressing> pressing;   ///< empty: the decoder does not tell
  Eigen::MatrixXd likely_N;         ///< forces of that touch, where they are not the decoder's own
  double microsecondsPerSample = 0; ///< of the forces alone
  std::vector<std::string> warnings;
};

struct PredictOptions {
  double noise = 0; ///< relative noise of the inputs, for the standard deviation
  bool standardDeviation = true;
  bool area = true;
};

/// For many calls: keeps what a decoder and a noise share. The decoder must outlive it.
class Predictor {
public:
  explicit Predictor(const Decoder& decoder, const PredictOptions& options = {});
  /// Inputs x samples. Throws Error where the number of inputs differs.
  /// Of a decoder with a memory: for readings that have been held for long.
  [[nodiscard]] Prediction operator()(const Eigen::Ref<const Eigen::MatrixXd>& inputs) const;
  /// The same with what the decoder's stage makes of the inputs (stage inputs x samples).
  [[nodiscard]] Prediction operator()(const Eigen::Ref<const Eigen::MatrixXd>& inputs,
                                      const Eigen::Ref<const Eigen::MatrixXd>& staged) const;

private:
  const Decoder& decoder_;
  PredictOptions options_;
  std::optional<LikelihoodInversion> inversion_; ///< of the forces, or of the touched area alone
  std::shared_ptr<KernelForwardModel> touches_;  ///< with the noise of the options
  std::optional<KernelInversion> touchInversion_;
};

/// Forces from inputs (inputs x samples, as inputsOf gives them). Throws Error where the number of inputs differs.
Prediction predict(const Decoder& decoder, const Eigen::Ref<const Eigen::MatrixXd>& inputs,
                   const PredictOptions& options = {});
/// The same from a set; warns where the set is of another design.
Prediction predict(const Decoder& decoder, const SampleSet& samples, const PredictOptions& options = {});

/// What makes the samples another thing than the decoder was trained for: their design, touches in place of forces on
/// complete areas. Sentences for readers; empty if there is no difference.
std::vector<std::string> otherSamples(const Decoder& decoder, const SampleSet& samples);

/// Throws Error where the network's read-out and this one are both known and are not the same; `whatIs`: "the board
/// is".
void requireReadout(const Decoder& decoder, const std::optional<Readout>& readout, const std::string& whatIs);

/// Of the places of touches.
struct PlaceError {
  Eigen::Vector2d rms_mm = Eigen::Vector2d::Zero(); ///< along x and y
  double median_mm = 0;                             ///< of the distances
  std::optional<double> withinOneDeviation;         ///< share of the coordinates (0.68 expected)
};

/// Errors against the forces in the set, in % of the training range; where areas or places were determined, the share
/// of right areas, the errors of the places.
struct DecoderError {
  PredictionError error;
  std::optional<double> rightAreas;
  std::optional<PlaceError> place;
};
DecoderError decoderError(const Decoder& decoder, const Prediction& prediction, const SampleSet& samples);

} // namespace palp
