#include "app/study/reports/layout/LayoutBound.h"
#include "app/study/reports/stability/StabilityRow.h"

#include "app/study/decoding/TwoStep.h"
#include "model/RowColumnResistance.h"
#include "model/base/Text.h"

#include <cmath>

namespace palp {

namespace {

constexpr int kRow = 0;

/// Largest difference of the Jacobian to central differences, relative to its largest entry.
double jacobianError(const SensorDesign& design, double step_mm) {
  RowResistanceJacobian jacobian;
  const ElectrodeDisplacements rest = ElectrodeDisplacements::atRest(design);
  const Eigen::VectorXd resistances = rowResistances(design, rest, kRow, &jacobian);
  Eigen::MatrixXd numeric(resistances.size(), jacobian.upper.cols());
  for (Eigen::Index i = 0; i < numeric.cols(); ++i) {
    ElectrodeDisplacements above = rest, below = rest;
    above.upper_mm(i % 3, kRow * design.electrodesPerRowWire() + i / 3) += step_mm;
    below.upper_mm(i % 3, kRow * design.electrodesPerRowWire() + i / 3) -= step_mm;
    numeric.col(i) = (rowResistances(design, above, kRow) - rowResistances(design, below, kRow)) / (2 * step_mm);
  }
  return (numeric - jacobian.upper).cwiseAbs().maxCoeff() / jacobian.upper.cwiseAbs().maxCoeff();
}

/// Upper electrodes right above lower ones, at a distance.
SensorDesign touching(const SensorDesign& design, double distance_mm) {
  SensorDesign close = design;
  close.lower.wire_mm[0] = close.upper.along(0, 0);
  for (std::size_t wire = 1; wire < close.lower.wire_mm.size(); ++wire)
    if (close.lower.wire_mm[wire] == close.lower.wire_mm[0]) close.lower.wire_mm[wire] += 0.2;
  for (std::vector<double>& places : close.lower.along_mm) places[0] = close.upper.wire_mm[kRow];
  close.lower.z_mm = {{close.upper.z(0, 0) - distance_mm}};
  return close;
}

} // namespace

void addResistanceCases(StabilityCases& cases, const ReportRequest& request) {
  for (const double distance : {0.1, 1e-2, 1e-4, 1e-6})
    cases.add("Eq. (1): electrodes nearly touching", text(distance) + " mm apart", [&](StabilityRow& row) {
      const SensorDesign design = touching(request.design, distance);
      requireValid(design);
      row.condition = condition(resistanceSingularValues(design, kRow));
      row.error = jacobianError(design, 1e-4 * distance);
      row.errorOf = "Jacobian by differences";
      judge(row, 1e-5); // (step / distance)^2 = 1e-8, and cancellation in R where the step is tiny
    });
  cases.add("Eq. (1): electrodes touching", "a displacement that closes the gap (a short)", [&](StabilityRow& row) {
    const SensorDesign design = touching(request.design, 0.1);
    ElectrodeDisplacements shorted = ElectrodeDisplacements::atRest(design);
    shorted.upper_mm(2, 0) = -(design.upper.z(0, 0) - design.lower.z(0, 0));
    const double resistance = rowResistances(design, shorted, kRow)(0);
    row.error = std::abs(resistance);
    row.errorOf = "R = 0 [ohm]";
    judge(row, 0);
  });
  for (const double y : {13.5, 14.9, 14.999, 15.0})
    cases.add("Eq. (1): symmetric layout", "row-wire at y = " + text(y) + " mm of a layout symmetric about 15 mm",
              [&](StabilityRow& row) {
                SensorDesign design = paperDesign();
                design.upper.wire_mm[kRow] = y;
                if (y == 13.5) design.upper.wire_mm[4] = 1.5;
                requireValid(design);
                row.condition = condition(resistanceSingularValues(design, kRow));
                const Eigen::VectorXd rest = rowResistances(design, ElectrodeDisplacements::atRest(design), kRow);
                const Inversion inversion = invertRowResistances(design, kRow, rest);
                row.error = inversion.displacements_mm.norm();
                row.errorOf = "rest [mm] by inverting Eq. (1)";
                judge(row, 1e-9);
                if (inversion.rank == 3 * design.electrodesPerRowWire()) return;
                row.outcome = StabilityOutcome::Warned;
                row.words = "the inversion reports rank " + std::to_string(inversion.rank) + " of " +
                            std::to_string(3 * design.electrodesPerRowWire()) +
                            ": the displacements do not follow "
                            "from the resistances here, and the step of smallest norm is used";
              });
}

} // namespace palp
