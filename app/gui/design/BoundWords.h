#pragma once

#include "app/study/reports/layout/DesignBounds.h"

#include <QString>

namespace palp {

/// Fx / Fy / Fz in % of the force range, "-" where the resistances do not determine the force.
QString boundPercents(const Eigen::Vector3d& bound_percent);

/// Two columns of bounds as a table: a design and another one.
QString boundTable(const QString& nameA, const DesignBounds& a, const QString& nameB, const DesignBounds& b);

} // namespace palp
