#pragma once

#include "solver/field/FieldConductivity.h"
#include "solver/field/FieldMesh.h"

#include <Eigen/Core>

#include <vector>

namespace palp {

/// The functions of which the mesh's part of the potential is made. In every element the ten quadratic ones, one a
/// node. Where k varies, four more, one a corner: its barycentric coordinate times what a quadratic function leaves of
/// 1/m,
///   I(1/m) - 1/m,    I: quadratic between the nodes,    m = sqrt(k).
/// Across a kink or a steep flank of k the potential s_q / (m m_q) + w_q is smooth, so w_q is as rough there as 1/m,
/// times what is smooth (J. M. Melenk and I. Babuska, The partition of unity finite element method, 1996). They are 0
/// at all nodes.
class FieldFunctions {
public:
  static constexpr int most = 14; ///< in an element

  FieldFunctions(const FieldMesh& mesh, FieldConductivity conductivity, int threads);

  [[nodiscard]] const FieldConductivity& conductivity() const { return conductivity_; }
  /// Whether a corner has its function: where 1/m is other than quadratic, by 1e-3 at least, in an element around it.
  /// In those others around it the function is as it comes out, as it has to be the same on both sides of a face.
  [[nodiscard]] bool isRough(int corner) const { return !rough_.empty() && rough_[std::size_t(corner)]; }
  /// 10, or 14 where a corner has one. Those of the others are 0 then.
  [[nodiscard]] int count(int element) const;
  /// Place of an element's functions among all: that of its node, or after all nodes that of its corner.
  [[nodiscard]] int row(int function, int element) const { return row(*mesh_, function, element); }
  [[nodiscard]] static int row(const FieldMesh& mesh, int function, int element);

  struct Point {
    Eigen::Matrix<double, most, 1> values = Eigen::Matrix<double, most, 1>::Zero();
    Eigen::Matrix<double, most, 3> gradients = Eigen::Matrix<double, most, 3>::Zero();
  };
  /// At a point of an element; derivatives by the last three barycentric coordinates.
  [[nodiscard]] Point at(int element, const Eigen::Vector4d& barycentric) const;

private:
  const FieldMesh* mesh_;
  FieldConductivity conductivity_;
  std::vector<bool> rough_; ///< by corners; empty: none is
};

} // namespace palp
