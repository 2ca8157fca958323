#pragma once

#include "app/gui/reports/ReportRun.h"

#include <QDateTime>
#include <QString>
#include <QStringList>

#include <optional>
#include <vector>

namespace palp {

/// A report that lies in a folder of its own.
struct WrittenReport {
  QString folder;
  QString title; ///< its kind and when it was run, or the folder's name
  QDateTime written;
};

/// Makes a folder of a new report below `base`, named after its kind and the time: "networks-2026-11-22-140503". Never
/// an existing one. Throws Error where it cannot be made.
QString newReportFolder(const QString& base, const QString& kind, const QDateTime& now);

/// The kind in the folder's name, and the title of what lies there.
QString kindOfReport(const QString& folder);
QString titleOfReport(const QString& folder);

/// How long the newest run below `base` of this palp command took [s], but for its folders: from the time in its
/// folder's name to that of its page. None where there is no such run.
std::optional<double> lastRun_s(const QString& base, const QString& command);

/// The plan of a study in its folder.
inline constexpr const char* kStudyFile = "study.json";

/// Where the page of a run lies: of a study one folder deeper.
QString pageFolder(const QString& folder);

/// "3 of 9 designs are done; press Run to continue with the others."
QString studyState(const QString& folder, std::size_t designs);

/// The reports in the folders right below `base` and in `base` itself, studies that were stopped among them; the newest
/// first.
std::vector<WrittenReport> reportsBelow(const QString& base);

/// What a run adds to the report's folder: its messages, and the design that it is of.
inline constexpr const char* kReportMessages = "messages.txt";
inline constexpr const char* kReportDesign = "sensor.json";

/// The report's own files in the folder; of a study the designs that are done.
QStringList writtenInto(const QString& folder);

/// How a run that could be started ended.
QString endWords(ReportRun::Ending how, double seconds, int status, const QString& folder);

/// Keeps the messages next to the report; a folder without a report is deleted. Nothing where the folder
/// is not there or has no name.
void tidyReport(const QString& folder, const QString& messages);

} // namespace palp
