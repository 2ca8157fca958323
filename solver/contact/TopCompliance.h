#pragma once

#include "solver/batch/ElementwiseTangent.h"
#include "solver/batch/FactorPath.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

namespace palp {

/// Compliance of the nodes of the top face that an indenter can press, from the tangent at rest: 3 x 3 blocks [mm/N] of
/// its inverse, in single precision as the factor is. It preconditions an iteration and does not change its result.
class TopCompliance {
public:
  /// Contact points in a part of the top face, or all of them, as nodes of the mesh.
  static std::vector<int> nodesIn(const Mesh& mesh, const std::optional<Rectangle>& part);
  /// Computes the compliance of the contact points of the top face (ContactPoints.h), or of those in a part of it.
  /// Returns null if cancelled.
  static std::shared_ptr<const TopCompliance> find(const ElementwiseTangent& tangent, const Mesh& mesh,
                                                   const std::optional<Rectangle>& part, int threads,
                                                   const std::stop_token& stop = {});
  /// From computed blocks, 3 x 3 in the order of the nodes.
  TopCompliance(const ElementwiseTangent& tangent, const Mesh& mesh, const std::optional<Rectangle>& part,
                Eigen::MatrixXf blocks);

  [[nodiscard]] int count() const { return static_cast<int>(nodes_.size()); }
  [[nodiscard]] const std::vector<int>& nodes() const { return nodes_; }         ///< of the mesh
  [[nodiscard]] const Eigen::Matrix3Xd& places_mm() const { return places_mm_; } ///< at rest
  /// The part of the factor that the nodes' rows depend on.
  [[nodiscard]] const FactorPath& path() const { return path_; }
  /// Whether node i has a neighbouring contact point outside of the part.
  [[nodiscard]] bool atBorder(int i) const { return atBorder_[std::size_t(i)]; }
  /// Displacement of node i, by its number in nodes(), per force on node j.
  [[nodiscard]] Eigen::Matrix3d block(int i, int j) const {
    return blocks_.block<3, 3>(3 * Eigen::Index(i), 3 * Eigen::Index(j)).cast<double>();
  }
  [[nodiscard]] Eigen::Vector3d motion(int i, int j, const Eigen::Vector3d& force_N) const {
    return block(i, j) * force_N;
  }

private:
  std::vector<int> nodes_;
  std::vector<bool> atBorder_;
  Eigen::Matrix3Xd places_mm_;
  FactorPath path_;
  Eigen::MatrixXf blocks_;
};

} // namespace palp
