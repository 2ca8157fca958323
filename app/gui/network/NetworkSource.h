#pragma once

#include "app/gui/jobs/NetworkSession.h"

#include <QString>

namespace palp {

/// Lines for a file of the Network scene (exportLines): the palp commands that made the numbers of this chart or table,
/// with the settings of its own run, and why these numbers are not of what is set now. `saved`: its object name.
QString networkSource(const QString& saved, const Project& now, const NetworkSession& session);

/// Commands that make the samples, the network and the sweep that are shown; those of the fields where
/// there is no network.
QString commandsOfShown(const Project& now, const NetworkSession& session, const QString& designFile);

} // namespace palp
