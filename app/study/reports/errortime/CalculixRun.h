#pragma once

#include "model/LoadCase.h"
#include "model/Mesh.h"
#include "model/SensorDesign.h"

#include <Eigen/Core>

#include <optional>
#include <stop_token>
#include <string>

namespace palp {

/// One run of CalculiX (`ccx`) on the same mesh, material and load.
struct CalculixRun {
  Eigen::Matrix3Xd displacements_mm;         ///< 3 x nodes, with the six digits that its result file has
  std::optional<Eigen::Vector3d> reaction_N; ///< of the clamped face, where the deck asks for it (indenters)
  double seconds = 0;                        ///< wall time of the program, reading and writing its files
  double peak_MB = 0;                        ///< most memory that it held
  std::string failed;                        ///< why there is no result; empty where there is one
};

/// Where `ccx` is, or nothing.
std::optional<std::string> calculixProgram();

/// Writes the deck into a folder of its own in the system's place for temporary files, runs and reads the result. Ended
/// after `limit_s` and on a stop request.
CalculixRun runCalculix(const std::string& program, const SensorDesign& design, const Mesh& mesh, const LoadCase& load,
                        int threads, double limit_s, const std::stop_token& stop);

/// Displacements of the upper electrodes of a run that has not failed, by the elements' shape functions.
Eigen::Matrix3Xd upperElectrodes_mm(const CalculixRun& run, const SensorDesign& design, const Mesh& mesh);

/// The last "total force" of the clamped face in the text of a .dat file, if there is one.
std::optional<Eigen::Vector3d> datReaction_N(const std::string& dat);

/// Displacements of the nodes out of the text of a .frd file; empty where it has none.
Eigen::Matrix3Xd frdDisplacements(const std::string& frd, int nodes);

} // namespace palp
