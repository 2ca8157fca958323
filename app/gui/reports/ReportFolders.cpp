#include "app/gui/reports/ReportFolders.h"

#include "model/base/Error.h"

#include <QDir>
#include <QFileInfo>
#include <QLocale>
#include <QObject>
#include <QRegularExpression>

#include <algorithm>

namespace palp {

namespace {

constexpr const char* kTime = "yyyy-MM-dd-HHmmss";
constexpr int kMostOfOneSecond = 1000;

QString titleOf(const QString& name, const QDateTime& written) {
  static const QRegularExpression own(R"(^(.+)-(\d{4}-\d\d-\d\d-\d{6})(-\d+)?$)");
  const QRegularExpressionMatch match = own.match(name);
  const QDateTime run = match.hasMatch() ? QDateTime::fromString(match.captured(2), kTime) : QDateTime();
  const auto words = [](const QDateTime& time) { return QLocale().toString(time, "d MMM yyyy HH:mm"); };
  if (!run.isValid()) return QObject::tr("%1 (written %2)").arg(name, words(written));
  return QObject::tr("%1, %2").arg(match.captured(1), words(run));
}

} // namespace

QString newReportFolder(const QString& base, const QString& kind, const QDateTime& now) {
  QDir().mkpath(base); // whether it is there shows below
  const QString wanted = kind + "-" + now.toString(kTime);
  for (int k = 1; k < kMostOfOneSecond; ++k) {
    const QString name = k == 1 ? wanted : QString("%1-%2").arg(wanted).arg(k);
    if (QDir(base).mkdir(name)) return QDir(base).absoluteFilePath(name); // false where it is there
    if (!QFileInfo::exists(QDir(base).filePath(name))) break;
  }
  throw Error(QDir(base).absoluteFilePath(wanted).toStdString() +
              ": the folder cannot be made; choose another folder, one that may be written to");
}

std::vector<WrittenReport> reportsBelow(const QString& base) {
  QFileInfoList folders = QDir(base).entryInfoList(QDir::Dirs | QDir::NoDotAndDotDot);
  folders << QFileInfo(QDir(base).absolutePath());
  std::vector<WrittenReport> all;
  for (const QFileInfo& folder : folders) {
    const QFileInfo page(QDir(folder.filePath()).filePath("report.html"));
    if (page.isFile())
      all.push_back({folder.absoluteFilePath(), titleOf(folder.fileName(), page.lastModified()), page.lastModified()});
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.written > b.written; });
  return all;
}

QStringList writtenInto(const QString& folder) {
  QStringList written = QDir(folder).entryList(QDir::Files);
  written.removeAll(kReportDesign);
  return written;
}

void tidyReport(const QString& folder, const QString& messages) {
  if (folder.isEmpty()) return;
  QDir place(folder);
  if (writtenInto(folder).isEmpty()) {
    place.remove(kReportDesign);
    QDir().rmdir(folder);
    return;
  }
  QFile file(place.filePath(kReportMessages));
  if (file.open(QIODevice::WriteOnly)) file.write(messages.toUtf8());
}

} // namespace palp
