#pragma once

#include "solver/field/FieldMesh.h"

#include <Eigen/Core>

namespace palp {

/// Quadrature points on the boundary of the deformed block, face by face: where they are, and the outward normal times
/// the area that each stands for.
class BoundaryQuadrature {
public:
  BoundaryQuadrature(const FieldMesh& mesh, const Eigen::Matrix3Xd& nodes_mm);

  [[nodiscard]] Eigen::Index points() const { return at_.rows(); }
  /// Potential 1/(4 pi r) at each point of the sources (3 x sources) together, and its flux outward times the area.
  void addSources(const Eigen::Matrix3Xd& sources_mm, double* potential, double* flux) const;
  /// Integral of each node's shape function with what stands at the points, areas included.
  [[nodiscard]] Eigen::VectorXd atNodes(const Eigen::Ref<const Eigen::VectorXd>& points) const;

private:
  const FieldMesh* mesh_;
  Eigen::Matrix<double, Eigen::Dynamic, 6> at_; ///< points x (place, normal times area)
};

} // namespace palp
