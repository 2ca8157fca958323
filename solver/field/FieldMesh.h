#pragma once

#include "model/Mesh.h"
#include "model/Solution.h"

#include <Eigen/Core>

#include <numbers>

namespace palp {

/// Of a source's own field 1/(4 pi r).
inline constexpr double kFourPi = 4 * std::numbers::pi;

/// Numbers of nodes (rows), one a source (columns).
using SourceRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The block as the conduction field sees it: quadratic tetrahedra on the solver's nodes. Hexahedra are cut into six
/// each; their trilinear faces are reproduced exactly by curved quadratic ones.
class FieldMesh {
public:
  explicit FieldMesh(const Mesh& solverMesh);

  [[nodiscard]] const Mesh& tets() const { return tets_; } ///< at rest
  [[nodiscard]] int nodes() const { return tets_.nodeCount(); }
  [[nodiscard]] int elements() const { return tets_.elementCount(); }
  /// Elements' corners are the first nodes.
  [[nodiscard]] int corners() const { return corners_; }
  /// Nodes of the faces on the boundary, 6 x faces: three corners, counter-clockwise from outside, and the middles of
  /// the edges from each to the next.
  [[nodiscard]] const Eigen::MatrixXi& faces() const { return faces_; }
  /// 4 x elements: the element behind the face opposite to each corner; -1: none.
  [[nodiscard]] const Eigen::MatrixXi& neighbours() const { return neighbours_; }
  /// Values at the solver's nodes (columns) taken over to all nodes.
  [[nodiscard]] Eigen::MatrixXd atNodes(const Eigen::Ref<const Eigen::MatrixXd>& solverNodes) const;

private:
  void cutHexahedra(const Mesh& hexahedra);
  void findFaces();

  Mesh tets_;
  Eigen::MatrixXi cornersAround_; ///< up to 8 of the solver's nodes whose mean a node is, else -1; none: the same nodes
  Eigen::MatrixXi faces_, neighbours_;
  int corners_ = 0;
};

} // namespace palp
