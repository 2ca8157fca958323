#pragma once

#include "app/study/reports/ReportComputations.h"

#include <QString>
#include <QStringList>

#include <vector>

namespace palp {

/// A report as the window offers it.
struct ReportKind {
  QString title;
  QStringList arguments; ///< of palp
  QString what;
  std::vector<RunPart> parts;
};

/// The paper's experiments, then all kinds of `palp report`.
const std::vector<ReportKind>& reportKinds();

} // namespace palp
