#pragma once

#include <Eigen/Core>

#include <array>

namespace palp {

/// Green's function of an insulated box of conductivity 1 between all pairs of some points, in closed form:
///   - lap G(., x') = delta(. - x') - 1/V,   d_n G = 0 on all faces,   mean of G = 0.
/// G = integral over t of k k k - 1/V, k the heat kernel of a rod with insulated ends along each axis
/// (resources/docs/numerics/field-at-rest.md). Rows are points p, columns points q; on the diagonal is the
/// regular part, the limit of G(x, x_p) - 1/(4 pi |x - x_p|) as x tends to x_p.
struct BoxGreen {
  Eigen::MatrixXd value;                ///< G(x_p, x_q) [1/mm], symmetric
  std::array<Eigen::MatrixXd, 3> slope; ///< dG / dx_p [1/mm2]; diagonal: half of what the regular part at p changes by

  /// The point that is moved by u changes its own regular gradient by mixed(p, p) u; own(p, p) is 0.
  struct Curvature {
    std::array<Eigen::MatrixXd, 6> own;   ///< d2G / dx_p dx_p [1/mm3] in the order xx, yy, zz, xy, yz, zx
    std::array<Eigen::MatrixXd, 9> mixed; ///< [3 i + j]: d2G / dx_p(i) dx_q(j) [1/mm3]
  };
  Curvature curvature; ///< empty unless requested
};

/// Of points (3 x n, no two at one place) inside the block, origin at a corner; exact to rounding. `threads` 0: all
/// cores, the same bytes at any number.
BoxGreen boxGreen(const Eigen::Vector3d& block_mm, const Eigen::Ref<const Eigen::Matrix3Xd>& points_mm,
                  bool withCurvature = false, int threads = 1);

} // namespace palp
