#pragma once

#include "app/study/touch/DesignMirror.h"
#include "model/TouchRange.h"
#include "solver/ConductionBatch.h"

#include <span>
#include <vector>

namespace palp {

/// Loads of a design that is its own mirror image, brought to the low side of the mirrors' planes: what is prepared
/// once for many loads (meshes of parts of the face, surrogates of areas) is prepared for that side alone. Without
/// mirrors it leaves all as it is.
class LowSide {
public:
  LowSide() = default;
  /// Of touches: mirrors whose plane goes through their rectangle.
  LowSide(const SensorDesign& design, const TouchRange& touches);
  /// Of loads on one area each: mirrors that take the force range to itself.
  explicit LowSide(const SensorDesign& design);

  [[nodiscard]] bool empty() const { return mirrors_.empty(); }
  /// The part of the rectangle there, with the images of the rest.
  [[nodiscard]] TouchRange of(TouchRange touches) const;
  /// The areas there that these areas are images of.
  [[nodiscard]] std::vector<int> of(std::span<const int> areas) const;
  [[nodiscard]] std::vector<LoadCase> of(std::span<const LoadCase> loads) const;
  /// From what those loads answer (without electrodes: nothing) what the loads themselves do.
  void bringBack(std::span<const LoadCase> loads, ConductionBatch::Answers& answers) const;

private:
  std::vector<DesignMirror> mirrors_;
};

} // namespace palp
