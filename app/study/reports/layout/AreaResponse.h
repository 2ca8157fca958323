#pragma once

#include "app/study/StageLog.h"
#include "app/study/reports/Report.h"
#include "model/Mesh.h"
#include "model/RowColumnResistance.h"
#include "model/SensorDesign.h"
#include "model/Solution.h"

#include <array>
#include <optional>
#include <stop_token>
#include <vector>

namespace palp {

/// What the electrodes of a layout feel in the middle of an area's force range, and how that changes with the force.
struct ElectrodeResponse {
  ElectrodeDisplacements middle;
  std::array<ElectrodeDisplacements, 3> perNewton; ///< derivatives by Fx, Fy, Fz [mm/N, MPa/N]
};

/// The block's answer to each load area around the middle of the force range: nonlinear solves once, then any layout of
/// electrodes is read out of them, for electrodes do not stiffen the rubber.
class AreaResponse {
public:
  /// What bounds of the design need: under the law of the field `atRest`. Empty where it was stopped. Throws
  /// DesignError where the middle of the range has no solution.
  static std::optional<AreaResponse> solve(const SensorDesign& design, const MeshOptions& mesh, int threads,
                                           StageLog& stages, const ReportProgress& progress, std::stop_token stop);

  /// The linear answer of the block at rest instead: one factorisation and a right side for each force. The middle is
  /// then the state at rest.
  static std::optional<AreaResponse> atRest(const SensorDesign& design, const MeshOptions& mesh, int threads,
                                            StageLog& stages, const ReportProgress& progress, std::stop_token stop);

  /// Of the electrodes of one row-wire (those of the others stay at rest), or of all with row-wire -1; lower electrodes
  /// are read where they follow the rubber, pressures where the design has a law for them. One an area.
  [[nodiscard]] std::vector<ElectrodeResponse> read(const SensorDesign& layout, int rowWire) const;

  /// Derivatives of the displacement by Fx, Fy, Fz [mm/N] at points of the block, 3 x points. One an area.
  [[nodiscard]] std::vector<std::array<Eigen::Matrix3Xd, 3>>
  perNewtonAt(const Eigen::Ref<const Eigen::Matrix3Xd>& points_mm, int threads) const;

  [[nodiscard]] const Mesh& mesh() const { return mesh_; }

private:
  struct AreaState {
    LoadIncrement middle;
    std::array<LoadIncrement, 3> perNewton;
  };
  Mesh mesh_;
  std::vector<AreaState> areas_;
};

} // namespace palp
