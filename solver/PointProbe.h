#pragma once

#include "model/Mesh.h"
#include "model/Solution.h"

#include <Eigen/Core>

#include <vector>

namespace palp {

/// Reads displacement and pressure at points of the block. The displacement is taken from the first element that
/// contains the point (with its bubble); the pressure, which jumps between elements, is averaged over all that contain
/// it.
class PointProbe {
public:
  /// Throws DesignError if a point lies outside the mesh.
  PointProbe(const Mesh& mesh, const Eigen::Matrix3Xd& points_mm);

  [[nodiscard]] Eigen::Matrix3Xd displacements_mm(const LoadIncrement& state) const;
  /// Hydrostatic pressure, positive in compression.
  [[nodiscard]] Eigen::VectorXd pressures_MPa(const LoadIncrement& state) const;

  /// An element that contains the point, and the weights of its nodes' and its own unknowns: the displacement is linear
  /// in them.
  struct Host {
    using Weights =
        Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 10, 1>; // at most 10, in the holder itself
    int element = 0;
    Weights shapes;    ///< one per node of the element
    double bubble = 0; ///< weight of the bubble's displacement
    Weights pressure;  ///< one per pressure unknown
  };
  /// The elements that contain each point.
  [[nodiscard]] const std::vector<std::vector<Host>>& hosts() const { return hosts_; }

private:
  Eigen::MatrixXi elements_;
  std::vector<std::vector<Host>> hosts_;
};

} // namespace palp
