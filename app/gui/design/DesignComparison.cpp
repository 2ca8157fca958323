#include "app/gui/design/DesignComparison.h"

#include "app/gui/design/BoundWords.h"
#include "app/gui/design/RestFloor.h"
#include "app/gui/jobs/TouchResistances.h"
#include "app/gui/views/HeatmapSpecs.h"
#include "app/gui/views/HeatmapView.h"
#include "app/study/touch/Touch.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include <array>

namespace palp {

namespace {

constexpr int kSideWidth_px = 420;

/// A design under a load.
struct Answer {
  double largest_mm = 0;                    ///< displacement
  Eigen::MatrixXd change;                   ///< dR / R at rest [%]; empty where the law has none
  std::optional<Eigen::Matrix3Xd> upper_mm; ///< displacements of the upper electrodes
  QString noChange;                         ///< why that is
  QString problem;                          ///< why there is no answer
};

Answer answerOf(const SensorDesign& design, const LoadCase& load, const MeshOptions& mesh,
                const std::stop_token& stop) {
  Answer answer;
  if (const auto wrong = whyInvalid(load, design)) {
    answer.problem = QString::fromStdString(*wrong);
    return answer;
  }
  Touch touch(design, load, mesh);
  const bool good = touch.advance(Stage::Displacements, {}, {.step = {}, .stop = stop});
  if (stop.stop_requested()) return answer;
  if (!good) {
    answer.problem = QString::fromStdString(touch.solution()->stopReason);
    return answer;
  }
  answer.largest_mm = touch.solution()->state().displacements_mm.colwise().norm().maxCoeff();
  if (const auto resistances = resistancesOf(design, *touch.displacements()))
    answer.change = 100 * (resistances->now_ohm - resistances->rest_ohm).cwiseQuotient(resistances->rest_ohm);
  answer.noChange = whyNoResistances(design);
  answer.upper_mm = touch.displacements()->upper_mm;
  return answer;
}

QString answerWords(const Answer& kept, const Answer& now) {
  for (const auto& [answer, name] :
       {std::pair{&kept, QObject::tr("The kept design")}, std::pair{&now, QObject::tr("This design")}})
    if (!answer->problem.isEmpty()) return QObject::tr("%1 cannot bear the load: %2.").arg(name, answer->problem);
  QString words = QObject::tr("Largest displacement: kept design %1 mm, this design %2 mm.")
                      .arg(QString::number(kept.largest_mm, 'g', 4), QString::number(now.largest_mm, 'g', 4));
  if (kept.upper_mm->cols() == now.upper_mm->cols())
    words += QObject::tr("<br>Ways of the upper electrodes differ by up to %1 mm.")
                 .arg((*now.upper_mm - *kept.upper_mm).colwise().norm().maxCoeff(), 0, 'g', 4);
  if (const QString why = kept.noChange.isEmpty() ? now.noChange : kept.noChange; !why.isEmpty())
    words += "<br>" + why;
  else if (kept.change.rows() != now.change.rows() || kept.change.cols() != now.change.cols())
    words += QObject::tr("<br>They have other numbers of wires: their resistances are not compared cell by cell.");
  return words;
}

} // namespace

DesignComparison::DesignComparison(Workbench& workbench, QWidget* parent) : QWidget(parent), workbench_(workbench) {
  auto* row = new QHBoxLayout(this);
  auto* side = new QWidget;
  side->setFixedWidth(kSideWidth_px);
  auto* column = new QVBoxLayout(side);
  column->setContentsMargins(0, 0, 0, 0);
  auto* buttons = new QHBoxLayout;
  keep_ = new QPushButton(tr("Keep this design"));
  keep_->setObjectName("keepDesign");
  keep_->setToolTip(tr("Remembers the design as it is now, to compare later ones with it; the project keeps it"));
  compare_ = new QPushButton(tr("Compare"));
  compare_->setObjectName("compareDesigns");
  compare_->setToolTip(tr("Solves both designs under the load and bounds the errors of both; Esc stops it"));
  back_ = new QPushButton(tr("Go back to it"));
  back_->setObjectName("takeKept");
  back_->setToolTip(tr("Makes the kept design the design again; can be undone"));
  for (QPushButton* button : {keep_, compare_, back_}) buttons->addWidget(button);
  column->addLayout(buttons);
  fields_ = new QPushButton(tr("Show the difference of the fields"));
  fields_->setObjectName("keptFields");
  fields_->setToolTip(tr("On the Deformation scene: this design less the kept one, in the colours of the block"));
  column->addWidget(fields_);
  stale_ = new QLabel;
  stale_->setObjectName("comparisonState");
  stale_->setProperty("role", "hint");
  words_ = new QLabel;
  words_->setObjectName("comparison");
  for (QLabel* label : {stale_, words_}) {
    label->setWordWrap(true);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    column->addWidget(label);
  }
  column->addStretch(1);
  row->addWidget(side);
  difference_ = new HeatmapView;
  difference_->setObjectName("comparisonMap");
  difference_->hide();
  row->addWidget(difference_, 1);
  row->addStretch(); // beside the words alone
  connect(keep_, &QPushButton::clicked, this, &DesignComparison::keep);
  connect(compare_, &QPushButton::clicked, this, &DesignComparison::compare);
  connect(back_, &QPushButton::clicked, this, &DesignComparison::goBack);
  connect(fields_, &QPushButton::clicked, this, &DesignComparison::showFields);
  connect(&runner_, &JobRunner::failed, words_, &QLabel::setText);
  connect(&runner_, &JobRunner::started, this, &DesignComparison::displayProject);
  connect(&runner_, &JobRunner::finished, this, &DesignComparison::displayProject);
  displayProject();
}

void DesignComparison::setTheme(Theme theme) {
  difference_->setTheme(theme);
}

void DesignComparison::keep() {
  Project next = workbench_.project();
  next.kept = next.design;
  workbench_.closeEntry();
  workbench_.edit(tr("Keep this design"), next);
}

void DesignComparison::goBack() {
  Project next = workbench_.project();
  next.design = *next.kept;
  std::erase_if(next.load.areas, [&](const AreaLoad& load) { return load.area >= next.design.areas.count(); });
  std::erase_if(next.load.patches, [&](const PatchLoad& disc) { return whyInvalid({{}, {disc}}, next.design); });
  workbench_.closeEntry();
  workbench_.edit(tr("Go back to the kept design"), next);
}

void DesignComparison::showFields() {
  Project next = workbench_.project();
  if (!next.view.lessKept) next.view.colorRange.reset();
  next.view.lessKept = true;
  workbench_.edit(tr("Show the difference of the fields"), next);
  emit fieldsAsked();
}

void DesignComparison::displayProject() {
  const SensorDesign& design = workbench_.project().design;
  const std::optional<SensorDesign>& kept = workbench_.project().kept;
  const bool other = kept && *kept != design;
  compare_->setEnabled(other);
  back_->setEnabled(other);
  fields_->setEnabled(other);
  if (!kept)
    stale_->setText(tr("Keep a design, change it, and compare. Was it changed already: undo, keep, redo."));
  else if (!other)
    stale_->setText(tr("This is the kept design: change something to compare."));
  else
    stale_->setText(compared_ && *compared_ != std::array{*kept, design} ? tr("This compares other designs than these.")
                                                                         : QString());
  stale_->setVisible(!stale_->text().isEmpty());
}

void DesignComparison::compare() {
  const Project& project = workbench_.project();
  words_->setText(tr("Being computed..."));
  difference_->hide();
  runner_.start(
      tr("Comparing two designs"),
      [this, kept = *project.kept, now = project.design, load = project.load, mesh = project.mesh,
       noise = project.view.resistanceNoise](const std::stop_token& stop, JobProgress& progress) -> JobRunner::Taking {
        progress.set(0.02, "Solving both under the load");
        const Answer keptAnswer = answerOf(kept, load, mesh, stop), nowAnswer = answerOf(now, load, mesh, stop);
        if (stop.stop_requested()) return {};
        std::array<std::optional<DesignBounds>, 2> bounds;
        const bool atRest = kept.field() != nullptr || now.field() != nullptr; // where the field is known
        std::shared_ptr<const RestFloor> floor;
        for (std::size_t k = 0; k < 2; ++k) {
          const auto part = [&](double share, const std::string& what) {
            progress.set(0.1 + 0.45 * (static_cast<double>(k) + share), what);
          };
          if (atRest) {
            floor = restFloor(k == 0 ? kept : now, mesh, floor, part, stop);
            if (floor) bounds[k] = boundsAtRest(*floor, noise);
          } else {
            bounds[k] = designBounds(k == 0 ? kept : now, mesh, noise, part, stop);
          }
          if (!bounds[k]) return {};
        }
        return [this, kept, now, keptAnswer, nowAnswer, atRest, keptBounds = *bounds[0], nowBounds = *bounds[1]] {
          compared_ = {kept, now};
          words_->setText((atRest ? tr("Both at rest. ") : QString()) +
                          boundTable(tr("kept"), keptBounds, tr("this design"), nowBounds) +
                          answerWords(keptAnswer, nowAnswer));
          const bool same = keptAnswer.change.rows() == nowAnswer.change.rows() &&
                            keptAnswer.change.cols() == nowAnswer.change.cols() && nowAnswer.change.size() > 0;
          difference_->setVisible(same);
          if (same) difference_->setHeatmap(heatmapLessKept(nowAnswer.change, keptAnswer.change));
          displayProject();
        };
      });
}

} // namespace palp
