#pragma once

#include "model/RowColumnResistance.h"

#include <QString>

namespace palp {

/// The upper electrodes' displacements [mm] and the resistances [ohm] at rest and under the load, as text with commas.
QString resultCsv(const SensorDesign& design, const ElectrodeDisplacements& displacements);

/// Written beside and renamed. Throws Error.
void writeResultCsv(const QString& file, const SensorDesign& design, const ElectrodeDisplacements& displacements);

} // namespace palp
