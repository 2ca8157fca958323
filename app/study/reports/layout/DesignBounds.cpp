#include "app/study/reports/layout/DesignBounds.h"

namespace palp {

DesignBounds designBounds(const SensorDesign& layout, const AreaResponse& response, double relativeNoise) {
  return {layoutBound(layout, response, centreRowWire(layout.rowWires()), relativeNoise),
          layoutBound(layout, response, -1, relativeNoise)};
}

std::optional<DesignBounds> designBounds(const SensorDesign& design, const MeshOptions& mesh, double relativeNoise,
                                         const ReportProgress& progress, const std::stop_token& stop) {
  StageLog stages;
  const auto response = AreaResponse::solve(design, mesh, 0, stages, progress, stop);
  if (!response) return {};
  return designBounds(design, *response, relativeNoise);
}

} // namespace palp
