#include "app/study/live/trust/DeviationNote.h"

#include "app/study/decoding/CalibrationMark.h"
#include "model/base/NumberText.h"

namespace palp {

namespace {

std::string calibrationSentence(const Decoder& decoder) {
  const Eigen::Index count = calibrationFrames(decoder);
  const std::string frames = count > 0 ? " with " + std::to_string(count) + " frames" : "";
  std::string left;
  const Eigen::VectorXd error_N = decoder.residual_N.col(0);
  if (error_N.size() == 3)
    left = ", which left (" + withDigits(error_N(0), 1) + ", " + withDigits(error_N(1), 1) + ", " +
           withDigits(error_N(2), 1) + ") N";
  return "the network is calibrated" + frames + left;
}

} // namespace

DeviationNote deviationNote(const Decoder& decoder, const DecodedSensor& sensor) {
  const bool known = !sensor.designFingerprint.empty() && !decoder.designFingerprint.empty();
  if (known && sensor.designFingerprint != decoder.designFingerprint)
    return {true, "another design", "the network was trained for another design: its error is unknown"};
  if (sensor.pressedByIndenter && decoder.touches.empty() && !decoder.place)
    return {true, "other touches",
            "the network was trained on forces over complete areas, an indenter presses here: its error is unknown"};
  if (calibrated(decoder)) return {false, {}, calibrationSentence(decoder)};
  if (sensor.simulated) return {};
  return {false, "uncalibrated", "the network is not calibrated: the deviation includes noise and training error only"};
}

} // namespace palp
