#pragma once

#include "app/gui/jobs/NetworkSession.h"

#include <QString>

namespace palp {

/// Three numbers and their unit: "1.2 / 3 / 0.5 %".
QString triple(const Eigen::VectorXd& values, const QString& unit);

/// Where a network comes from and how it was trained: "from displacements, rows 4, rbf, default, 600 centres".
QString originWords(const NetworkFit& fit);

/// Why the network that is shown does not belong to what is set now; empty where it does.
QString staleReason(const NetworkSession& session, const NetworkSettings& now);
/// The same for the points of the sweep.
QString staleSweepReason(const NetworkSession& session, const NetworkSettings& now);

/// The network that is shown and its error as rich text; grey with the reason where it is stale.
QString fitWords(const NetworkSession& session, const NetworkSettings& now);

} // namespace palp
