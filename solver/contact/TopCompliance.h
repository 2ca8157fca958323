#pragma once

#include "solver/batch/ElementwiseTangent.h"
#include "solver/batch/FactorPath.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

namespace palp {

/// How the nodes of the top face that an indenter can press move under forces on them, by the tangent at rest: 3 x 3
/// blocks [mm/N] of its inverse, in single precision, as the factor is: an iteration is led by it, its answer is not.
class TopCompliance {
public:
  /// The nodes that are meant.
  static std::vector<int> nodesIn(const Mesh& mesh, const std::optional<Rectangle>& part);
  /// Of the contact points of the top face (ContactPoints.h), or of those in a part of it. Empty: stopped.
  static std::shared_ptr<const TopCompliance> find(const ElementwiseTangent& tangent, const Mesh& mesh,
                                                   const std::optional<Rectangle>& part, int threads,
                                                   const std::stop_token& stop = {});
  /// The same where it is known: 3 x 3 blocks in the order of the nodes.
  TopCompliance(const ElementwiseTangent& tangent, const Mesh& mesh, const std::optional<Rectangle>& part,
                Eigen::MatrixXf blocks);

  [[nodiscard]] int count() const { return static_cast<int>(nodes_.size()); }
  [[nodiscard]] const std::vector<int>& nodes() const { return nodes_; }         ///< of the mesh
  [[nodiscard]] const Eigen::Matrix3Xd& places_mm() const { return places_mm_; } ///< at rest
  /// Of the nodes in the factor.
  [[nodiscard]] const FactorPath& path() const { return path_; }
  /// Whether node i lies beside contact points that are left out.
  [[nodiscard]] bool atBorder(int i) const { return atBorder_[std::size_t(i)]; }
  /// Motion of node i, counted in nodes(), by a force on node j.
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
