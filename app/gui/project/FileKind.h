#pragma once

#include <QString>
#include <QStringList>

namespace palp {

/// What a file is, by its content. A foreign one may be a table of measured data.
enum class FileKind { Design, Project, Samples, Network, Recording, Study, ImportMap, Foreign };

/// Looks at the first lines only; the reader checks the rest. Throws Error where it cannot be read.
FileKind fileKind(const QString& file);

/// Throws Error with the kind of the file where it is another than this; a broken file passes:
/// its reader reports where.
void requireKind(const QString& file, FileKind wanted);

/// Whether files are tables of measured data, one of them perhaps the map for importing them. Throws Error, with what
/// the file is, where a foreign one cannot be a table.
bool areTables(const QStringList& files);

/// A foreign file by what the system takes it for ("PNG image"), and what Palp can open.
QString foreignWords(const QString& file);

} // namespace palp
