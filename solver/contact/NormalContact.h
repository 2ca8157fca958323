#pragma once

#include "model/Indenter.h"
#include "solver/contact/ColumnContact.h"
#include "solver/contact/TopCompliance.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace palp {

/// Frictionless contact of rigid indenters in the space of the nodes that they can press. With c the motion of those
/// nodes without contact forces and C their compliance,
///
///   x_i = X_i + c_i + sum_j C_ij n_j f_j,   f_i >= 0,  g_i = g(x_i - d) >= 0,  f_i g_i = 0,   sum_i f_i n_i . e_z =
///   F_z
///
/// is solved for the normal forces f [N] and, where an indenter's force is given, for its depth d_z [mm] by a
/// primal-dual active set (Hintermueller, Ito, Kunisch 2003) whose normals are taken again in every step. A node
/// belongs to the indenter that it is nearest to. One unknown per node where ReducedContact, which has friction, needs
/// three: for the many touches of a batch.
class NormalContact final : public ColumnContact {
public:
  NormalContact(std::vector<Indenter> indenters, std::shared_ptr<const TopCompliance> top);

  [[nodiscard]] bool solve(const Eigen::Matrix3Xd& motion_mm, const std::stop_token& stop) override;
  [[nodiscard]] std::vector<NodeForce> forces() const override;
  [[nodiscard]] StepResult finishIncrement(const Eigen::Matrix3Xd&) override { return StepResult::Converged; }

private:
  /// A node near the indenter, and where it would be without contact forces.
  struct FreeNode {
    int node = 0;
    Eigen::Vector3d place_mm;
  };
  /// The indenter nearest to a position.
  struct Nearest {
    std::size_t indenter = 0;
    double gap_mm = 0;
    Eigen::Vector3d normal;
  };
  [[nodiscard]] Nearest nearest(const Eigen::Vector3d& place_mm) const;
  [[nodiscard]] std::vector<FreeNode> nearNodes(const Eigen::Matrix3Xd& motion_mm) const;
  [[nodiscard]] Eigen::Vector3d motionByForces(int node) const;
  [[nodiscard]] bool step(const std::vector<FreeNode>& near, bool& converged);

  std::vector<Indenter> indenters_;
  std::shared_ptr<const TopCompliance> top_;
  double height_mm_;                     ///< of the block
  std::vector<Eigen::Vector3d> tips_mm_; ///< positions of their lowest points
  std::vector<NodeForce> forces_;        ///< nodes by their number in the compliance
};

} // namespace palp
