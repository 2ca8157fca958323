#pragma once

#include "app/study/reports/layout/LayoutBound.h"

#include <optional>
#include <stop_token>

namespace palp {

/// What a design resolves in the middle of its force range, from its own response: no samples are needed. Under the
/// field at rest.
struct DesignBounds {
  LayoutBound centreRow; ///< of the row-wire in the middle alone
  LayoutBound allRows;
};

/// Under the field throws Cancelled where it was stopped.
DesignBounds designBounds(const SensorDesign& layout, const AreaResponse& response, double relativeNoise,
                          int threads = 0, const std::stop_token& stop = {});

/// The same for a design whose response is still to be solved. Empty where it was stopped.
std::optional<DesignBounds> designBounds(const SensorDesign& design, const MeshOptions& mesh, double relativeNoise,
                                         int threads, const ReportProgress& progress, const std::stop_token& stop);

} // namespace palp
