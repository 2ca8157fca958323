#include "solver/IndependentResidual.h"

#include "solver/assembly/SurfaceTraction.h"
#include "solver/element/ElementGeometry.h"
#include "solver/element/RubberStress.h"

#include <Eigen/Dense>

#include <cassert>
#include <cmath>

namespace palp {

double independentResidual(const SensorDesign& design, const Mesh& mesh, const LoadCase& load,
                           const Solution& solution) {
  assert(mesh.shape == ElementShape::Hexahedron8 && "written for mapped meshes");
  const LoadIncrement& state = solution.state();
  const Eigen::VectorXd external = solution.reachedLoadFraction * nodalForces(mesh, design, load);
  Eigen::VectorXd imbalance = -external;
  double volume = 0;
  for (int e = 0; e < mesh.elementCount(); ++e) {
    const double pressure_MPa = state.elementUnknowns(0, e);
    double swollen = 0, size = 0;
    for (int point = 0; point < 8; ++point) {
      const HexPointGeometry geometry = hexGeometry(mesh, e, hexCorner(point) / std::sqrt(3.0));
      Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
      for (int n = 0; n < 8; ++n)
        F += state.displacements_mm.col(mesh.elements(n, e)) * geometry.gradients.col(n).transpose();
      const Eigen::Matrix3d P = firstPiolaStress(design.material, F, pressure_MPa);
      for (int n = 0; n < 8; ++n)
        imbalance.segment<3>(Eigen::Index{3} * mesh.elements(n, e)) +=
            geometry.determinant * (P * geometry.gradients.col(n));
      swollen += geometry.determinant * (F.determinant() - 1);
      size += geometry.determinant;
    }
    volume = std::max(volume, std::abs(swollen / size - pressure_MPa * design.material.compressibility_per_MPa()));
  }
  const std::vector<bool> clamped = clampedNodes(mesh);
  for (int n = 0; n < mesh.nodeCount(); ++n)
    if (clamped[std::size_t(n)]) imbalance.segment<3>(Eigen::Index{3} * n).setZero(); // reactions
  const double scale = external.norm();
  return std::max(scale > 0 ? imbalance.norm() / scale : imbalance.norm(), volume);
}

} // namespace palp
