#pragma once

#include <QString>

namespace palp {

/// What a file is, by its content.
enum class FileKind { Design, Project, Samples, Network, Recording, Study, Foreign };

/// Looks at the first lines only; the reader checks the rest. Throws Error where it cannot be read.
FileKind fileKind(const QString& file);

/// Throws Error with the kind of the file where it is another than this; a broken file passes:
/// its reader reports where.
void requireKind(const QString& file, FileKind wanted);

/// A foreign file by what the system takes it for ("PNG image"), and what Palp can open.
QString foreignWords(const QString& file);

} // namespace palp
