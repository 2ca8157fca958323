#include "app/gui/design/LayoutFinder.h"

#include "app/gui/design/BoundWords.h"
#include "app/gui/design/DesignFields.h"
#include "app/study/reports/layout/LayoutSearch.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include <cmath>

namespace palp {

LayoutFinder::LayoutFinder(Workbench& workbench, QWidget* parent) : QWidget(parent), workbench_(workbench) {
  auto* column = new QVBoxLayout(this);
  auto* row = new QHBoxLayout;
  freedom_ = new QComboBox;
  freedom_->setObjectName("layoutFreedom");
  freedom_->addItems({tr("the same places on every column-wire"), tr("places wire by wire")});
  freedom_->setToolTip(
      tr("Electrodes slide on their wires in steps of 0.05 mm and layers change their height; 1 mm from "
         "electrode to electrode, 0.5 mm of rubber everywhere"));
  search_ = new QPushButton(tr("Find a better layout"));
  search_->setObjectName("findLayout");
  search_->setToolTip(tr("Lowers the noise floor of the middle row-wire; Esc stops it"));
  takeOver_ = new QPushButton(tr("Take it over"));
  takeOver_->setObjectName("takeLayout");
  takeOver_->setToolTip(tr("Makes the layout that was found the design; can be undone"));
  takeOver_->setEnabled(false);
  row->addWidget(freedom_);
  row->addWidget(search_);
  row->addWidget(takeOver_);
  row->addStretch(1);
  column->addLayout(row);
  notYet_ = new QLabel(tr("Not under the conduction field: layouts are searched by Eq. (1) alone."));
  notYet_->setObjectName("layoutLaw");
  notYet_->hide();
  column->addWidget(notYet_);
  words_ = new QLabel(tr("The block's response is solved once for every load area; then thousands of layouts are "
                         "read out of it."));
  words_->setObjectName("layoutWords");
  words_->setWordWrap(true);
  words_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  column->addWidget(words_);
  column->addStretch(1);
  connect(search_, &QPushButton::clicked, this, &LayoutFinder::search);
  connect(takeOver_, &QPushButton::clicked, this, &LayoutFinder::takeOver);
  connect(&runner_, &JobRunner::failed, words_, &QLabel::setText);
  connect(&runner_, &JobRunner::started, this, &LayoutFinder::displayProject);
  connect(&runner_, &JobRunner::finished, this, [this](bool cancelled) {
    displayProject();
    if (cancelled) words_->setText(tr("Stopped; nothing was changed."));
  });
}

namespace {

/// What is otherwise in a layout, a line a number.
QString layoutWords(const SensorDesign& before, const SensorDesign& after) {
  QString words = "<table>";
  for (const DesignField& field : designFields()) {
    const QString from = field.text(before), to = field.text(after);
    if (from == to) continue;
    words += QString("<tr><td>%1, %2&nbsp;&nbsp;</td><td>%3 &rarr; <b>%4</b> %5</td></tr>")
                 .arg(field.group, field.label, from.toHtmlEscaped(), to.toHtmlEscaped(), field.unit);
  }
  return words + "</table>";
}

} // namespace

void LayoutFinder::search() {
  const Project& project = workbench_.project();
  found_.reset();
  takeOver_->setEnabled(false);
  words_->setText(tr("Being searched..."));
  const auto freedom = freedom_->currentIndex() == 0 ? LayoutFreedom::SameOnEveryWire : LayoutFreedom::WireByWire;
  runner_.start(
      tr("Finding a better layout"),
      [this, freedom, design = project.design, mesh = project.mesh,
       noise = project.view.resistanceNoise](const std::stop_token& stop, JobProgress& progress) -> JobRunner::Taking {
        StageLog stages;
        const auto response = AreaResponse::solve(
            design, mesh, 0, stages, [&](double share, const std::string& what) { progress.set(0.7 * share, what); },
            stop);
        if (!response) return {};
        progress.set(0.75, "Trying layouts");
        const int row = centreRowWire(design.rowWires());
        const auto result = betterLayout(design, *response, row, noise, freedom, {}, 1, stop);
        if (!result) return {};
        const Found found{design,
                          result->layout,
                          result->before_percent,
                          result->after_percent,
                          designBounds(design, *response, noise),
                          designBounds(result->layout, *response, noise)};
        return [this, found, tries = result->evaluations] {
          found_ = found;
          const bool better = found.after_percent < found.before_percent && found.layout != found.from;
          if (!better) found_.reset();
          words_->setText(better
                              ? tr("%1 layouts were tried. ").arg(tries) +
                                    boundTable(tr("before"), found.before, tr("found"), found.after) +
                                    layoutWords(found.from, found.layout)
                              : tr("%1 layouts were tried; none that can be made is better than this one.").arg(tries));
          displayProject();
        };
      });
}

void LayoutFinder::displayProject() {
  const SensorDesign& design = workbench_.project().design;
  const bool pairs = design.field() == nullptr;
  search_->setEnabled(pairs && !runner_.running());
  notYet_->setVisible(!pairs);
  takeOver_->setEnabled(found_ && found_->from == design);
  takeOver_->setText(found_ && found_->layout == design ? tr("Taken over") : tr("Take it over"));
}

void LayoutFinder::takeOver() {
  if (!found_) return;
  Project next = workbench_.project();
  next.design = found_->layout;
  workbench_.closeEntry();
  workbench_.edit(tr("Take a better layout over"), next);
}

} // namespace palp
