#pragma once

#include "app/gui/jobs/TouchResistances.h"
#include "model/LoadCase.h"
#include "model/RowColumnResistance.h"
#include "solver/SensorMesh.h"

#include <QString>

namespace palp {

/// What a table of results was computed from.
struct ResultSource {
  const SensorDesign& design;
  const LoadCase& load;
  double loadFraction = 1;
  MeshOptions mesh{};
  QString stale{}; ///< what has changed since, as text; empty: nothing
};

/// Load, mesh, design and whether they still hold, each line after a "#".
QString sourceLines(const ResultSource& source);

/// The displacements [mm] of both layers' electrodes: one table with commas, under lines with "#" that say load and
/// design. Lower ones that are held still have none.
QString electrodesCsv(const ResultSource& source, const ElectrodeDisplacements& displacements);

/// The resistances [ohm] at rest and under the load, in the same way.
QString resistancesCsv(const ResultSource& source, const TouchResistances& resistances);

/// Writes to a temporary file and renames it. Throws Error.
void writeText(const QString& file, const QString& text);

} // namespace palp
