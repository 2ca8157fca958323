#include "app/gui/network/SamplesBox.h"

#include "app/gui/network/words/SamplesWords.h"
#include "app/gui/widgets/ShapeWords.h"
#include "app/gui/widgets/WrappedLabel.h"

#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>

#include <algorithm>
#include <tuple>
#include <utility>

namespace palp {

namespace {

constexpr double kMost_mm = 1000, kMost_N = 1000;
constexpr double kMostFriction = 2;

QString touchesChanged() {
  return QObject::tr("Change the touches of the samples");
}

} // namespace

/// A member of the touches; of those that were set last while forces on areas are sampled.
template <class Value> auto SamplesBox::of(Value TouchSampling::*member) {
  return [this, member](SampleSettings& samples) -> Value& {
    TouchSampling& touches = samples.touches ? *samples.touches : touches_;
    return touches.*member;
  };
}

SamplesBox::SamplesBox(QWidget* parent)
    : QGroupBox(tr("Samples"), parent),
      fields_([this](const QString& what, const SampleSettings& /*next*/) { emit edited(what); }) {
  form_ = new QFormLayout(this);
  kind_ = choiceBox("sampleKind", {tr("Forces on areas"), tr("Touches anywhere")},
                    tr("Uniform forces on the load areas, as in the paper, or an indenter that presses anywhere on the "
                       "top face; a network trained on touches can also decode the position"));
  form_->addRow(tr("Samples of"), kind_);
  const QString what = tr("Change the number of samples");
  perArea_ = fields_.bind(
      wholeBox("perArea", {.low = 5, .high = 100000},
               tr("Number of random forces per area for training, and as many again for testing; the paper has 100")),
      what, &SampleSettings::perArea);
  count_ = fields_.bind(wholeBox("touchCount", {.low = kFewestTouches, .high = kMostTouches},
                                 tr("Number of random touches for training, and as many again for testing")),
                        what, of(&TouchSampling::count));
  for (QSpinBox* box : {perArea_, count_}) box->setCorrectionMode(QAbstractSpinBox::CorrectToNearestValue);
  auto* either = new QWidget; // in one row: of two the first did not come back where the second had been (Qt 6.4)
  auto* boxes = new QHBoxLayout(either);
  boxes->setContentsMargins(0, 0, 0, 0);
  addTo(*boxes, {perArea_, count_});
  countLabel_ = new QLabel;
  form_->addRow(countLabel_, either);
  buildTouches();
  form_->addRow(tr("Seed of samples"),
                fields_.bind(wholeBox("seed", {.high = 1000000000}, tr("The same seed gives the same samples")),
                             tr("Change the seed"), &SampleSettings::seed));
  surrogate_ = fields_.bind(
      checkBox(tr("Use a surrogate model"), "surrogate",
               tr("Samples a polynomial fitted to full solves on each area: many samples in seconds, with a measured "
                  "error that is shown")),
      tr("Change the method of sampling"), &SampleSettings::surrogate);
  form_->addRow(QString(), surrogate_);
  buildFiles();
  connect(kind_, &QComboBox::activated, this, &SamplesBox::readKind);
  connect(generate_, &QPushButton::clicked, this, &SamplesBox::generateRequested);
}

/// The indenter and how it presses.
void SamplesBox::buildTouches() {
  QStringList shapes;
  for (const auto& [shape, name] : kIndenterShapes.all()) shapes << inWords(shape);
  shape_ = fields_.bind(
      choiceBox("touchShape", shapes, tr("Shape of the rigid indenter, the same for all touches; its size is random")),
      tr("Change the indenter of the samples"), of(&TouchSampling::shape));
  form_->addRow(tr("Indenter"), shape_);
  radius_ = range("touchRadius", tr("Radius"), {.high = kMost_mm, .step = 0.1, .unit = tr(" mm")},
                  &TouchSampling::smallest_mm, &TouchSampling::largest_mm,
                  tr("Radius of the indenter, uniformly distributed over this range"));
  const auto length = [this](const char* name, const QString& label, const QString& tip,
                             double TouchSampling::*member) {
    auto* box = numberBox(name, {.high = kMost_mm, .step = 0.1, .unit = tr(" mm")}, tip, tr("Touches, %1").arg(label));
    form_->addRow(label, box);
    return fields_.bind(box, touchesChanged(), of(member));
  };
  rim_ = length("touchRim", tr("Edge radius"), tr("Radius of the punch's rounded edge"), &TouchSampling::rim_mm);
  press_ =
      range("touchPress", tr("Force"), {.high = kMost_N, .step = 0.1, .unit = tr(" N")}, &TouchSampling::leastPress_N,
            &TouchSampling::mostPress_N, tr("Downward force, uniformly distributed over this range"));
  friction_ = range("touchFriction", tr("Friction"), {.high = kMostFriction, .step = 0.1},
                    &TouchSampling::leastFriction, &TouchSampling::mostFriction,
                    tr("Coulomb's coefficient of friction. At 0, touches press straight down; with friction they also "
                       "push tangentially, up to 0.7 of the friction limit, and each solve takes about five times as "
                       "long."));
  margin_ = length("touchMargin", tr("Margin to the edges"),
                   tr("Smallest distance of a touch from the sides of the block"), &TouchSampling::margin_mm);
  problem_ = textLabel("touchProblem", "problem");
  form_->addRow(problem_);
}

/// Two boxes; the smaller number is the minimum, in whichever box it is.
QWidget* SamplesBox::range(const char* name, const QString& label, NumberForm form, double TouchSampling::*least,
                           double TouchSampling::*most, const QString& tip) {
  const QString unit = std::exchange(form.unit, {});
  auto* low = numberBox(QString(name) + "Minimum", form, tip, tr("Touches, %1, minimum").arg(label));
  form.unit = unit;
  auto* high = numberBox(QString(name) + "Maximum", form, tip, tr("Touches, %1, maximum").arg(label));
  const auto read = [low, high, least = of(least), most = of(most)](SampleSettings& samples, double /*value*/) {
    std::tie(least(samples), most(samples)) = std::minmax({low->value(), high->value()});
  };
  for (const auto& [box, member] : {std::pair{low, least}, {high, most}}) {
    box->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed); // the panel keeps its width
    fields_.add(
        box, &QDoubleSpinBox::valueChanged, touchesChanged(),
        [this, box = box, member = member] { showExactly(*box, touches_.*member); }, read);
  }
  auto* both = new QWidget;
  auto* row = new QHBoxLayout(both);
  row->setContentsMargins(0, 0, 0, 0);
  addTo(*row, {{low, 1}, new QLabel(tr("to")), {high, 1}});
  form_->addRow(label, both);
  return both;
}

void SamplesBox::buildFiles() {
  planned_ = wrappedLabel("plannedSamples", "hint");
  form_->addRow(planned_);
  generate_ = pushButton(tr("Generate samples"), "generate");
  form_->addRow(generate_);
  auto* files = new QHBoxLayout;
  auto* open =
      pushButton(tr("Open..."), "openSamples",
                 tr("Opens samples of this design or imported ones from files; several parts of one set are joined"));
  save_ = pushButton(tr("Save..."), "saveSamples",
                     tr("Saves NAME.csv for training and NAME-test.csv for testing next to it, as palp sample writes "
                        "them; .h5 and .npz are possible as well"));
  auto* import =
      pushButton(tr("Import..."), "importTable",
                 tr("Imports a table of readings and forces that another rig measured: text, .npz, .h5, .mat"));
  addTo(*files, {open, import, save_});
  form_->addRow(files);
  connect(open, &QPushButton::clicked, this, &SamplesBox::openRequested);
  connect(import, &QPushButton::clicked, this, &SamplesBox::importRequested);
  connect(save_, &QPushButton::clicked, this, &SamplesBox::saveRequested);
  words_ = textLabel("samplesWords");
  words_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  words_->setMinimumHeight(2 * fontMetrics().lineSpacing()); // what is below does not jump
  form_->addRow(words_);
}

void SamplesBox::display(const SampleSettings& samples, const SensorDesign& design, const MeshOptions& mesh) {
  design_ = design;
  mesh_ = mesh;
  if (samples.touches) touches_ = *samples.touches;
  fields_.display(samples);
  const bool touches = samples.touches.has_value();
  kind_->setCurrentIndex(touches ? 1 : 0);
  for (QWidget* row : std::initializer_list<QWidget*>{shape_, press_, friction_, margin_})
    form_->setRowVisible(row, touches);
  form_->setRowVisible(radius_, touches && touches_.shape != IndenterShape::Plane);
  form_->setRowVisible(rim_, touches && touches_.shape == IndenterShape::Flat);
  countLabel_->setText(touches ? tr("Touches") : tr("Per area"));
  countLabel_->setBuddy(touches ? count_ : perArea_);
  perArea_->setVisible(!touches);
  count_->setVisible(touches);
  form_->setRowVisible(surrogate_, !touches);
  check();
}

/// Refuses what cannot be sampled before a long computation starts.
void SamplesBox::check() {
  std::optional<std::string> wrong;
  if (settings().touches) wrong = whyInvalid(rangeOf(*settings().touches, design_), design_);
  const double half_mm = design_.block_mm.head<2>().minCoeff() / 2;
  if (wrong && settings().touches->margin_mm > half_mm) // named as the field is
    problem_->setText(tr("Margin to the edges: got %1 mm, expected at most %2 mm, half of the block's shorter side")
                          .arg(settings().touches->margin_mm)
                          .arg(half_mm));
  else
    problem_->setText(wrong ? QString::fromStdString(*wrong) : QString());
  form_->setRowVisible(problem_, wrong.has_value());
  generate_->setEnabled(!wrong);
  planned_->say(wrong ? QString() : plannedWords(settings(), design_, mesh_));
}

void SamplesBox::displayState(bool there, const QString& words, bool goOn) {
  words_->setText(words);
  save_->setEnabled(there);
  check(); // the time that samples take may be known better
  generate_->setText(goOn ? tr("Continue generating samples") : tr("Generate samples"));
}

/// Touches start as the usual ones of the design, or as they were last.
void SamplesBox::readKind() {
  const bool touches = kind_->currentIndex() == 1;
  if (touches == settings().touches.has_value()) return;
  fields_.edit(tr("Change what is sampled"), [&](SampleSettings& samples) {
    samples.touches.reset();
    if (touches) samples.touches = touches_ == TouchSampling() ? usualTouches(design_) : touches_;
  });
}

} // namespace palp
