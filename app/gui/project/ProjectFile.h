#pragma once

#include "app/gui/project/Project.h"

#include <QByteArray>
#include <QString>

#include <filesystem>

namespace palp {

/// Settings of a training as in a project file, and read as strictly; `file` is for messages.
QByteArray networkText(const NetworkSettings& network);
NetworkSettings parseNetwork(const QByteArray& text, const QString& file);

/// Writes to a temporary file and renames it. Throws Error.
void saveProject(const std::filesystem::path& path, const Project& project);

/// The text of a project file.
QByteArray projectText(const Project& project);

/// A project file, or a design file: that one changes the design only and keeps the rest of `base`, less what cannot
/// act on it and what was calibrated. Reads strictly: throws Error with file, key, value and what is allowed.
Project loadProject(const std::filesystem::path& path, const Project& base);

/// The same from the file's text; `file` is the name that refusals show.
Project parseProject(const QByteArray& text, const QString& file, const Project& base);

} // namespace palp
