#pragma once

#include "app/study/touch/DesignMirror.h"
#include "model/TouchRange.h"
#include "solver/ConductionBatch.h"

#include <span>
#include <vector>

namespace palp {

/// Loads of a symmetric design, reflected to the low side of its planes of symmetry: what is prepared once for many
/// loads (meshes of parts of the face, surrogates of areas) is prepared for that side alone. Without symmetry it leaves
/// all as it is.
class SymmetryReduction {
public:
  SymmetryReduction() = default;
  /// For touches: planes that cross their rectangle.
  SymmetryReduction(const SensorDesign& design, const TouchRange& touches);
  /// For loads on one area each: planes that reflect the force range to itself.
  explicit SymmetryReduction(const SensorDesign& design);

  [[nodiscard]] bool empty() const { return mirrors_.empty(); }
  /// The part of the rectangle on the low side, with the images of the remainder.
  [[nodiscard]] TouchRange of(TouchRange touches) const;
  /// The areas on the low side whose images these areas are.
  [[nodiscard]] std::vector<int> of(std::span<const int> areas) const;
  [[nodiscard]] std::vector<LoadCase> of(std::span<const LoadCase> loads) const;
  /// Maps the answers of the reflected loads (empty without electrodes) back to those of the loads.
  void mapBack(std::span<const LoadCase> loads, ConductionBatch::Answers& answers) const;

private:
  std::vector<DesignMirror> mirrors_;
};

} // namespace palp
