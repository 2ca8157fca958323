#include "app/study/decoding/PartialPredictor.h"

#include "app/study/decoding/PredictionParts.h"

#include <algorithm>

namespace palp {

namespace {

constexpr std::size_t kMostWays = 32; // that are kept: broken wires and lost reports leave few

/// The maximum likelihood decoder of these readings alone.
std::unique_ptr<const Decoder> ofReadings(const Decoder& decoder, const std::vector<Eigen::Index>& kept) {
  auto fewer = std::make_unique<Decoder>(decoder);
  fewer->model = ofMeasurements(std::get<ForwardModel>(decoder.model), kept);
  fewer->input.low = decoder.input.low(kept).eval();
  fewer->input.high = decoder.input.high(kept).eval();
  return fewer;
}

/// The error of readings that were filled in through dF/dx.
void addFilled(const Eigen::MatrixXd& slope, const Eigen::MatrixXd& scatter, Eigen::MatrixXd& deviation) {
  const Eigen::VectorXd square = (slope * scatter).rowwise().squaredNorm();
  deviation = (deviation.cwiseAbs2() + square).cwiseSqrt().eval();
}

} // namespace

/// What decodes without the same readings, by the kind of decoder: one of the three.
struct PartialPredictor::Way {
  std::unique_ptr<const Decoder> fewer;
  std::optional<Predictor> predictor;
  std::optional<FewerTouchReadings> touches;
  std::optional<LikelihoodInversion> areas;
};

PartialPredictor::PartialPredictor(const Decoder& decoder, const PredictOptions& options)
    : decoder_(decoder), options_(options) {
  if (const auto* touches = std::get_if<KernelForwardModel>(&decoder.model)) {
    touches_ = withNoise(*touches, decoder, options);
    touchInversion_.emplace(*touches_);
  } else if (decoder.areas) {
    areas_ = withNoise(*decoder.areas, decoder, options);
    whole_.emplace(decoder, options);
  }
}

PartialPredictor::~PartialPredictor() = default;

PartialPredictor::Way& PartialPredictor::wayFor(const PresentReadings& readings) {
  if (const auto known = ways_.find(readings.missing); known != ways_.end()) return known->second;
  if (ways_.size() >= kMostWays) ways_.clear();
  Way& way = ways_[readings.missing];
  if (touches_) {
    const double noise = noiseBeyond(decoder_, options_) + (decoder_.noise > 0 ? 1 : 0);
    way.touches.emplace(*touches_, noise, std::max(decoder_.noise, leastTouchNoise), readings);
  } else if (areas_) {
    way.areas.emplace(ofMeasurements(*areas_, readings.present));
  } else {
    way.fewer = ofReadings(decoder_, readings.present);
    way.predictor.emplace(*way.fewer, options_);
  }
  return way;
}

Prediction PartialPredictor::operator()(const Eigen::Ref<const Eigen::VectorXd>& input,
                                        const PresentReadings& readings) {
  return decode(wayFor(readings), input, readings);
}

Prediction PartialPredictor::decode(const Way& way, const Eigen::Ref<const Eigen::VectorXd>& input,
                                    const PresentReadings& readings) const {
  const Eigen::VectorXd present = input(readings.present);
  if (way.predictor) return (*way.predictor)(present);
  Prediction result;
  if (way.touches) {
    result.outsideTrainingRange = {false}; // the force is judged, not the readings
    decodeTouches(decoder_, *touches_, *touchInversion_, &*way.touches, input, options_, result);
    finish(decoder_, result);
    return result;
  }
  const ImputedReadings filled = imputed(*areas_, way.areas->estimate(present), readings);
  Eigen::VectorXd all = input;
  all(readings.missing) = filled.values;
  result = (*whole_)(all);
  const Eigen::MatrixXd slope = slopeAt(decoder_, all)(Eigen::all, readings.missing);
  if (result.placeDeviation_mm.size() == 0 && result.standardDeviation_N.size() > 0)
    addFilled(slope, filled.scatter, result.standardDeviation_N);
  addAreas(decoder_, *way.areas, present, result); // by the readings that came alone
  return result;
}

} // namespace palp
