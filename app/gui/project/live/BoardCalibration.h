#pragma once

#include "io/Decoder.h"
#include "model/SampleSet.h"

#include <string>

namespace palp {

/// Labelled frames of a board, each the mean of some frames under a known load.
struct BoardFrames {
  SampleSet samples;
  Eigen::Matrix3Xd read_N; ///< what the network in use gave for each frame; NaN: not known
};

/// A network that was refined with labelled frames and decodes in place of the one that was chosen.
struct CalibratedNetwork {
  Decoder decoder;
  std::string name; ///< as the Live scene shows it
};

} // namespace palp
