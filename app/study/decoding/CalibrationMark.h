#pragma once

#include "io/Decoder.h"

#include <string>

namespace palp {

/// Notes in Decoder::trainedWith that labelled frames of a board refined a network: its command as before, and after it
/// as a comment of the shell their number; a note of an earlier calibration is replaced.
std::string withCalibrationMark(const std::string& trainedWith, Eigen::Index frames);
/// The number of frames that is noted; 0: none, or a network calibrated before 1.0.0.
Eigen::Index calibrationFrames(const Decoder& decoder);
/// Whether labelled frames of a board have refined it.
bool calibrated(const Decoder& decoder);
/// What a calibration left of each force of a decoder by inversion or of measured rows (rms on frames that it had not
/// seen), which its deviations hold together with noise and model; those of other decoders hold it in the error of
/// their training. Zero where it was not calibrated.
Eigen::VectorXd calibrationError_N(const Decoder& decoder);

} // namespace palp
