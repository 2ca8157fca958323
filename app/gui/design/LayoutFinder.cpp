#include "app/gui/design/LayoutFinder.h"

#include "app/gui/design/BoundWords.h"
#include "app/gui/design/DesignFields.h"
#include "app/gui/design/ProgressWords.h"
#include "app/gui/jobs/TimeLeft.h"
#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/Markup.h"
#include "app/study/reports/layout/LayoutSearch.h"

#include <QComboBox>
#include <QElapsedTimer>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace palp {

namespace {

constexpr double kResponseShare = 0.7; ///< of the time, that the block's response takes

QString intention() {
  return QObject::tr(
      "The block's response is solved once per load area. Hundreds of layouts that can be built are then evaluated "
      "from it: at least 1 mm between electrodes, and 0.5 mm of rubber around, above, below and between the layers.");
}

} // namespace

LayoutFinder::LayoutFinder(Workbench& workbench, QWidget* parent) : QWidget(parent), workbench_(workbench) {
  auto* column = new QVBoxLayout(this);
  auto* row = new QHBoxLayout;
  freedom_ = choiceBox("layoutFreedom", {tr("Same positions on every wire"), tr("Positions per wire")},
                       tr("Electrodes slide along their wires in steps of 0.05 mm and layers change their height, with "
                          "at least 1 mm between electrodes and 0.5 mm of rubber around them"));
  search_ = pushButton(
      tr("Find a better layout"), "findLayout",
      tr("Lowers the noise floor of the middle row-wire or, with the conduction field, of all row-wires; Esc cancels"));
  takeOver_ = pushButton(tr("Use this layout"), "takeLayout",
                         tr("Makes the found layout the current design; this can be undone"));
  takeOver_->setEnabled(false);
  addTo(*row, {freedom_, search_, takeOver_, Part::stretch()});
  column->addLayout(row);
  words_ = markupLabel(intention());
  words_->setObjectName("layoutWords");
  words_->setWordWrap(true);
  words_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  column->addWidget(words_);
  column->addStretch(1);
  connect(search_, &QPushButton::clicked, this, &LayoutFinder::search);
  connect(takeOver_, &QPushButton::clicked, this, &LayoutFinder::takeOver);
  showProgress(runner_, *words_);
  connect(&runner_, &JobRunner::failed, this, [this](const QString& sentence) { showWords(*words_, sentence); });
  connect(&runner_, &JobRunner::started, this, &LayoutFinder::displayProject);
  connect(&runner_, &JobRunner::finished, this, [this](bool cancelled) {
    if (cancelled) shown_.reset(); // what was found before is shown again
    displayProject();
    if (!cancelled) return;
    const QString before = shown_ ? tr(" Found earlier:<br>") + words_->text() : QString();
    words_->setText(tr("Cancelled; nothing was changed.") + before);
  });
  connect(&workbench_, &Workbench::projectReplaced, this, [this] {
    if (runner_.running()) runner_.cancel();
  }); // of the other project
}

namespace {

/// What is otherwise in a layout, a line a number.
QString layoutWords(const SensorDesign& before, const SensorDesign& after) {
  QString words = "<table>";
  for (const DesignField& field : designFields()) {
    const QString from = field.text(before), to = field.text(after);
    if (from == to) continue;
    words += QString("<tr><td>%1, %2&nbsp;&nbsp;</td><td>%3 &rarr; <b>%4</b> %5</td></tr>")
                 .arg(field.group, field.label, asWritten(from), asWritten(to), field.unit);
  }
  return words + "</table>";
}

} // namespace

void LayoutFinder::search() {
  const Project& project = workbench_.project();
  const bool same = freedom_->currentIndex() == 0;
  takeOver_->setEnabled(false);
  words_->setText(tr("Searching..."));
  runner_.start(
      tr("Finding a better layout"),
      [this, same, design = project.design, mesh = project.mesh,
       noise = project.view.resistanceNoise](const std::stop_token& stop, JobProgress& progress) -> JobRunner::Taking {
        StageLog stages;
        QElapsedTimer clock;
        clock.start();
        TimeLeft left;
        left.begin(0, 0);
        const auto report = [&](double share, const std::string& what) {
          const double now_s = 1e-3 * static_cast<double>(clock.elapsed());
          progress.set(share, what + (share < 0.05 ? std::string() : leftInWords(left.left_s(share, 1, now_s))));
        };
        const auto response = AreaResponse::solve(
            design, mesh, 0, stages,
            [&](double share, const std::string& what) { report(kResponseShare * share, what); }, stop);
        if (!response) return {};
        left = {}; // the search has a pace of its own
        left.begin(kResponseShare, 1e-3 * static_cast<double>(clock.elapsed()));
        const int row = design.field() != nullptr ? -1 : centreRowWire(design.rowWires()); // the field joins all wires
        const auto result = betterLayout(design, areaGoal(*response, row, noise, 0),
                                         same ? LayoutFreedom::SameOnEveryWire : LayoutFreedom::WireByWire, {}, 1, stop,
                                         [&](double share, const std::string& what) {
                                           report(kResponseShare + (1 - kResponseShare) * share, what);
                                         });
        if (!result) return {};
        const FoundLayout found{design, result->layout, summaryOf(designBounds(design, *response, noise)),
                                summaryOf(designBounds(result->layout, *response, noise)), result->evaluations};
        const bool better = result->after < result->before && found.layout != found.from;
        return [this, found, better] {
          shown_.reset();
          workbench_.edit(tr("Find a better layout"),
                          [&](Project& next) { next.studies.found = better ? std::optional(found) : std::nullopt; });
          if (!better)
            words_->setText(
                tr("%1 layouts were tried; none that can be built is better than the current one.").arg(found.tried));
        };
      },
      JobRunner::Loss::Work);
}

void LayoutFinder::displayProject() {
  const Project& project = workbench_.project();
  const auto& found = project.studies.found;
  search_->setEnabled(!runner_.running());
  if (!runner_.running() && found != shown_) {
    shown_ = found;
    words_->setText(found ? tr("%1 layouts were tried. ").arg(found->tried) +
                                boundTable(tr("before"), found->before, tr("found"), found->after) +
                                layoutWords(found->from, found->layout)
                          : intention());
  }
  const bool taken = found && found->layout == project.design;
  takeOver_->setEnabled(found && found->from == project.design && !runner_.running());
  takeOver_->setText(taken ? tr("In use") : tr("Use this layout"));
  words_->setEnabled(!found || taken || found->from == project.design || runner_.running());
  words_->setToolTip(words_->isEnabled() ? QString() : tr("Found for another design"));
}

void LayoutFinder::takeOver() {
  Project next = workbench_.project();
  if (!next.studies.found) return;
  next.design = next.studies.found->layout;
  workbench_.closeEntry();
  workbench_.edit(tr("Use a better layout"), next);
}

} // namespace palp
