#pragma once

#include "model/Mesh.h"
#include "model/SensorDesign.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace palp {

/// The boundary of a mesh for drawing: found once a mesh, then only its points move.
struct MeshSurface {
  std::vector<int> nodes;                    ///< mesh node of each surface point
  std::vector<std::array<int, 3>> triangles; ///< surface points; a quadratic face gives four
  std::vector<std::vector<int>> edges;       ///< surface points along each edge of a boundary face, once
};
MeshSurface meshSurface(const Mesh& mesh);

/// A place on the top face at rest as a mean of three mesh nodes.
struct TopPoint {
  std::array<int, 3> nodes{};
  std::array<double, 3> weights{};

  /// The mean of a nodal field (one column a node).
  [[nodiscard]] Eigen::Vector3d of(const Eigen::Matrix3Xd& nodal) const;
};

/// The top face at rest, for many questions.
class TopFace {
public:
  explicit TopFace(const Mesh& mesh);

  /// The point nearest to (x, y), which lies on the face.
  [[nodiscard]] TopPoint at(const Eigen::Vector2d& xy_mm) const;

private:
  struct Piece {
    std::array<int, 3> nodes;
    Eigen::Vector2d corner;
    Eigen::Matrix2d inverse; ///< of the two sides
  };
  std::vector<Piece> pieces_;
};
/// The same for one question.
TopPoint topPoint(const Mesh& mesh, const Eigen::Vector2d& xy_mm);

/// Corners and points along the border of each load area, `steps` a side, closed; one list for each area.
std::vector<std::vector<TopPoint>> areaBorders(const TopFace& top, const SensorDesign& design, int steps);

} // namespace palp
