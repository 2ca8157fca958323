#include "app/study/live/trust/DeviationNote.h"

#include "app/study/decoding/CalibrationMark.h"

#include <array>
#include <cstdio>

namespace palp {

namespace {

std::string calibrationSentence(const Decoder& decoder) {
  const Eigen::Index count = calibrationFrames(decoder);
  const std::string frames = count > 0 ? " with " + std::to_string(count) + " frames" : "";
  std::array<char, 96> left{};
  const Eigen::VectorXd error_N = decoder.residual_N.col(0);
  if (error_N.size() == 3)
    std::snprintf(left.data(), left.size(), ", which left (%.1g, %.1g, %.1g) N", error_N(0), error_N(1), error_N(2));
  return "the network is calibrated" + frames + left.data();
}

} // namespace

DeviationNote deviationNote(const Decoder& decoder, const DecodedSensor& sensor) {
  const bool known = !sensor.designFingerprint.empty() && !decoder.designFingerprint.empty();
  if (known && sensor.designFingerprint != decoder.designFingerprint)
    return {true, "another design", "the network was trained for another design: its error is not known"};
  if (sensor.pressedByIndenter && decoder.touches.empty() && !decoder.place)
    return {true, "other touches",
            "the network was trained on forces over whole areas, an indenter presses here: its error is not known"};
  if (calibrated(decoder)) return {false, {}, calibrationSentence(decoder)};
  if (sensor.simulated) return {};
  return {false, "uncalibrated", "the network is not calibrated: the deviation holds noise and training error only"};
}

} // namespace palp
