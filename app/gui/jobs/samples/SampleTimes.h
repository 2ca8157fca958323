#pragma once

#include "app/gui/project/SampleSettings.h"
#include "solver/SensorMesh.h"

#include <optional>

namespace palp {

/// How long making samples takes, training and test together, before it begins.
struct SampleTime {
  double seconds = 0;
  bool measuredHere = false; ///< by samples of this kind that were made on this machine
};

/// By what samples of the kind (forces on areas, by a surrogate, touches with or without friction; law, mesh) took here
/// last, else by what they take on the machine that Palp was measured on, as much longer or shorter as the last ones
/// here took. None for a mesh that was never met.
std::optional<SampleTime> sampleTime(const SampleSettings& samples, const SensorDesign& design,
                                     const MeshOptions& mesh);

/// Of samples that were made without a stop.
void rememberSampleTime(const SampleSettings& samples, const SensorDesign& design, const MeshOptions& mesh,
                        double seconds);

} // namespace palp
