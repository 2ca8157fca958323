#include "app/gui/project/FileKind.h"

#include "io/ImportDraft.h"
#include "io/SampleFile.h"
#include "model/base/Error.h"

#include <QFile>
#include <QFileInfo>
#include <QMimeDatabase>
#include <QObject>

#include <array>

namespace palp {

namespace {

constexpr qint64 kLooked_bytes = 65536;

void requireTable(const QString& file) {
  const std::filesystem::path path = file.toStdString();
  if (const std::string why = whyNoTable(path); !why.empty()) throw Error(path.string() + ": " + why);
  if (QFileInfo(file).size() > 0 &&
      QMimeDatabase().mimeTypeForFile(file, QMimeDatabase::MatchContent).inherits("text/plain"))
    return;
  try {
    previewTable(path, {}, 0); // arrays, or text that the system does not take for it
  } catch (const Error&) {
    throw Error(foreignWords(file).toStdString());
  }
}

} // namespace

FileKind fileKind(const QString& file) {
  QFile source(file);
  if (QFileInfo(file).isDir()) throw Error(file.toStdString() + ": is a folder; expected a file");
  if (!source.open(QIODevice::ReadOnly))
    throw Error(file.toStdString() + ": cannot be read: " + source.errorString().toStdString());
  QByteArray head = source.read(kLooked_bytes);
  if (head.startsWith("PALPREC")) return FileKind::Recording;
  if (head.startsWith("# palp_samples")) return FileKind::Samples;
  if (head.startsWith("\x89HDF\r\n") || (head.startsWith("PK") && head.contains(".npy")))
    return hasSampleArrays(file.toStdString()) ? FileKind::Samples : FileKind::Foreign;
  if (head.startsWith('#')) return FileKind::Foreign; // a table that Palp wrote names its design, too
  // A project holds a design, as a study may: the outer key counts, which may come after all other keys.
  if (head.trimmed().startsWith('{')) head += source.readAll();
  constexpr std::array keys{
      std::pair{"\"palp_project\"", FileKind::Project}, std::pair{"\"palp_network\"", FileKind::Network},
      std::pair{"\"palp_study\"", FileKind::Study}, std::pair{"\"palp_import\"", FileKind::ImportMap},
      std::pair{"\"palp_design\"", FileKind::Design}};
  for (const auto& [key, kind] : keys)
    if (head.contains(key)) return kind;
  // It may be a broken file of Palp: its reader reports where.
  return head.trimmed().startsWith('{') ? FileKind::Project : FileKind::Foreign;
}

void requireKind(const QString& file, FileKind wanted) {
  constexpr std::array kWords{QT_TRANSLATE_NOOP("FileKind", "a design"),
                              QT_TRANSLATE_NOOP("FileKind", "a project"),
                              QT_TRANSLATE_NOOP("FileKind", "samples"),
                              QT_TRANSLATE_NOOP("FileKind", "a network"),
                              QT_TRANSLATE_NOOP("FileKind", "a recording"),
                              QT_TRANSLATE_NOOP("FileKind", "a study"),
                              QT_TRANSLATE_NOOP("FileKind", "a map for importing a table")};
  const FileKind kind = fileKind(file);
  if (kind == wanted || kind == FileKind::Project) return; // which may be broken JSON
  const QString asked = QObject::tr(kWords.at(static_cast<std::size_t>(wanted)));
  if (kind == FileKind::Foreign)
    throw Error(QObject::tr("%1: is neither %2 nor any other Palp file").arg(file, asked).toStdString());
  throw Error(QObject::tr("%1: is %2, not %3")
                  .arg(file, QObject::tr(kWords.at(static_cast<std::size_t>(kind))), asked)
                  .toStdString());
}

bool areTables(const QStringList& files) {
  int tables = 0, maps = 0;
  for (const QString& file : files) {
    const FileKind kind = fileKind(file);
    tables += kind == FileKind::Foreign ? 1 : 0;
    maps += kind == FileKind::ImportMap ? 1 : 0;
  }
  if (tables == 0 || maps > 1 || tables + maps < files.size()) return false;
  for (const QString& file : files)
    if (fileKind(file) == FileKind::Foreign) requireTable(file);
  return true;
}

QString foreignWords(const QString& file) {
  const QString type = QFileInfo(file).size() == 0
                           ? QObject::tr("empty")
                           : QMimeDatabase().mimeTypeForFile(file, QMimeDatabase::MatchContent).comment();
  return QObject::tr("%1: is not a Palp file (%2). Palp opens designs, projects, networks and studies (.json), samples "
                     "(.csv, .h5, .npz), recordings (.palprec), and tables of measured data (text, .npz, .h5, .mat).")
      .arg(file, type);
}

} // namespace palp
