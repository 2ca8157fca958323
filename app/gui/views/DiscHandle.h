#pragma once

#include "model/LoadCase.h"

#include <vector>

namespace palp {

constexpr double kSmallestDisc_mm = 0.1;

/// The disc nearest to this one that lies wholly on the top face.
PatchLoad insideFace(PatchLoad disc, const Eigen::Vector3d& block_mm);

/// The disc nearest to this one whose centre lies on the top face: an indenter's, which may extend over an edge.
PatchLoad overFace(PatchLoad disc, const Eigen::Vector3d& block_mm);

/// A disc held by the mouse: at its rim it is sized, inside it is moved.
class DiscHandle {
public:
  /// Takes the uppermost disc under a place of the top face; its rim is `tolerance_mm` wide to both sides.
  bool take(const std::vector<PatchLoad>& discs, const Eigen::Vector2d& at_mm, double tolerance_mm);
  void release() { disc_ = -1; }

  [[nodiscard]] int disc() const { return disc_; } ///< -1: none is held
  [[nodiscard]] bool sizes() const { return rim_; }
  /// The disc with the mouse at another place, to a tenth of a millimetre; kept inside the face, or over it.
  [[nodiscard]] PatchLoad draggedTo(const Eigen::Vector2d& at_mm, const Eigen::Vector3d& block_mm,
                                    bool inside = true) const;

private:
  int disc_ = -1;
  bool rim_ = false;
  PatchLoad held_;
  Eigen::Vector2d from_mm_ = Eigen::Vector2d::Zero();
};

} // namespace palp
