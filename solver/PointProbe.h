#pragma once

#include "model/Mesh.h"
#include "model/Solution.h"

#include <Eigen/Core>

#include <vector>

namespace palp {

/// Reads displacement and pressure at points of the block. The displacement is that of the first element that holds
/// the point (with its bubble); the pressure, which jumps between elements, is averaged over all that hold it.
class PointProbe {
public:
  /// Throws DesignError where a point lies outside the mesh.
  PointProbe(const Mesh& mesh, const Eigen::Matrix3Xd& points_mm);

  [[nodiscard]] Eigen::Matrix3Xd displacements_mm(const LoadIncrement& state) const;
  /// Hydrostatic pressure, compression positive.
  [[nodiscard]] Eigen::VectorXd pressures_MPa(const LoadIncrement& state) const;

  /// Weights of the nodes' and of the element's own unknowns for one point: the displacement is linear in them.
  struct Holder {
    int element = 0;
    Eigen::VectorXd shapes;   ///< one a node of the element
    double bubble = 0;        ///< weight of the bubble's displacement
    Eigen::VectorXd pressure; ///< one a pressure unknown
  };
  /// The elements that hold each point.
  [[nodiscard]] const std::vector<std::vector<Holder>>& holders() const { return holders_; }

private:
  Eigen::MatrixXi elements_;
  std::vector<std::vector<Holder>> holders_;
};

} // namespace palp
