#pragma once

#include <QString>

namespace palp {

/// What a file is, by what it says of itself.
enum class FileKind { Design, Project, Samples, Network, Recording, Study, Foreign };

/// Looks at the first lines alone; whether the rest is whole is for who reads it. Throws Error where it cannot be read.
FileKind fileKind(const QString& file);

/// Throws Error, which says what the file is, where it is of another kind than this; what may be a broken one passes:
/// its reader says where.
void requireKind(const QString& file, FileKind wanted);

/// A foreign file by what the system takes it for ("PNG image"), and what Palp can open.
QString foreignWords(const QString& file);

} // namespace palp
