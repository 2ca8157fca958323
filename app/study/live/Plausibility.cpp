#include "app/study/live/Plausibility.h"

#include "model/base/NumberText.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr double kQuantile99 = 2.326; // of a normal distribution
constexpr double kParameters = 3;     // forces that are fitted to the readings
constexpr double kMarginOfRange = 0.02;
constexpr double kMarginDeviations = 4;
constexpr double kDisagreement = 0.05;  // of the range, at least
constexpr double kDoubtMemory_s = 0.25; // of what is reported
constexpr double kSayAbove = 0.5, kUnsayBelow = 0.1;
constexpr double kLongestStep_s = 1;
constexpr double kOtherBoard = 100; // times the limit: no touch, hysteresis or warming of this sensor does that

Eigen::Index readingsIn(const PlausibilityInput& input) {
  return input.present.empty() ? input.readings_ohm.size() : static_cast<Eigen::Index>(input.present.size());
}

} // namespace

Plausibility::Plausibility(const Decoder& decoder)
    : low_N_(decoder.low_N), range_N_(decoder.high_N - decoder.low_N), trainedNoise_(decoder.noise) {
  if (const auto* touches = std::get_if<KernelForwardModel>(&decoder.model)) {
    if (touches->residualLimit == 0) return;
    leftByOne_ = touches->residualLimit;
    modelVariance_ = (touches->deviation.array().square() - (trainedNoise_ > 0 ? 1 : 0)).cwiseMax(0.0);
    const double unit = std::max(trainedNoise_, leastTouchNoise);
    noiseSquare_ = Eigen::VectorXd::Constant(modelVariance_.size(), 1 / (unit * unit));
    return;
  }
  const ForwardModel* model = decoder.areas ? &*decoder.areas : std::get_if<ForwardModel>(&decoder.model);
  if (model == nullptr) return;
  noiseSquare_ = (decoder.input.low.cwiseAbs2() + decoder.input.high.cwiseAbs2()) / 2;
  // What training added for the noise is taken out again: this board's is put in its place.
  modelVariance_ =
      (model->deviation.array().square() - trainedNoise_ * trainedNoise_ * noiseSquare_.array()).cwiseMax(0.0);
}

void Plausibility::restart() {
  share_ = 0;
  held_ = false;
}

double Plausibility::limit(Eigen::Index readings, double noiseUncertainty) {
  const double freedom = std::max(1.0, static_cast<double>(readings) - kParameters);
  const double variance = 2 / (9 * freedom) + 4 * noiseUncertainty * noiseUncertainty / 9;
  const double cubeRoot = 1 - 2 / (9 * freedom) + kQuantile99 * std::sqrt(variance);
  return std::pow(cubeRoot, 1.5); // of the rms: the square root of the third power
}

std::optional<double> Plausibility::misfit(const PlausibilityInput& input) const {
  if (!input.chiSquare || modelVariance_.size() == 0 || input.noise <= 0) return {};
  const double counted2 = std::max(input.predictedNoise * input.predictedNoise, trainedNoise_ * trainedNoise_);
  const Eigen::ArrayXd counted = modelVariance_.array() + counted2 * noiseSquare_.array();
  if (leftByOne_ > 0) {
    const Eigen::ArrayXd expected = modelVariance_.array() + input.noise * input.noise * noiseSquare_.array();
    return std::sqrt(*input.chiSquare / (expected / counted).mean());
  }
  if (modelVariance_.size() != input.readings_ohm.size()) return {};
  const Eigen::ArrayXd expected =
      modelVariance_.array() + input.noise * input.noise * input.readings_ohm.array().square();
  const Eigen::ArrayXd ratio = expected / counted;
  const auto readings = static_cast<double>(readingsIn(input));
  const double fitted = std::max(1.0, readings - kParameters) / readings;
  return std::sqrt(*input.chiSquare / (fitted * (input.present.empty() ? ratio.mean() : ratio(input.present).mean())));
}

double Plausibility::limitFor(const PlausibilityInput& input) const {
  if (leftByOne_ == 0) return limit(readingsIn(input), input.noiseUncertainty);
  return std::sqrt(leftByOne_) * (1 + kQuantile99 * input.noiseUncertainty);
}

Plausibility::Verdict Plausibility::judge(const PlausibilityInput& input) {
  Verdict verdict;
  verdict.misfit = misfit(input);
  Doubt doubt = Doubt::None;
  const Eigen::ArrayXd sd = input.standardDeviation_N;
  if (modelVariance_.size() == 0) {
    verdict.outside = input.outsideInputs;
  } else {
    const Eigen::ArrayXd margin = kMarginOfRange * range_N_.array() + kMarginDeviations * sd;
    const Eigen::ArrayXd above = input.forces_N.array() - low_N_.array();
    verdict.outside = !((above >= -margin) && (above <= range_N_.array() + margin)).all();
  }
  if (verdict.outside) doubt = Doubt::Outside;
  if (input.likely_N && input.likely_N->size() == input.forces_N.size()) {
    const Eigen::ArrayXd apart = (input.forces_N - *input.likely_N).array().abs();
    if ((apart > (kMarginDeviations * sd).max(kDisagreement * range_N_.array())).any()) doubt = Doubt::Disagrees;
  }
  if (verdict.misfit && *verdict.misfit > limitFor(input)) doubt = Doubt::Foreign;
  verdict.doubted = doubt != Doubt::None;
  follow(doubt, input.time_s);
  if (!held_) return verdict;
  if (verdict.outside) heldOutside_ = outsideWords(input);
  if (heldDoubt_ == Doubt::Outside) verdict.reason = "outside the network's training range" + heldOutside_;
  if (heldDoubt_ == Doubt::Disagrees) verdict.reason = "the network's force disagrees with the readings";
  if (heldDoubt_ == Doubt::Foreign) {
    if (verdict.misfit) heldMisfit_ = *verdict.misfit;
    const double most = limitFor(input);
    verdict.reason = std::string("no ") + (leftByOne_ > 0 ? "single " : "") + "known touch: misfit " +
                     withDigits(heldMisfit_, 2) + ", at most " + withDigits(most, 2);
    if (heldMisfit_ > kOtherBoard * most)
      verdict.reason += "; the network is of another design than the board, or the board is to be tared";
  }
  return verdict;
}

/// ": Fx 2 N, trained for -1 to 1 N", of the component that lies farthest outside; empty where readings are judged.
std::string Plausibility::outsideWords(const PlausibilityInput& input) const {
  if (modelVariance_.size() == 0 || input.forces_N.size() != low_N_.size()) return {};
  const Eigen::ArrayXd above = input.forces_N.array() - low_N_.array();
  Eigen::Index worst = 0;
  (-above).max(above - range_N_.array()).maxCoeff(&worst);
  const std::string area = input.forces_N.size() > 3 ? " on area " + std::to_string(worst / 3) : "";
  return std::string(": F") + "xyz"[worst % 3] + area + " is " + withDigits(input.forces_N(worst), 2) +
         " N, trained for " + withDigits(low_N_(worst), 2) + " to " + withDigits(low_N_(worst) + range_N_(worst), 2) +
         " N";
}

/// Doubts in more than half of the last quarter of a second are reported, until they are fewer than a tenth.
void Plausibility::follow(Doubt doubt, double time_s) {
  const double step_s = std::clamp(time_s - last_s_, 0.0, kLongestStep_s);
  last_s_ = time_s;
  share_ += ((doubt == Doubt::None ? 0.0 : 1.0) - share_) * (1 - std::exp(-step_s / kDoubtMemory_s));
  if (share_ > kSayAbove) held_ = true;
  if (share_ < kUnsayBelow) held_ = false;
  if (doubt != Doubt::None) heldDoubt_ = doubt;
}

} // namespace palp
