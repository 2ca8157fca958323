#include "app/gui/reports/ReportKinds.h"

#include "app/study/paper/PaperProtocol.h"

#include <QObject>

namespace palp {

namespace {

std::vector<ReportKind> allKinds() {
  std::vector<ReportKind> all{
      {QObject::tr("reproduce the paper"),
       {"reproduce", "all"},
       QObject::tr("Table 1, Fig. 12 and the figures of the paper from nothing, the printed numbers beside ours."),
       protocolParts(3.3)},
      {QObject::tr("reproduce Table 1"),
       {"reproduce", "table1"},
       QObject::tr("Errors from displacements at the paper's spreads, both modes and the linear baseline."),
       protocolParts(0.3)},
      {QObject::tr("reproduce Fig. 12"),
       {"reproduce", "fig12"},
       QObject::tr("Errors from resistances over the spread, both modes and the linear baseline."),
       protocolParts(3)}};
  for (const ReportComputation& report : reportComputations()) {
    QString what = QString::fromStdString(report.what);
    if (!what.isEmpty()) what[0] = what[0].toUpper();
    all.push_back(
        {QString::fromStdString(report.name), {"report", QString::fromStdString(report.name)}, what, report.parts});
  }
  return all;
}

} // namespace

const std::vector<ReportKind>& reportKinds() {
  static const std::vector<ReportKind> all = allKinds();
  return all;
}

} // namespace palp
