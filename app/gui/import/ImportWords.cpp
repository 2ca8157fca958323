#include "app/gui/import/ImportWords.h"

#include "app/gui/import/OpenedTables.h"
#include "io/ImportSamples.h"

#include <QLocale>
#include <QObject>
#include <QStringList>

#include <algorithm>

namespace palp {

namespace {

constexpr qsizetype kLineShown = 60;
constexpr std::size_t kArraysShown = 6, kRecordingsShown = 3;

QString words(const std::string& text) {
  return QString::fromStdString(text);
}

QString arraysWords(const TablePreview& table) {
  QStringList all;
  for (const TablePreview::Array& array : table.arrays) {
    if (static_cast<std::size_t>(all.size()) == kArraysShown) {
      all << "...";
      break;
    }
    all << QObject::tr("%1 (%2 rows x %3)").arg(words(array.name)).arg(array.rows).arg(array.columns);
  }
  return QObject::tr("arrays %1").arg(all.join(", "));
}

QString tableWords(const TablePreview& table) {
  QString line =
      QString("%1: %2; ")
          .arg(words(table.file.filename().string()), table.arrays.empty() ? words(table.form) : arraysWords(table)) +
      QObject::tr("%1 columns").arg(table.columns.size());
  if (table.before.empty()) return line;
  return line + QObject::tr("; above the table: \"%1\"").arg(words(table.before.front()).trimmed().left(kLineShown));
}

void addList(QStringList& all, const QString& title, const std::vector<std::string>& sentences) {
  if (sentences.empty()) return;
  all << title;
  for (const std::string& sentence : sentences) all << "- " + words(sentence);
  all << "";
}

} // namespace

QString tablesWords(const OpenedTables& opened) {
  QStringList lines;
  for (const TablePreview& table : opened.tables) lines << tableWords(table);
  if (opened.recordings() < 2) return lines.join('\n');
  QStringList others;
  for (std::size_t k = opened.tables.size(); k < opened.files.size(); k += opened.tables.size()) {
    if (static_cast<std::size_t>(others.size()) == kRecordingsShown) {
      others << "...";
      break;
    }
    others << words(opened.files[k].filename().string());
  }
  return (lines << QObject::tr("%1 recordings, one after the other; the others begin with %2")
                       .arg(opened.recordings())
                       .arg(others.join(", ")))
      .join('\n');
}

QString verdictWords(const OpenedTables& opened, const Imported* result) {
  QStringList all;
  if (result != nullptr) {
    std::vector<std::string> warnings = result->warnings;
    if (!result->constant.empty()) warnings.push_back(result->constant);
    addList(all, QObject::tr("Please check:"), warnings);
    QString found = QObject::tr("%1 samples").arg(result->samples);
    if (result->runs > 1) found += QObject::tr(" in %1 runs").arg(result->runs);
    if (result->leftOut > 0) found += QObject::tr("; %1 rows left out").arg(result->leftOut);
    all << found + QObject::tr("; %1 columns not used.").arg(result->unusedColumns) << "";
  }
  addList(all, opened.map.empty() ? QObject::tr("Assumed from the names of the columns:") : QObject::tr("From"),
          opened.assumed);
  if (result != nullptr) addList(all, QObject::tr("Found in the table:"), result->notes);
  return all.join('\n').trimmed();
}

} // namespace palp
