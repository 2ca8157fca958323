#include "app/study/decoding/CalibrationMark.h"

#include <charconv>

namespace palp {

namespace {

constexpr const char* kMark = "  # calibrated with ";
constexpr const char* kAfter = " labelled frames";

} // namespace

std::string withCalibrationMark(const std::string& trainedWith, Eigen::Index frames) {
  return trainedWith.substr(0, trainedWith.find(kMark)) + kMark + std::to_string(frames) + kAfter;
}

Eigen::Index calibrationFrames(const Decoder& decoder) {
  const std::string& text = decoder.trainedWith;
  const std::size_t mark = text.find(kMark);
  if (mark == std::string::npos) return 0;
  Eigen::Index frames = 0;
  const char* const first = text.data() + mark + std::string(kMark).size();
  std::from_chars(first, text.data() + text.size(), frames);
  return frames;
}

bool calibrated(const Decoder& decoder) {
  return decoder.correction.has_value() || calibrationFrames(decoder) > 0;
}

Eigen::VectorXd calibrationError_N(const Decoder& decoder) {
  const bool apart = std::holds_alternative<ForwardModel>(decoder.model) || keepsCorrection(decoder);
  if (!apart || !calibrated(decoder)) return Eigen::VectorXd::Zero(decoder.outputs());
  return decoder.residual_N.col(0);
}

} // namespace palp
