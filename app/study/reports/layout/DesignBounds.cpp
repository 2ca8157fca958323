#include "app/study/reports/layout/DesignBounds.h"

#include "app/study/reports/layout/FieldResponse.h"

namespace palp {

DesignBounds designBounds(const SensorDesign& layout, const AreaResponse& response, double relativeNoise, int threads,
                          const std::stop_token& stop) {
  const int row = centreRowWire(layout.rowWires());
  if (const FieldLaw* law = layout.field()) {
    const FieldResponse field(layout, *law, response, threads, 1, stop);
    return {field.bound(law->readout, row, relativeNoise), field.bound(law->readout, -1, relativeNoise)};
  }
  return {layoutBound(layout, response, row, relativeNoise), layoutBound(layout, response, -1, relativeNoise)};
}

std::optional<DesignBounds> designBounds(const SensorDesign& design, const MeshOptions& mesh, double relativeNoise,
                                         int threads, const ReportProgress& progress, const std::stop_token& stop) {
  StageLog stages;
  const auto response = AreaResponse::solve(design, mesh, threads, stages, progress, stop);
  if (!response) return {};
  return designBounds(design, *response, relativeNoise, threads, stop);
}

} // namespace palp
