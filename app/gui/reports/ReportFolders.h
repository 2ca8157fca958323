#pragma once

#include <QDateTime>
#include <QString>

#include <vector>

namespace palp {

/// A report that lies in a folder of its own.
struct WrittenReport {
  QString folder;
  QString title; ///< its kind and when it was run, or the folder's name
  QDateTime written;
};

/// Makes a folder of a new report below `base`, named after its kind and the time: "networks-2026-11-22-140503". Never
/// one that was there before. Throws Error where it cannot be made.
QString newReportFolder(const QString& base, const QString& kind, const QDateTime& now);

/// The reports in the folders right below `base` and in `base` itself, the newest first.
std::vector<WrittenReport> reportsBelow(const QString& base);

} // namespace palp
