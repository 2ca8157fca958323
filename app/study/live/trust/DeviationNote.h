#pragma once

#include "io/Decoder.h"

#include <string>

namespace palp {

/// What is known of the sensor whose readings a network decodes.
struct DecodedSensor {
  std::string designFingerprint; ///< empty: not known
  bool simulated = false;        ///< by a model of that design: there is nothing to calibrate
  bool pressedByIndenter = false;
};

/// What the deviations of decoded forces hold of the sensor's own error.
struct DeviationNote {
  bool wrong = false;   ///< the network is not for this sensor: its error is not known at all
  std::string brief;    ///< "uncalibrated"; empty where the deviations hold all that is known
  std::string sentence; ///< empty where there is nothing to say
};

/// Notes that the network is of another design or of other touches, that it was not calibrated on a board, or what its
/// calibration left.
DeviationNote deviationNote(const Decoder& decoder, const DecodedSensor& sensor);

} // namespace palp
