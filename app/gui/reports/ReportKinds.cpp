#include "app/gui/reports/ReportKinds.h"

#include "app/gui/project/Command.h"
#include "app/study/paper/PaperProtocol.h"
#include "io/DesignFile.h"

#include <QObject>

#include <algorithm>

namespace palp {

namespace {

constexpr qsizetype kNameOfDesign = 8; // characters of its fingerprint
constexpr double kSamples = 100;       // on each area, for which the times of RunPart hold

std::vector<ReportKind> allKinds() {
  std::vector<ReportKind> all{
      {QObject::tr("Reproduce the paper"),
       {"reproduce", "all"},
       QObject::tr("Table 1, Fig. 12 and the figures of the paper from scratch, compared with the printed numbers."),
       protocolParts(3.3)},
      {QObject::tr("Reproduce Table 1"),
       {"reproduce", "table1"},
       QObject::tr("Errors from displacements at the paper's spreads, both modes and the linear baseline."),
       protocolParts(0.3)},
      {QObject::tr("Reproduce Fig. 12"),
       {"reproduce", "fig12"},
       QObject::tr("Errors from resistances over the spread, both modes and the linear baseline."),
       protocolParts(3)},
      {QObject::tr("Study of many designs"),
       {kStudyKind},
       QObject::tr("Varies parameters of the design: one table with a row per design, the best designs, and a chart of "
                   "each result over each parameter. A cancelled study can be continued."),
       {{"all designs", 1, 60}}}};
  for (const ReportComputation& report : reportComputations()) {
    if (report.name == "scenes") continue; // a check of the program itself
    QString title = QString::fromStdString(report.name), what = QString::fromStdString(report.what);
    for (QString* text : {&title, &what})
      if (!text->isEmpty()) text->front() = text->front().toUpper();
    if (report.name == "networks")
      what += QObject::tr(": the design's law must be the conduction field (Design scene).");
    all.push_back({title, {"report", QString::fromStdString(report.name)}, what, report.parts, report.fieldParts});
  }
  return all;
}

} // namespace

const std::vector<ReportKind>& reportKinds() {
  static const std::vector<ReportKind> all = allKinds();
  return all;
}

QString runName(const ReportKind& kind) {
  return kind.arguments.back() == "all" ? "paper" : kind.arguments.back();
}

bool drawsSamples(const ReportKind& kind) {
  static const QStringList drawing{"noise", "networks", "error-time", "layout"};
  return kind.arguments.front() == "report" && drawing.contains(kind.arguments.back());
}

std::vector<RunPart> partsOf(const ReportKind& kind, const Project& project) {
  const bool field = kind.arguments.front() == "report" && project.design.field() != nullptr;
  std::vector<RunPart> parts = field && !kind.fieldParts.empty() ? kind.fieldParts : kind.parts;
  for (RunPart& part : parts) part.seconds *= 1 - part.drawn + part.drawn * project.view.reportPerArea / kSamples;
  return parts;
}

double studySeconds(const StudyPlan& plan) {
  // As measured on the paper's design: under Eq. (1) a bound is 42 nonlinear solves, samples of decoders many more.
  const double mesh = plan.meshSize_mm || plan.mapped ? 0.03 : 1; // of other meshes, which are coarse
  const bool field = parseDesign(plan.design, "study").field() != nullptr;
  double seconds = 0.2;
  if (plan.computes(StudyQuantity::Bound)) seconds += field ? 2 : 20 * mesh;
  if (plan.computes(StudyQuantity::Decoders)) seconds += 2 + 0.15 * plan.perArea * mesh;
  if (plan.computes(StudyQuantity::Displacement) || plan.computes(StudyQuantity::Error)) seconds += 1.2 * mesh;
  return seconds * static_cast<double>(plan.designs());
}

int studyIndex() {
  const auto found = std::find_if(reportKinds().begin(), reportKinds().end(),
                                  [](const ReportKind& kind) { return kind.arguments.front() == kStudyKind; });
  return static_cast<int>(found - reportKinds().begin());
}

bool ofAnotherDesign(const QStringList& arguments, const Project& project) {
  return arguments.front() == "report" && project.design != paperDesign();
}

QString settingsName(const QStringList& arguments, const Project& project) {
  QStringList words = arguments;
  words << QString::number(project.view.reportPerArea) << meshOption(project.mesh).split(' ', Qt::SkipEmptyParts);
  if (ofAnotherDesign(arguments, project))
    words << QString::fromStdString(designFingerprint(project.design)).left(kNameOfDesign);
  return words.join('-');
}

} // namespace palp
