#pragma once

#include "model/LoadCase.h"

#include <QString>

namespace palp {

/// The load of one design as it acts on another one that it is compared with: the same forces on the same load areas
/// and on discs of the same size, at the same shares of the sides of the block, for it is those points that are
/// compared. Throws Error where there is no such load.
LoadCase matchedLoad(const LoadCase& load, const SensorDesign& from, const SensorDesign& to);

/// Where a load presses: "area 1, a disc at (15, 15) mm".
QString pressedWords(const LoadCase& load);

/// Where both of two blocks are pressed; empty where they are of one size or nothing presses on a disc.
QString matchWords(const LoadCase& load, const SensorDesign& from, const SensorDesign& to);

} // namespace palp
