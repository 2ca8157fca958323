#pragma once

#include "model/SensorDesign.h"

#include <QString>

namespace palp {

/// Lines after a "#" that say what a table was made with: the palp commands of its scene that take `sensor.json`, the
/// design, and whether both still hold. Most programs that read tables can skip them. `stale`: why the
/// table is not of what is set now; empty where it is.
QString exportLines(const QString& commands, const SensorDesign& design, const QString& stale);

/// The last of these lines alone.
QString staleLine(const QString& stale);

} // namespace palp
