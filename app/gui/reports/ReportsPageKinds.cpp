#include "app/gui/reports/ReportsPage.h"

#include "app/gui/jobs/TimeLeft.h"
#include "app/gui/project/Command.h"
#include "app/gui/reports/ReportCases.h"
#include "app/gui/reports/ReportKinds.h"
#include "app/gui/reports/StudyForm.h"
#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/SpinBoxes.h"
#include "model/base/Error.h"

#include <QComboBox>
#include <QDir>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QTabWidget>

namespace palp {

const ReportKind& ReportsPage::kind() const {
  return reportKinds()[static_cast<std::size_t>(kind_->currentIndex())];
}

bool ReportsPage::isStudy() const {
  return kind().arguments.front() == kStudyKind;
}

QStringList ReportsPage::arguments(const Project& project, const QString& folder) const {
  QStringList all = kind().arguments;
  if (isStudy()) return all << QDir(folder).filePath(kStudyFile) << "-o" << folder; // its file has the rest
  if (all.front() == "report") all << "--per-area" << QString::number(project.view.reportPerArea);
  return all + meshOption(project.mesh).split(' ', Qt::SkipEmptyParts) + QStringList{"-o", folder};
}

QStringList ReportsPage::runArguments(const QString& folder) const {
  QStringList all = arguments(workbench_.project(), folder);
  if (!isStudy()) all << "--force"; // into the folder that was made just now
  if (ofAnotherDesign(all, workbench_.project())) all << "--design" << QDir(folder).filePath(kReportDesign);
  return all;
}

QString ReportsPage::commands(const Project& project, const QString& designFile) const {
  QStringList all = arguments(project, "palp-report");
  if (ofAnotherDesign(all, project)) all << "--design" << designFile;
  return "palp " + all.join(' ');
}

/// How many, where a report draws samples.
void ReportsPage::buildSamplesBox() {
  perArea_ = wholeBox("reportPerArea", {.low = 5, .high = 100000}, {});
  perArea_->setCorrectionMode(QAbstractSpinBox::CorrectToNearestValue); // 1 is 5, not what it was
  perArea_->setPrefix(tr("Samples per area: "));
  perArea_->setToolTip(tr("Number of random forces on each area that the report generates; 5 or more"));
  connect(perArea_, &QSpinBox::valueChanged, this, [this](int perArea) {
    workbench_.edit(tr("Change the samples of a report"), [&](Project& next) { next.view.reportPerArea = perArea; });
    chooseKind(); // its time
  });
}

/// What it runs, and for how long.
void ReportsPage::chooseKind() {
  if (run_.running()) return; // what runs stays in sight
  what_->setText(kind().what);
  study_->setVisible(isStudy());
  const QSignalBlocker quiet(perArea_);
  perArea_->setValue(workbench_.project().view.reportPerArea);
  perArea_->setVisible(drawsSamples(kind()));
  tabs_->setCurrentWidget(cases_);
  if (isStudy()) return planStudy();
  planned_ = settingsName(kind().arguments, workbench_.project());
  plan_ = std::make_unique<ReportPlan>(planned_, partsOf(kind(), workbench_.project()));
  const auto last_s =
      plan_->measuredHere() ? std::nullopt : lastRun_s(base(), "palp " + runArguments(base()).join(' '));
  if (last_s) plan_->setSeconds(*last_s); // its report lies in the list
  cases_->show(*plan_);
  state_->setText(tr("Takes about %1%2.")
                      .arg(roughly(plan_->seconds()), plan_->measuredHere()
                                                          ? tr(", as in the last run on this machine")
                                                          : tr(" (estimate; never run here with these settings)")));
}

/// Another design or law since: what a report runs, and for how long, is other too.
void ReportsPage::planAgain() {
  if (!isVisible() || run_.running() || isStudy()) return;
  if (settingsName(kind().arguments, workbench_.project()) != planned_) chooseKind();
}

/// How much a study is; its time is known only roughly before.
void ReportsPage::planStudy() {
  std::vector<RunPart> parts{kind().parts};
  try {
    const StudyPlan study = study_->plan();
    parts.front().seconds = studySeconds(study);
    state_->setText(tr("%1 designs, about %2 (a better estimate follows after the first).")
                        .arg(study.designs())
                        .arg(roughly(parts.front().seconds)));
    start_->setEnabled(true);
  } catch (const Error&) {
    state_->setText(tr("No study yet: see the error above.")); // shown by the form
    start_->setEnabled(false);
  }
  plan_ = std::make_unique<ReportPlan>(kStudyKind, parts);
  cases_->show(*plan_);
}

/// The text above it is for its kind, where that is known.
void ReportsPage::chooseKindOf(const QString& folder) {
  const QString wanted = kindOfReport(folder);
  QWidget* tab = tabs_->currentWidget();
  for (std::size_t k = 0; k < reportKinds().size(); ++k)
    if (runName(reportKinds()[k]) == wanted) kind_->setCurrentIndex(static_cast<int>(k));
  tabs_->setCurrentWidget(tab);
}

} // namespace palp
