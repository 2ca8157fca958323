#pragma once

#include "io/Decoder.h"
#include "model/SampleSet.h"
#include "model/SensorDesign.h"
#include "nn/inversion/KernelInversion.h"
#include "solver/SensorMesh.h"

#include <functional>
#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// Readings [ohm] of touches as the design's influence surfaces at rest have them (TouchMap documents what that leaves
/// out): what is known of a decoder's inputs before any sample. Columns are touches: Fx, Fy, Fz [N], x, y, size [mm],
/// friction. Shape and rim are those of the samples. Throws DesignError where the shape has no place along x and y or
/// the design a pressure law, Error where the samples are of another design, and Cancelled.
/// `progress` is called before each step with the share of the time that has passed and the step's name.
using KnownReadings = std::function<Eigen::MatrixXd(const Eigen::MatrixXd& parameters)>;
KnownReadings knownReadings(const SensorDesign& design, const SampleSet& samples, const DecoderInput& input,
                            int threads, const std::stop_token& stop,
                            const std::function<void(double share, const std::string& what)>& progress = {});

/// The mesh of the block that they take.
MeshOptions meshOfKnownTouches(const SensorDesign& design, Eigen::Index samples);

/// Mirrors that the design has and these touches (causes as above, a column each) can be reflected by: not where the
/// decoder reads a row-wire without its image, or a force or place that never varies would become another.
std::vector<KernelMirror> mirrorsOfTouches(const SensorDesign& design, const Eigen::MatrixXd& parameters,
                                           const DecoderInput& input);

/// The least force that counts as a press: a share of the design's range, which is 1e-6 N of the paper's.
double leastPress_N(const ForceRange& range);

} // namespace palp
