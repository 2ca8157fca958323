#pragma once

#include "app/study/reports/layout/LayoutBound.h"
#include "model/TerminalNetwork.h"

#include <Eigen/Core>

#include <array>
#include <stop_token>
#include <vector>

namespace palp {

class FieldSensitivity;

/// Throws DesignError where the design has a pressure law: it has a kink at rest, where its bounds would be taken.
void requireSmoothAtRest(const SensorDesign& design);

/// How the resistances of a layout under the field follow the forces on each area, to first order at rest: no mesh for
/// the field, and another read-out costs nothing.
class FieldResponse {
public:
  /// `response` is that of the same block at rest (AreaResponse::atRest); `fineness` as FieldSensitivity's. Throws as
  /// requireSmoothAtRest does, and Cancelled where it was stopped.
  FieldResponse(const SensorDesign& layout, const FieldLaw& law, const AreaResponse& response, int threads,
                double fineness = 1, const std::stop_token& stop = {});

  /// At rest, row-wires x column-wires.
  [[nodiscard]] Eigen::MatrixXd resistances_ohm(Readout readout) const;
  /// d ln R / dF [1/N] by Fx, Fy, Fz, row-wires x column-wires each. One an area.
  [[nodiscard]] std::vector<std::array<Eigen::MatrixXd, 3>> logSensitivity(Readout readout) const;
  /// Of one row-wire, or of all with row-wire -1, for relative resistance noise: one, or one a reading (row-wires x
  /// column-wires).
  [[nodiscard]] LayoutBound bound(Readout readout, int rowWire, double relativeNoise) const;
  [[nodiscard]] LayoutBound bound(Readout readout, int rowWire,
                                  const Eigen::Ref<const Eigen::MatrixXd>& relativeNoise) const;
  [[nodiscard]] const TerminalNetwork& network() const { return network_; }

private:
  FieldResponse(const SensorDesign& layout, const FieldSensitivity& field, const AreaResponse& response, int threads,
                const std::stop_token& stop);

  TerminalNetwork network_;
  Eigen::Vector3d range_N_;
  std::vector<std::array<Eigen::MatrixXd, 3>> conductanceChanges_; ///< dY / dF, one an area
};

} // namespace palp
