#pragma once

#include "app/gui/project/ViewSettings.h"
#include "app/scenes/charts/Chart.h"
#include "model/RowColumnResistance.h"
#include "model/Solution.h"
#include "solver/PointProbe.h"

#include <memory>

namespace palp {

/// Relative residuals over all iterations, one curve a load fraction.
ChartSpec newtonChart(const std::vector<NewtonStep>& steps);

/// Displacements of a row-wire's electrodes along it, at rest and under the load (Figs. 6 and 7).
ChartSpec rowWireChart(const SensorDesign& design, const ElectrodeDisplacements& displacements, int rowWire);

/// The same row-wire as it lies in the block, seen along y: before and under the load, displacements drawn larger.
ChartSpec rowWireShapeChart(const SensorDesign& design, const ElectrodeDisplacements& displacements, int rowWire);

/// The coloured quantity along the straight line between two points at rest; keeps what finds the line in the mesh.
class LinePlot {
public:
  /// A sentence instead of a title where the line leaves the block. `kept`: fields of the reference design at the
  /// mesh's nodes, drawn in addition; may be null.
  ChartSpec chart(const Mesh& mesh, const NodalFields& fields, const ViewSettings& view, const NodalFields* kept);
  /// The mesh it was found in is gone.
  void reset() { probe_.reset(); }

private:
  std::unique_ptr<PointProbe> probe_;
  std::array<std::array<double, 3>, 2> ends_{};
};

} // namespace palp
