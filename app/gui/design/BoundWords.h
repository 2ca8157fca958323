#pragma once

#include "app/gui/project/DesignStudies.h"
#include "app/study/reports/layout/DesignBounds.h"

#include <QString>

namespace palp {

BoundSummary summaryOf(const DesignBounds& bounds);

/// "1.20 / 0.97 / 1.24 %": equally many decimals, by the largest of the three, and "-" where there is no bound.
QString boundPercents(const Eigen::Vector3d& bound_percent);
/// The same in N: "0.024 / 0.019 / 0.074 N".
QString boundNewtons(const Eigen::Vector3d& bound_percent, const ForceRange& range);

/// The bounds of both designs, as a table in HTML.
QString boundTable(const QString& nameA, const BoundSummary& a, const QString& nameB, const BoundSummary& b);

} // namespace palp
