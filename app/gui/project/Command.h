#pragma once

#include "app/gui/project/Project.h"

#include <QString>

namespace palp {

/// The project's mesh as options, with a space before; empty for the default.
QString meshOption(const MeshOptions& mesh);

/// Commands that do on a terminal what the scene shows, one a line; the design is in the file named.
QString meshCommands(const Project& project, const QString& designFile);
/// The solve, and the picture of the block.
QString solveCommands(const Project& project, const QString& designFile);
QString networkCommands(const Project& project, const QString& designFile);
/// Its parts: samples for training and testing, one network in `file` and its predictions of the test, the sweep.
QString sampleCommands(const Project& project, const QString& designFile);
QString trainCommands(const NetworkSettings& network, const QString& designFile, const QString& file);
QString predictCommand(const NetworkSettings& network, const QString& file);
QString sweepCommand(const NetworkSettings& network);

QString liveCommand(const LiveSettings& live);

} // namespace palp
