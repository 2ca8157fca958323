#include "app/gui/reports/ReportFolders.h"

#include "io/AtomicFile.h"
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

/// Kind and time in the name of a run's folder.
struct RunName {
  QString kind;
  QDateTime run; ///< not valid: a folder of another name
};

RunName runOf(const QString& name) {
  static const QRegularExpression own(R"(^(.+)-(\d{4}-\d\d-\d\d-\d{6})(-\d+)?$)");
  const QRegularExpressionMatch match = own.match(name);
  if (!match.hasMatch()) return {};
  return {match.captured(1), QDateTime::fromString(match.captured(2), kTime)};
}

/// The folder of the run whose page lies here: of a study one above.
QFileInfo runFolderOf(const QString& folder) {
  const QFileInfo here(folder), above(here.absolutePath());
  return here.fileName() == "report" && runOf(above.fileName()).run.isValid() ? above : here;
}

/// A run's command without its folders, and whether it is of another design than the paper's.
QString settingsOf(const QString& command) {
  return command.section(" -o ", 0, 0) + (command.section(" -o ", 1).contains(" --design ") ? " --design" : "");
}

/// The first line of its messages.
QString commandOf(const QString& folder) {
  QFile messages(QDir(folder).filePath(kReportMessages));
  return messages.open(QIODevice::ReadOnly) ? QString::fromUtf8(messages.readLine()).trimmed() : QString();
}

/// What distinguishes runs of a kind: how many samples, and another design than the paper's.
QString settingsWords(const QString& folder) {
  static const QRegularExpression drawn(
      R"(^palp report (?:noise|networks|error-time|scenes|layout) .*--per-area (\d+))");
  const QString command = commandOf(folder);
  QString words;
  if (const auto match = drawn.match(command); match.hasMatch())
    words += QObject::tr(", %1 samples per area").arg(match.captured(1));
  if (command.contains(" --design ")) words += QObject::tr(", another design");
  return words;
}

QString titleOf(const QFileInfo& folder, const QDateTime& written) {
  const auto [kind, run] = runOf(folder.fileName());
  const auto words = [](const QDateTime& time) { return QLocale().toString(time, "d MMM yyyy HH:mm"); };
  if (!run.isValid()) return QObject::tr("%1 (written %2)").arg(folder.fileName(), words(written));
  return QObject::tr("%1, %2").arg(kind, words(run)) + settingsWords(folder.filePath());
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
              ": the folder cannot be created; choose another folder with write permission");
}

std::vector<WrittenReport> reportsBelow(const QString& base) {
  QFileInfoList folders = QDir(base).entryInfoList(QDir::Dirs | QDir::NoDotAndDotDot);
  folders << QFileInfo(QDir(base).absolutePath());
  std::vector<WrittenReport> all;
  for (const QFileInfo& folder : folders) {
    const QFileInfo page(QDir(pageFolder(folder.filePath())).filePath("report.html"));
    const QFileInfo study(QDir(folder.filePath()).filePath(kStudyFile));
    if (page.isFile())
      all.push_back({page.absolutePath(), titleOf(folder, page.lastModified()), page.lastModified()});
    else if (study.isFile())
      all.push_back({folder.absoluteFilePath(), QObject::tr("%1: stopped").arg(titleOf(folder, study.lastModified())),
                     study.lastModified()});
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.written > b.written; });
  return all;
}

QString kindOfReport(const QString& folder) {
  return runOf(runFolderOf(folder).fileName()).kind;
}

QString titleOfReport(const QString& folder) {
  const QFileInfo page(QDir(folder).filePath("report.html"));
  return titleOf(runFolderOf(folder), page.lastModified());
}

std::optional<double> lastRun_s(const QString& base, const QString& command) {
  for (const WrittenReport& report : reportsBelow(base)) {
    const QFileInfo folder = runFolderOf(report.folder);
    const QDateTime run = runOf(folder.fileName()).run;
    if (!run.isValid() || settingsOf(commandOf(folder.filePath())) != settingsOf(command)) continue;
    const auto seconds = static_cast<double>(run.secsTo(report.written));
    if (seconds >= 0) return std::max(seconds, 0.5); // the name has integer seconds
  }
  return std::nullopt;
}

QString pageFolder(const QString& folder) {
  const QString inside = QDir(folder).filePath("report");
  return QFileInfo::exists(QDir(inside).filePath("report.html")) ? inside : folder;
}

QString studyState(const QString& folder, std::size_t designs) {
  const qsizetype done = QDir(QDir(folder).filePath("rows")).entryList({"*.csv"}, QDir::Files).size();
  return QObject::tr("%1 of %2 designs are done; press Run to continue with the others.").arg(done).arg(designs);
}

QStringList writtenInto(const QString& folder) {
  QStringList written = QDir(folder).entryList(QDir::Files);
  written.removeAll(kReportDesign);
  written.removeAll(kStudyFile);
  return written << QDir(QDir(folder).filePath("rows")).entryList({"*.csv"}, QDir::Files);
}

QString endWords(ReportRun::Ending how, double seconds, int status, const QString& folder) {
  const QString time = QString::number(seconds, 'f', 1);
  const qsizetype written = writtenInto(folder).size();
  switch (how) {
  case ReportRun::Ending::Done:
    return QObject::tr("Done in %1 s: %2").arg(time, QDir(pageFolder(folder)).filePath("report.html"));
  case ReportRun::Ending::Cancelled:
    if (written == 0) return QObject::tr("Cancelled after %1 s; nothing was written.").arg(time);
    if (QFileInfo::exists(QDir(folder).filePath(kStudyFile)))
      return QObject::tr("Cancelled after %1 s; %2 designs are done, press Run to continue with the others.")
          .arg(time)
          .arg(written);
    return QObject::tr("Cancelled after %1 s; %2 of the report's files were already written to %3.")
        .arg(time, QString::number(written), folder);
  case ReportRun::Ending::NoResult:
    return QObject::tr("Ended without a result after %1 s; see the messages.").arg(time);
  case ReportRun::Ending::Failed:
    return QObject::tr("Failed with status %1; see the messages.").arg(status);
  case ReportRun::Ending::NotStarted:
    return QObject::tr("Could not be started.");
  }
  return {};
}

void tidyReport(const QString& folder, const QString& messages) {
  if (folder.isEmpty()) return;
  QDir place(folder);
  if (writtenInto(folder).isEmpty()) {
    for (const char* ours : {kReportDesign, kStudyFile}) place.remove(ours);
    place.rmdir("rows");
    QDir().rmdir(folder);
    return;
  }
  try {
    writeFile(place.filePath(kReportMessages).toStdString(), messages.toStdString(), true);
  } catch (const Error&) { // of a full disk, which the report has met before; the window shows them all the same
  }
}

} // namespace palp
