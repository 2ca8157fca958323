#pragma once

#include "app/gui/project/Project.h"
#include "app/study/reports/ReportComputations.h"
#include "io/StudyFile.h"

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
  std::vector<RunPart> fieldParts{}; ///< under the law of the field, where they are others
};

/// The argument of the kind that is a study; its time is not known before.
inline constexpr const char* kStudyKind = "study";

/// The paper's experiments, a study, then all kinds of `palp report`.
const std::vector<ReportKind>& reportKinds();

/// What the folders of its runs begin with.
QString runName(const ReportKind& kind);

/// Roughly how long a study takes on two cores [s].
double studySeconds(const StudyPlan& plan);
/// It makes samples of its own, as many on each area as the project has set.
bool drawsSamples(const ReportKind& kind);

/// What a report of the project runs, and for how long where it has not run here: as its law and number of samples
/// have it.
std::vector<RunPart> partsOf(const ReportKind& kind, const Project& project);

/// The row of the study in the list.
int studyIndex();

/// A report with these arguments needs the project's design: it is of it, and that is not the paper's.
bool ofAnotherDesign(const QStringList& arguments, const Project& project);

/// Under which the times of a run are kept: another number of samples, mesh or design takes another time.
QString settingsName(const QStringList& arguments, const Project& project);

} // namespace palp
