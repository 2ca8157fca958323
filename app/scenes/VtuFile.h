#pragma once

#include "model/Mesh.h"
#include "model/Solution.h"

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// One named result for the file, at the nodes; units in the name.
struct NodalArray {
  std::string name;
  Eigen::MatrixXd values; ///< components x nodes
};

/// The solution's fields under the names of the file: displacement_mm, cauchy_MPa (xx, yy, zz, xy, yz, xz),
/// pressure_MPa, von_mises_MPa, volume_ratio.
std::vector<NodalArray> nodalArrays(const NodalFields& fields);

/// The mesh at rest and what is known at its nodes as the text of a VTU file. Throws Cancelled where it is stopped.
std::string vtuText(const Mesh& mesh, const std::vector<NodalArray>& arrays, const std::stop_token& stop = {});

/// Writes the mesh at rest and its nodal values as VTU (ParaView, meshio), to a temporary file that is renamed.
/// Throws Error where the file cannot be written.
void writeVtu(const std::filesystem::path& path, const Mesh& mesh, const std::vector<NodalArray>& arrays = {});

} // namespace palp
