#pragma once

#include "solver/PointProbe.h"
#include "solver/field/FieldMesh.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace palp {

/// What is taken off the field of each electrode in closed form: 1/(4 pi r) of itself and of its mirror images in the
/// displaced faces near by, in two or three of them at edges and corners. What remains is smooth and the mesh's part.
class FieldSources {
public:
  /// Electrodes 3 x n at rest; faces nearer than `reach_mm` mirror.
  FieldSources(const FieldMesh& mesh, const Eigen::Vector3d& block_mm, const Eigen::Matrix3Xd& electrodes_mm,
               double reach_mm);

  /// Where the sources of each electrode are while the nodes and electrodes stand at these places; its own first.
  [[nodiscard]] std::vector<Eigen::Matrix3Xd> at(const Eigen::Matrix3Xd& nodes_mm,
                                                 const Eigen::Matrix3Xd& electrodes_mm) const;

private:
  struct Mirrors {
    std::array<std::vector<int>, 3> alongAxis; ///< numbers of feet
  };
  Eigen::MatrixXi elements_;
  Eigen::Matrix3Xd normals_; ///< outward, of the face at rest that each foot lies on
  std::vector<Mirrors> mirrors_;
  std::vector<std::vector<int>> feetElements_;
  std::vector<std::vector<Eigen::Matrix<double, 3, 10>>> feetGradients_;
  std::vector<Eigen::Matrix<double, 10, 1>> feetShapes_;
};

} // namespace palp
