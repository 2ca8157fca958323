#pragma once

#include "solver/PointProbe.h"
#include "solver/field/FieldMesh.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace palp {

/// The part of each electrode's field that is subtracted in closed form: 1/(4 pi r) of itself and of its mirror images
/// in the displaced faces near by, in two or three of them at edges and corners. The remainder is smooth and left to
/// the mesh.
class FieldSources {
public:
  /// Electrodes 3 x n at rest; faces nearer than `cutoff_mm` have image sources.
  FieldSources(const FieldMesh& mesh, const Eigen::Vector3d& block_mm, const Eigen::Matrix3Xd& electrodes_mm,
               double cutoff_mm);

  /// Positions of the sources of each electrode for these positions of nodes and electrodes; its own first.
  [[nodiscard]] std::vector<Eigen::Matrix3Xd> at(const Eigen::Matrix3Xd& nodes_mm,
                                                 const Eigen::Matrix3Xd& electrodes_mm) const;

private:
  struct Mirrors {
    std::array<std::vector<int>, 3> alongAxis; ///< numbers of projections onto faces
  };
  Eigen::MatrixXi elements_;
  Eigen::Matrix3Xd normals_; ///< outward, of the face at rest of each projection
  std::vector<Mirrors> mirrors_;
  std::vector<std::vector<int>> projectionElements_;
  std::vector<std::vector<Eigen::Matrix<double, 3, 10>>> projectionGradients_;
  std::vector<Eigen::Matrix<double, 10, 1>> projectionShapes_;
};

} // namespace palp
