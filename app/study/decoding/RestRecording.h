#pragma once

#include "io/board/Protocol.h"

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

namespace palp {

/// A board at rest: the mean of all complete frames of a recording.
struct RestRecording {
  BoardInfo info;
  Eigen::MatrixXd resistances_ohm; ///< row-wires x column-wires; NaN where there is no good reading
  double noise = 0;                ///< of the mean, relative, rms over the readings
  int frames = 0;
  std::vector<std::string> faults; ///< of the wires, as text
};

/// Throws Error where the file is not a recording, has fewer than 10 complete frames, is of several boards, or where
/// the sensor was not at rest: its frames scatter more than neighbours in time do.
RestRecording readRest(const std::filesystem::path& recording);

} // namespace palp
