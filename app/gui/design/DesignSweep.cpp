#include "app/gui/design/DesignSweep.h"

#include "app/gui/design/BoundWords.h"
#include "app/gui/design/DesignFields.h"
#include "app/gui/design/ProgressWords.h"
#include "app/gui/design/RestFloor.h"
#include "app/gui/jobs/TimeLeft.h"
#include "app/gui/project/ResultCsv.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/views/CsvExport.h"
#include "app/gui/widgets/FileDialogs.h"
#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/SpinBoxes.h"
#include "model/base/Error.h"
#include "model/base/NumberText.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr int kSweepSideWidth_px = 300;

/// The number that a field shows; none where it shows a list or a count.
std::optional<double> numberOf(const DesignField& field, const SensorDesign& design) {
  if (field.key.startsWith("areas") || field.key.startsWith("force_range")) return {};
  return numberIn(field.text(design).toStdString());
}

/// The laws by which a design has its numbers.
std::pair<std::size_t, std::size_t> lawsOf(const SensorDesign& design) {
  return {design.resistance.index(), design.material.law.index()};
}

const DesignField* fieldOf(const std::string& key) {
  const auto field = std::find_if(designFields().begin(), designFields().end(),
                                  [&](const DesignField& each) { return each.key.toStdString() == key; });
  return field == designFields().end() ? nullptr : &*field;
}

QString labelOf(const DesignField& field) {
  return field.group + ": " + field.label + (field.unit.isEmpty() ? "" : " [" + field.unit + "]");
}

/// Geometric mean of the three forces without prior: what the lowest point has least of.
double meanOf(const BoundSummary& bounds) {
  return std::cbrt(bounds.allWithoutPrior.prod());
}

ChartSpec sweepChart(const DesignSweepCurve& curve) {
  ChartSpec spec;
  spec.title = "Error bounds of the design";
  spec.xLabel = labelOf(*fieldOf(curve.number)).toStdString();
  spec.yLabel = "bound [% of range]";
  spec.logY = true;
  for (const bool all : {true, false})
    for (int d = 0; d < 3; ++d) {
      ChartSeries series;
      series.name = std::string("F") + "xyz"[d] + (all ? ", all rows" : ", middle row");
      series.style = ChartSeries::Style::LineAndPoints;
      series.dashed = !all;
      series.color = d;
      for (const DesignSweepCurve::Point& point : curve.points) {
        series.x.push_back(point.at);
        series.y.push_back((all ? point.bounds.allWithPrior : point.bounds.centreWithPrior)[d]);
      }
      spec.series.push_back(std::move(series));
    }
  return spec;
}

} // namespace

DesignSweep::DesignSweep(Workbench& workbench, QWidget* parent) : QWidget(parent), workbench_(workbench) {
  build();
  connect(number_, &QComboBox::currentIndexChanged, this, [this] { readSettings(false); });
  connect(steps_, &QSpinBox::valueChanged, this,
          [this] { readSettings(!workbench_.project().studies.sweep.proposed); });
  for (QDoubleSpinBox* box : {from_, to_})
    connect(box, &QDoubleSpinBox::valueChanged, this, [this] { readSettings(true); });
  connect(start_, &QPushButton::clicked, this, &DesignSweep::run);
  connect(save_, &QPushButton::clicked, this, &DesignSweep::saveTable);
  showProgress(runner_, *words_);
  connect(&runner_, &JobRunner::failed, words_, &QLabel::setText);
  connect(&runner_, &JobRunner::started, this, [this] { start_->setEnabled(false); });
  connect(&runner_, &JobRunner::finished, this, [this](bool cancelled) {
    start_->setEnabled(true);
    if (cancelled) words_->setText(tr("Cancelled; the earlier curves are kept."));
    displayProject();
  });
  connect(&workbench_, &Workbench::projectChanged, this, &DesignSweep::displayProject);
  connect(&workbench_, &Workbench::projectReplaced, this, [this] {
    if (runner_.running()) runner_.cancel();
  }); // of the other project
  displayProject();
}

void DesignSweep::build() {
  auto* row = new QHBoxLayout(this);
  auto* side = new QWidget;
  side->setFixedWidth(kSweepSideWidth_px);
  auto* form = new QFormLayout(side);
  form->setContentsMargins(0, 0, 0, 0);
  number_ = choiceBox("sweepNumber", {}, tr("Parameter of the design that varies; all others stay as they are"));
  from_ = new NumberBox;
  to_ = new NumberBox;
  from_->setObjectName("sweepStart");
  to_->setObjectName("sweepEnd");
  for (QDoubleSpinBox* box : {from_, to_}) {
    box->setDecimals(4);
    box->setRange(0, 1e6);
    box->setKeyboardTracking(false);
  }
  number_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  steps_ = wholeBox("sweepSteps", {.low = 2, .high = 50, .whileTyping = true}, {});
  steps_->setValue(7);
  start_ = pushButton(
      tr("Sweep"), "sweepDesign",
      tr("Solves the block's response for each value and computes the error bounds of the forces; Esc cancels"));
  save_ = pushButton(tr("Save table..."), "saveSweep", tr("Saves both bounds of each value as CSV"));
  save_->setEnabled(false);
  words_ = textLabel("sweepWords");
  stale_ = textLabel("designSweepState", "hint");
  form->addRow(tr("Parameter"), number_);
  form->addRow(tr("From"), from_);
  form->addRow(tr("To"), to_);
  form->addRow(tr("Values"), steps_);
  form->addRow(start_, save_);
  form->addRow(stale_);
  form->addRow(words_);
  row->addWidget(side);
  chart_ = new ChartView;
  chart_->setObjectName("sweepChart");
  row->addWidget(chart_, 1);
}

void DesignSweep::setTheme(Theme theme) {
  chart_->setTheme(theme);
}

void DesignSweep::readSettings(bool rangeByHand) {
  Project next = workbench_.project();
  DesignSweepSettings& sweep = next.studies.sweep;
  sweep.number = number_->currentData().toString().toStdString();
  sweep.values = steps_->value();
  sweep.proposed = !rangeByHand;
  sweep.from = rangeByHand ? from_->value() : 0;
  sweep.to = rangeByHand ? to_->value() : 0;
  workbench_.edit(tr("Change the sweep of the design"), next);
}

void DesignSweep::displayProject() {
  const Project& project = workbench_.project();
  const DesignSweepSettings& sweep = project.studies.sweep;
  const QSignalBlocker quietNumber(number_), quietSteps(steps_);
  if (number_->count() == 0 || laws_ != lawsOf(project.design)) listNumbers(project.design);
  number_->setCurrentIndex(std::max(number_->findData(QString::fromStdString(sweep.number)), 0));
  steps_->setValue(sweep.values);
  const DesignField& field = *fieldOf(number_->currentData().toString().toStdString());
  const double now = numberOf(field, project.design).value_or(0);
  showExactly(*from_, sweep.proposed ? 0.8 * now : sweep.from); // around the number as it is now
  showExactly(*to_, sweep.proposed ? 1.2 * now : sweep.to);
  if (runner_.running()) return;
  if (project.studies.curve != shown_) showCurve();
  QString state;
  if (shown_) {
    SensorDesign there = project.design;
    const DesignField* swept = fieldOf(shown_->number);
    if (swept != nullptr && swept->has(there) && swept->has(shown_->design))
      swept->set(there, swept->text(shown_->design));
    if (there != shown_->design)
      state = tr("Outdated: these curves belong to another design.");
    else if (shown_->noise != project.view.resistanceNoise)
      state = tr("Outdated: these curves belong to another noise of the resistances.");
  }
  stale_->setText(state);
  stale_->setVisible(!state.isEmpty());
}

void DesignSweep::listNumbers(const SensorDesign& design) {
  laws_ = lawsOf(design);
  number_->clear();
  for (const DesignField& field : designFields())
    if (field.has(design) && numberOf(field, design)) number_->addItem(labelOf(field), field.key);
}

void DesignSweep::run() {
  const QString key = number_->currentData().toString();
  const DesignField* field = fieldOf(key.toStdString());
  const Project& project = workbench_.project();
  const double from = from_->value(), to = to_->value();
  const int steps = steps_->value();
  std::vector<std::pair<double, SensorDesign>> designs;
  int left = 0;
  for (int k = 0; k < steps; ++k) {
    const double at = from + (to - from) * k / (steps - 1);
    SensorDesign design = project.design;
    if (field->set(design, QString::number(at, 'g', 12)).isEmpty() && check(design).empty())
      designs.emplace_back(at, design);
    else
      ++left;
  }
  if (designs.size() < 2) {
    words_->setText(tr("Fewer than two of these values give a design that can be built; the panel at the left shows "
                       "why when one is entered there."));
    return;
  }
  words_->setText(tr("Computing..."));
  DesignSweepCurve curve;
  curve.design = project.design;
  curve.number = key.toStdString();
  curve.noise = project.view.resistanceNoise;
  curve.left = left;
  // Electrodes do not stiffen the rubber: other places of theirs are read out of the same response.
  const bool sameBlock = key.startsWith("upper_layer") || key.startsWith("lower_layer") || key.startsWith("resistance");
  runner_.start(
      tr("Sweeping a parameter of the design"),
      [this, designs, sameBlock, empty = curve, mesh = project.mesh](const std::stop_token& stop,
                                                                     JobProgress& progress) -> JobRunner::Taking {
        DesignSweepCurve found = empty;
        std::optional<AreaResponse> response;
        StageLog stages;
        QElapsedTimer clock;
        clock.start();
        TimeLeft pace;
        pace.begin(0, 0);
        std::shared_ptr<const RestFloor> floor; // under the field
        for (std::size_t k = 0; k < designs.size(); ++k) {
          const bool byField = designs[k].second.field() != nullptr;
          const auto report = [&](double share, const std::string& what) {
            const double all =
                sameBlock && !byField ? share : (static_cast<double>(k) + share) / static_cast<double>(designs.size());
            const double now_s = 1e-3 * static_cast<double>(clock.elapsed());
            progress.set(all, what + (all < 0.05 ? std::string() : leftInWords(pace.left_s(all, 1, now_s))));
          };
          if (byField) {
            floor = restFloor(designs[k].second, mesh, floor, report, stop);
            if (!floor) return {};
            found.points.push_back({designs[k].first, summaryOf(boundsAtRest(*floor, found.noise))});
            continue;
          }
          if (!response || !sameBlock) response = AreaResponse::solve(designs[k].second, mesh, 0, stages, report, stop);
          if (!response || stop.stop_requested()) return {};
          found.points.push_back(
              {designs[k].first, summaryOf(designBounds(designs[k].second, *response, found.noise))});
        }
        return [this, found] {
          shown_.reset(); // also where it is what was found before
          workbench_.edit(tr("Sweep a parameter of the design"), [&](Project& next) { next.studies.curve = found; });
        };
      },
      JobRunner::Loss::Work);
}

void DesignSweep::showCurve() {
  shown_ = workbench_.project().studies.curve;
  if (shown_ && fieldOf(shown_->number) == nullptr) shown_.reset();
  save_->setEnabled(shown_.has_value());
  chart_->setChart(shown_ ? sweepChart(*shown_) : ChartSpec{});
  if (!shown_) {
    words_->clear();
    return;
  }
  const std::vector<DesignSweepCurve::Point>& points = shown_->points;
  const auto best = std::min_element(points.begin(), points.end(),
                                     [](const auto& a, const auto& b) { return meanOf(a.bounds) < meanOf(b.bounds); });
  const DesignField& field = *fieldOf(shown_->number);
  words_->setText(
      tr("Lowest at %1: all row-wires %2 of the range, or %3 (Fx / Fy / Fz, with prior).%4")
          .arg((QString::number(best->at, 'g', 6) + " " + field.unit).trimmed(),
               boundPercents(best->bounds.allWithPrior),
               boundNewtons(best->bounds.allWithPrior, shown_->design.forceRange),
               shown_->left > 0 ? tr(" %1 values give no design that can be built.").arg(shown_->left) : QString()));
}

void DesignSweep::saveTable() {
  const QString file = askFileToSave(this, tr("Save table"), "design-sweep.csv", tr("Tables (*.csv)"));
  if (file.isEmpty()) return;
  QString text = sourceOf(*this) + "# " + labelOf(*fieldOf(shown_->number)) + ", relative noise of the resistances " +
                 QString::number(shown_->noise) + "\nvalue";
  for (const char* rows : {"all_rows", "middle_row"})
    for (const char* prior : {"without_prior", "with_prior"})
      for (const char* force : {"Fx", "Fy", "Fz"}) text += QString(",%1_%2_%3_percent").arg(force, rows, prior);
  text += "\n";
  for (const auto& [at, bounds] : shown_->points) {
    text += QString::number(at, 'g', 12);
    for (const Eigen::Vector3d& values :
         {bounds.allWithoutPrior, bounds.allWithPrior, bounds.centreWithoutPrior, bounds.centreWithPrior})
      for (const double value : values) text += "," + QString::number(value, 'g', 8);
    text += "\n";
  }
  try {
    writeText(file, text);
    words_->setText(tr("Wrote %1.").arg(file));
  } catch (const Error& error) {
    words_->setText(QString::fromStdString(error.what()));
  }
}

} // namespace palp
