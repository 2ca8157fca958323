#include "app/gui/design/DesignSweep.h"

#include "app/gui/design/BoundWords.h"
#include "app/gui/design/DesignFields.h"
#include "app/gui/design/RestFloor.h"
#include "app/gui/project/ResultCsv.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/widgets/SaveDialog.h"
#include "app/gui/widgets/SpinBoxes.h"
#include "model/base/Error.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>

#include <algorithm>

namespace palp {

namespace {

constexpr int kSweepSideWidth_px = 300;

/// The number that a field shows; none where it shows a list or a count.
std::optional<double> numberOf(const DesignField& field, const SensorDesign& design) {
  bool good = false;
  const double value = field.text(design).toDouble(&good);
  if (!good || field.key.startsWith("areas") || field.key.startsWith("force_range")) return {};
  return value;
}

ChartSpec sweepChart(const QString& label, const std::vector<double>& at, const std::vector<DesignBounds>& bounds) {
  ChartSpec spec;
  spec.title = "What the design resolves";
  spec.xLabel = label.toStdString();
  spec.yLabel = "bound [% of range]";
  spec.logY = true;
  for (const bool all : {true, false})
    for (int d = 0; d < 3; ++d) {
      ChartSeries series;
      series.name = std::string("F") + "xyz"[d] + (all ? ", all row-wires" : ", middle row-wire alone");
      series.style = ChartSeries::Style::LineAndPoints;
      series.dashed = !all;
      series.color = d;
      series.x = at;
      for (const DesignBounds& bound : bounds)
        series.y.push_back((all ? bound.allRows : bound.centreRow).withPrior()[d]);
      spec.series.push_back(std::move(series));
    }
  return spec;
}

} // namespace

DesignSweep::DesignSweep(Workbench& workbench, QWidget* parent) : QWidget(parent), workbench_(workbench) {
  auto* row = new QHBoxLayout(this);
  auto* side = new QWidget;
  side->setFixedWidth(kSweepSideWidth_px);
  auto* form = new QFormLayout(side);
  form->setContentsMargins(0, 0, 0, 0);
  number_ = new QComboBox;
  number_->setObjectName("sweepNumber");
  number_->setToolTip(tr("The number of the design that is changed; all else stays"));
  from_ = new QDoubleSpinBox;
  to_ = new QDoubleSpinBox;
  from_->setObjectName("sweepStart");
  to_->setObjectName("sweepEnd");
  for (QDoubleSpinBox* box : {from_, to_}) {
    box->setDecimals(4);
    box->setRange(0, 1e6);
    box->setKeyboardTracking(false);
  }
  number_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  steps_ = new QSpinBox;
  steps_->setObjectName("sweepSteps");
  steps_->setRange(2, 50);
  steps_->setValue(7);
  start_ = new QPushButton(tr("Sweep"));
  start_->setObjectName("sweepDesign");
  start_->setToolTip(
      tr("Solves the block's response for each value and bounds the errors of the forces; Esc stops it"));
  save_ = new QPushButton(tr("Save table..."));
  save_->setObjectName("saveSweep");
  save_->setToolTip(tr("Both bounds of each value as CSV"));
  save_->setEnabled(false);
  words_ = new QLabel;
  words_->setObjectName("sweepWords");
  words_->setWordWrap(true);
  form->addRow(tr("Number"), number_);
  form->addRow(tr("from"), from_);
  form->addRow(tr("to"), to_);
  form->addRow(tr("values"), steps_);
  form->addRow(start_, save_);
  form->addRow(words_);
  row->addWidget(side);
  chart_ = new ChartView;
  chart_->setObjectName("sweepChart");
  row->addWidget(chart_, 1);
  connect(number_, &QComboBox::currentIndexChanged, this, &DesignSweep::proposeRange);
  connect(start_, &QPushButton::clicked, this, &DesignSweep::run);
  connect(save_, &QPushButton::clicked, this, &DesignSweep::saveTable);
  connect(&runner_, &JobRunner::failed, words_, &QLabel::setText);
  connect(&runner_, &JobRunner::started, this, [this] { start_->setEnabled(false); });
  connect(&runner_, &JobRunner::finished, this, [this](bool cancelled) {
    start_->setEnabled(true);
    if (cancelled) words_->setText(tr("Stopped; the curves are those before."));
  });
  // The range follows the design until somebody sets it.
  for (QDoubleSpinBox* box : {from_, to_})
    connect(box, &QDoubleSpinBox::valueChanged, this, [this] { proposed_ = false; });
  connect(&workbench_, &Workbench::projectChanged, this, &DesignSweep::displayProject);
  displayProject();
}

void DesignSweep::setTheme(Theme theme) {
  chart_->setTheme(theme);
}

void DesignSweep::displayProject() {
  const SensorDesign& design = workbench_.project().design;
  if (number_->count() == 0 || law_ != design.resistance.index()) listNumbers(design);
  if (proposed_) proposeRange();
}

void DesignSweep::listNumbers(const SensorDesign& design) {
  law_ = design.resistance.index();
  const QString chosen = number_->currentData().toString();
  const QSignalBlocker quiet(number_);
  number_->clear();
  for (const DesignField& field : designFields())
    if (field.has(design) && numberOf(field, design))
      number_->addItem(field.group + ": " + field.label + (field.unit.isEmpty() ? "" : " [" + field.unit + "]"),
                       field.key);
  number_->setCurrentIndex(std::max(0, number_->findData(chosen)));
  if (number_->currentData().toString() != chosen) proposed_ = true;
}

void DesignSweep::proposeRange() {
  for (const DesignField& field : designFields()) {
    if (field.key != number_->currentData().toString()) continue;
    const double now = numberOf(field, workbench_.project().design).value_or(0);
    proposed_ = true;
    showExactly(*from_, 0.8 * now);
    showExactly(*to_, 1.2 * now);
    return;
  }
}

void DesignSweep::run() {
  const QString key = number_->currentData().toString();
  const auto field = std::find_if(designFields().begin(), designFields().end(),
                                  [&](const DesignField& each) { return each.key == key; });
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
    words_->setText(tr("Fewer than two of these values make a design that can be built; the panel at the left says why "
                       "where one is typed there."));
    return;
  }
  words_->setText(tr("Being computed..."));
  // Electrodes do not stiffen the rubber: other places of theirs are read out of the same response.
  const bool sameBlock = key.startsWith("upper_layer") || key.startsWith("lower_layer") || key.startsWith("resistance");
  runner_.start(
      tr("Sweeping a number of the design"),
      [this, designs, left, sameBlock, label = number_->currentText(), mesh = project.mesh,
       noise = project.view.resistanceNoise](const std::stop_token& stop, JobProgress& progress) -> JobRunner::Taking {
        std::vector<Point> points;
        std::optional<AreaResponse> response;
        std::shared_ptr<const RestFloor> floor; // under the field
        StageLog stages;
        for (std::size_t k = 0; k < designs.size(); ++k) {
          const auto report = [&](double share, const std::string& what) {
            progress.set(sameBlock ? share : (static_cast<double>(k) + share) / static_cast<double>(designs.size()),
                         what);
          };
          if (designs[k].second.field() != nullptr) {
            const auto part = [&](double share, const std::string& what) {
              progress.set((static_cast<double>(k) + share) / static_cast<double>(designs.size()), what);
            };
            floor = restFloor(designs[k].second, mesh, floor, part, stop);
            if (!floor) return {};
            points.push_back({designs[k].first, boundsAtRest(*floor, noise)});
            continue;
          }
          if (!response || !sameBlock) response = AreaResponse::solve(designs[k].second, mesh, 0, stages, report, stop);
          if (!response || stop.stop_requested()) return {};
          points.push_back({designs[k].first, designBounds(designs[k].second, *response, noise)});
        }
        return [this, label, points, left] { showResult(label, points, left); };
      });
}

void DesignSweep::showResult(const QString& label, const std::vector<Point>& points, int left) {
  points_ = points;
  label_ = label;
  save_->setEnabled(true);
  std::vector<double> at;
  std::vector<DesignBounds> bounds;
  for (const Point& point : points) {
    at.push_back(point.at);
    bounds.push_back(point.bounds);
  }
  chart_->setChart(sweepChart(label, at, bounds));
  const auto best = std::min_element(points.begin(), points.end(), [](const Point& a, const Point& b) {
    return a.bounds.allRows.mean() < b.bounds.allRows.mean();
  });
  words_->setText(tr("Lowest at %1: all row-wires %2 of the range (Fx / Fy / Fz, with prior, as the noise floor "
                     "says it).%3")
                      .arg(best->at)
                      .arg(boundPercents(best->bounds.allRows.withPrior()),
                           left > 0 ? tr(" %1 values make no design that can be built.").arg(left) : QString()));
}

void DesignSweep::saveTable() {
  const QString file = askFileToSave(this, tr("Save table"), "design-sweep.csv", tr("Tables (*.csv)"));
  if (file.isEmpty()) return;
  QString text = "# " + label_ + ", relative noise of the resistances " +
                 QString::number(workbench_.project().view.resistanceNoise) + "\nvalue";
  for (const char* rows : {"all_rows", "middle_row"})
    for (const char* prior : {"without_prior", "with_prior"})
      for (const char* force : {"Fx", "Fy", "Fz"}) text += QString(",%1_%2_%3_percent").arg(force, rows, prior);
  text += "\n";
  for (const Point& point : points_) {
    text += QString::number(point.at, 'g', 12);
    for (const LayoutBound* bound : {&point.bounds.allRows, &point.bounds.centreRow})
      for (const Eigen::Vector3d& values : {bound->withoutPrior(), bound->withPrior()})
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
