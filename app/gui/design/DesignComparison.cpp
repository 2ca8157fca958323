#include "app/gui/design/DesignComparison.h"

#include "app/gui/design/BoundWords.h"
#include "app/gui/design/ComparedAnswers.h"
#include "app/gui/design/ProgressWords.h"
#include "app/gui/jobs/TimeLeft.h"
#include "app/gui/views/HeatmapSpecs.h"
#include "app/gui/views/HeatmapView.h"
#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/Markup.h"

#include <QComboBox>
#include <QElapsedTimer>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include <algorithm>

namespace palp {

namespace {

constexpr int kSideWidth_px = 480;

QString blockWords(const SensorDesign& design) {
  const Eigen::Vector3d& size = design.block_mm;
  return QObject::tr("block %1 x %2 x %3 mm").arg(size.x()).arg(size.y()).arg(size.z());
}

/// The design before the last change. The sizes of a block are typed number by number: they are one change.
std::size_t beforeLastChange(const std::vector<EarlierDesign>& earlier, const SensorDesign& now) {
  std::size_t k = 0;
  const SensorDesign* after = &now;
  while (k + 1 < earlier.size() && !earlier[k + 1].undone && earlier[k].design.block_mm != after->block_mm &&
         earlier[k + 1].design.block_mm != earlier[k].design.block_mm)
    after = &earlier[k++].design;
  return k;
}

Eigen::MatrixXd differenceOf(const DesignsCompared& compared) {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const Rows>(compared.difference_percent.data(), compared.rows, compared.columns);
}

} // namespace

DesignComparison::DesignComparison(Workbench& workbench, QWidget* parent) : QWidget(parent), workbench_(workbench) {
  build();
  connect(list_, &QComboBox::activated, this, &DesignComparison::choose);
  connect(keep_, &QPushButton::clicked, this, &DesignComparison::keep);
  connect(compare_, &QPushButton::clicked, this, &DesignComparison::compare);
  connect(back_, &QPushButton::clicked, this, &DesignComparison::goBack);
  connect(fields_, &QPushButton::clicked, this, &DesignComparison::showFields);
  connect(&runner_, &JobRunner::failed, this, [this](const QString& sentence) { showWords(*words_, sentence); });
  connect(&runner_, &JobRunner::started, this, &DesignComparison::displayProject);
  connect(&runner_, &JobRunner::finished, this, [this](bool cancelled) {
    if (cancelled) {
      shown_.reset();
      showCompared();
      if (!shown_) words_->setText(tr("Cancelled; nothing was compared."));
    }
    displayProject();
  });
  connect(&workbench_, &Workbench::projectReplaced, this, [this] {
    if (runner_.running()) runner_.cancel(); // of the other project
    referencesBefore_.clear();
    asked_.reset();
    displayProject();
  });
  // The history has its new entry only after the project has changed.
  connect(&workbench_.history(), &QUndoStack::indexChanged, this, &DesignComparison::displayProject);
  showProgress(runner_, *words_);
  displayProject();
}

void DesignComparison::build() {
  auto* row = new QHBoxLayout(this);
  auto* side = new QWidget;
  side->setFixedWidth(kSideWidth_px);
  auto* column = new QVBoxLayout(side);
  column->setContentsMargins(0, 0, 0, 0);
  auto* with = new QHBoxLayout;
  with->addWidget(new QLabel(tr("Compare this design with")));
  list_ = choiceBox("compareWith", {},
                    tr("Earlier designs, each named by the edit that replaced it, and the reference design"),
                    tr("Design to compare with"));
  list_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  with->addWidget(list_, 1);
  column->addLayout(with);
  auto* buttons = new QHBoxLayout;
  compare_ = pushButton(tr("Compare"), "compareDesigns",
                        tr("Solves both designs under the load and computes the error bounds of both; Esc cancels"));
  fields_ = pushButton(tr("Show the difference of the fields"), "keptFields",
                       tr("Colours the block on the Deformation scene by this design minus the selected one, which "
                          "becomes the reference design"));
  for (QPushButton* button : {compare_, fields_}) buttons->addWidget(button);
  column->addLayout(buttons);
  auto* more = new QHBoxLayout;
  back_ = pushButton(tr("Restore"), "takeKept",
                     tr("Makes the selected design the current design again; this can be undone"));
  keep_ = pushButton(tr("Set as reference"), "keepDesign",
                     tr("Stores the current design as the reference that later designs are compared with; it is saved "
                        "with the project"));
  for (QPushButton* button : {back_, keep_}) more->addWidget(button);
  column->addLayout(more);
  stale_ = new QLabel;
  stale_->setObjectName("comparisonState");
  stale_->setProperty("role", "hint");
  words_ = markupLabel();
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
  row->addStretch(); // next to the text alone
}

void DesignComparison::setTheme(Theme theme) {
  difference_->setTheme(theme);
}

const DesignComparison::Choice* DesignComparison::chosen() const {
  const int index = list_->currentIndex();
  return index < 0 ? nullptr : &choices_[static_cast<std::size_t>(index)];
}

void DesignComparison::listChoices() {
  const Project& project = workbench_.project();
  choices_.clear();
  const auto offer = [&](const QString& name, const SensorDesign& design) {
    const auto same = [&](const Choice& other) { return other.design == design; };
    if (design != project.design && std::none_of(choices_.begin(), choices_.end(), same))
      choices_.push_back({name, design});
  };
  const std::vector<EarlierDesign> earlier = workbench_.earlierDesigns();
  for (const EarlierDesign& each : earlier)
    offer((each.undone ? tr("%1, undone change: %2") : tr("%1, before change: %2"))
                  .arg(each.when.toString("HH:mm"), each.change) +
              (each.design == project.kept ? tr(" (reference)") : QString()),
          each.design);
  if (project.kept) offer(tr("the reference design (%1)").arg(blockWords(*project.kept)), *project.kept);
  for (const SensorDesign& each : referencesBefore_) offer(tr("former reference (%1)").arg(blockWords(each)), each);
  const auto& compared = project.studies.compared;
  if (compared) offer(QString::fromStdString(compared->name), compared->earlier);
  const QSignalBlocker quiet(list_);
  list_->clear();
  std::size_t wanted = earlier.empty() || earlier[0].undone ? 0 : beforeLastChange(earlier, project.design);
  if ((earlier.empty() || earlier[0].undone) && project.kept) // nothing was changed here yet
    for (std::size_t k = 0; k < choices_.size(); ++k)
      if (choices_[k].design == *project.kept) wanted = k;
  for (std::size_t k = 0; k < choices_.size(); ++k) {
    list_->addItem(choices_[k].name);
    list_->setItemData(static_cast<int>(k), choices_[k].name + ", " + blockWords(choices_[k].design), Qt::ToolTipRole);
    const bool below = compared && compared->now == project.design && compared->earlier == choices_[k].design;
    if (asked_ ? asked_ == choices_[k].design : below) wanted = k;
  }
  list_->setCurrentIndex(choices_.empty() ? -1 : static_cast<int>(std::min(wanted, choices_.size() - 1)));
}

void DesignComparison::choose(int index) {
  asked_ = choices_[static_cast<std::size_t>(index)].design;
  displayProject();
}

void DesignComparison::keep() {
  Project next = workbench_.project();
  if (next.kept && next.kept != next.design) referencesBefore_.insert(referencesBefore_.begin(), *next.kept);
  next.kept = asked_ = next.design;
  workbench_.closeEntry();
  workbench_.edit(tr("Set the reference design"), next);
}

void DesignComparison::goBack() {
  Project next = workbench_.project();
  setDesign(next, chosen()->design);
  asked_.reset();
  workbench_.closeEntry();
  workbench_.edit(tr("Restore an earlier design"), next);
}

void DesignComparison::showFields() {
  Project next = workbench_.project();
  const SensorDesign with = chosen()->design;
  if (next.kept && next.kept != with) referencesBefore_.insert(referencesBefore_.begin(), *next.kept);
  next.kept = asked_ = with;
  next.view.lessReference = true;
  workbench_.edit(tr("Show the difference of the fields"), next);
  emit fieldsRequested();
}

void DesignComparison::displayProject() {
  listChoices();
  const Project& project = workbench_.project();
  const bool other = chosen() != nullptr;
  for (QWidget* part : std::initializer_list<QWidget*>{list_, compare_, back_, fields_}) part->setEnabled(other);
  if (project.studies.compared != shown_ && !runner_.running()) showCompared();
  QString state;
  if (!other)
    state =
        project.kept
            ? tr("This is the reference design: change something to compare.")
            : tr("There is no earlier design yet: change something, then compare with the design before the change.");
  else if (shown_ && !runner_.running()) {
    const DesignsCompared& of = *shown_;
    if (of.now != project.design || of.earlier != chosen()->design)
      state = tr("Outdated: this comparison belongs to other designs. Press \"Compare\" to update it.");
    else if (of.load != project.load || of.noise != project.view.resistanceNoise)
      state = tr("Outdated: this comparison belongs to another load or noise. Press \"Compare\" to update it.");
  }
  stale_->setText(state);
  stale_->setVisible(!state.isEmpty());
  words_->setEnabled(state.isEmpty() || !shown_);
}

void DesignComparison::showCompared() {
  shown_ = workbench_.project().studies.compared;
  const bool map = shown_ && !shown_->difference_percent.empty();
  const bool atRest = shown_ && (shown_->earlier.field() != nullptr || shown_->now.field() != nullptr);
  words_->setText(shown_
                      ? tr("<b>%1</b><br>").arg(asWritten(QString::fromStdString(shown_->name))) +
                            (atRest ? tr("Both at rest. ") : QString()) +
                            boundTable(tr("that design"), shown_->earlierBounds, tr("this design"), shown_->nowBounds) +
                            asWrittenWithBold(QString::fromStdString(shown_->words))
                      : QString());
  difference_->setVisible(map);
  if (map) difference_->setHeatmap(heatmapLess(differenceOf(*shown_), tr("the earlier design").toStdString()));
}

void DesignComparison::compare() {
  const Project& project = workbench_.project();
  DesignsCompared compared;
  compared.earlier = chosen()->design;
  compared.now = project.design;
  compared.name = chosen()->name.toStdString();
  compared.load = project.load;
  compared.noise = project.view.resistanceNoise;
  difference_->hide();
  words_->setText(tr("Computing..."));
  runner_.start(
      tr("Comparing two designs"),
      [this, compared, mesh = project.mesh](const std::stop_token& stop, JobProgress& progress) -> JobRunner::Taking {
        DesignsCompared result = compared;
        QElapsedTimer clock;
        clock.start();
        TimeLeft left;
        left.begin(0, 0);
        const auto report = [&](double share, const std::string& what) {
          const double now_s = 1e-3 * static_cast<double>(clock.elapsed());
          progress.set(share, what + (share < 0.15 ? std::string() : leftInWords(left.left_s(share, 1, now_s))));
        };
        if (!compareDesigns(result, mesh, report, stop)) return {};
        return [this, result] {
          shown_.reset(); // also where it is what was found before
          workbench_.edit(tr("Compare two designs"), [&](Project& next) { next.studies.compared = result; });
        };
      },
      JobRunner::Loss::Work);
}

} // namespace palp
