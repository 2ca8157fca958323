#pragma once

#include "app/study/reports/layout/DesignBounds.h"
#include "app/study/reports/layout/FieldResponse.h"
#include "solver/SensorMesh.h"

#include <memory>
#include <stop_token>
#include <vector>

namespace palp {

/// What a design answers to small forces at rest. Its parts outlive a change of what they do not depend on: the block's
/// answer one of the law, the field's one of the read-out.
struct RestFloor {
  SensorDesign design;
  MeshOptions mesh;
  std::shared_ptr<const AreaResponse> block;
  std::shared_ptr<const FieldResponse> field; ///< null by Eq. (1)

  /// It is of this design, but for the read-out.
  [[nodiscard]] bool isOf(const SensorDesign& other, const MeshOptions& otherMesh) const;
};

/// Takes over from `before` (null: nothing) what still holds. Null where it was stopped. Throws DesignError where the
/// field has no bounds.
std::shared_ptr<const RestFloor> restFloor(const SensorDesign& design, const MeshOptions& mesh,
                                           const std::shared_ptr<const RestFloor>& before,
                                           const ReportProgress& progress, const std::stop_token& stop);

/// By the design's own law and read-out, for relative noise of the resistances.
DesignBounds boundsAtRest(const RestFloor& floor, double relativeNoise);

/// The same by Eq. (1) and by the field with each read-out; the design's law is the field.
struct RestBounds {
  DesignBounds pairs;
  std::vector<DesignBounds> readouts; ///< in the order of Readout
};

RestBounds restBounds(const RestFloor& floor, double relativeNoise);

} // namespace palp
