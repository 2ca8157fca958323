#include "app/gui/network/SamplesBox.h"

#include "app/gui/network/words/SamplesWords.h"
#include "app/gui/widgets/ShapeWords.h"
#include "app/gui/widgets/SpinBoxes.h"
#include "app/gui/widgets/WrappedLabel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>

#include <algorithm>
#include <tuple>

namespace palp {

namespace {

constexpr double kMost_mm = 1000, kMost_N = 1000;
constexpr double kMostFriction = 2;

} // namespace

SamplesBox::SamplesBox(QWidget* parent) : QGroupBox(tr("Samples"), parent) {
  form_ = new QFormLayout(this);
  kind_ = new QComboBox;
  kind_->setObjectName("sampleKind");
  kind_->addItems({tr("Forces on areas"), tr("Touches anywhere")});
  kind_->setToolTip(tr("Uniform forces on the load areas, as in the paper, or an indenter that presses anywhere on the "
                       "top face; a network trained on touches can also decode the position"));
  form_->addRow(tr("Samples of"), kind_);
  perArea_ = new WholeBox;
  perArea_->setObjectName("perArea");
  perArea_->setRange(5, 100000);
  perArea_->setKeyboardTracking(false);
  perArea_->setCorrectionMode(QAbstractSpinBox::CorrectToNearestValue);
  perArea_->setToolTip(
      tr("Number of random forces per area for training, and as many again for testing; the paper has 100"));
  count_ = new WholeBox;
  count_->setObjectName("touchCount");
  count_->setRange(kFewestTouches, kMostTouches);
  count_->setKeyboardTracking(false);
  count_->setCorrectionMode(QAbstractSpinBox::CorrectToNearestValue);
  count_->setToolTip(tr("Number of random touches for training, and as many again for testing"));
  auto* either = new QWidget; // in one row: of two the first did not come back where the second had been (Qt 6.4)
  auto* boxes = new QHBoxLayout(either);
  boxes->setContentsMargins(0, 0, 0, 0);
  boxes->addWidget(perArea_);
  boxes->addWidget(count_);
  countLabel_ = new QLabel;
  form_->addRow(countLabel_, either);
  buildTouches();
  seed_ = new WholeBox;
  seed_->setObjectName("seed");
  seed_->setKeyboardTracking(false);
  seed_->setRange(0, 1000000000);
  seed_->setToolTip(tr("The same seed gives the same samples"));
  form_->addRow(tr("Seed of samples"), seed_);
  surrogate_ = new QCheckBox(tr("Use a surrogate model"));
  surrogate_->setObjectName("surrogate");
  surrogate_->setToolTip(tr("Samples a polynomial fitted to full solves on each area: many samples in seconds, with a "
                            "measured error that is shown"));
  form_->addRow(QString(), surrogate_);
  buildFiles();
  connect(kind_, &QComboBox::activated, this, &SamplesBox::readKind);
  connect(perArea_, &QSpinBox::valueChanged, this, [this] { read(tr("Change the number of samples")); });
  connect(count_, &QSpinBox::valueChanged, this, [this] { read(tr("Change the number of samples")); });
  connect(seed_, &QSpinBox::valueChanged, this, [this] { read(tr("Change the seed")); });
  connect(surrogate_, &QCheckBox::toggled, this, [this] { read(tr("Change the method of sampling")); });
  connect(generate_, &QPushButton::clicked, this, &SamplesBox::generateAsked);
}

/// The indenter and how it presses.
void SamplesBox::buildTouches() {
  shape_ = new QComboBox;
  shape_->setObjectName("touchShape");
  for (const auto& [shape, name] : kIndenterShapes.all()) shape_->addItem(inWords(shape));
  shape_->setToolTip(tr("Shape of the rigid indenter, the same for all touches; its size is random"));
  form_->addRow(tr("Indenter"), shape_);
  connect(shape_, &QComboBox::activated, this, [this] { read(tr("Change the indenter of the samples")); });
  radius_ = range("touchRadius", tr("Radius"), kMost_mm, tr(" mm"),
                  tr("Radius of the indenter, uniformly distributed over this range"));
  rim_ = number("touchRim", tr("Edge radius"), 0, kMost_mm, tr(" mm"));
  rim_->setToolTip(tr("Radius of the punch's rounded edge"));
  form_->addRow(tr("Edge radius"), rim_);
  press_ =
      range("touchPress", tr("Force"), kMost_N, tr(" N"), tr("Downward force, uniformly distributed over this range"));
  friction_ =
      range("touchFriction", tr("Friction"), kMostFriction, {},
            tr("Coulomb's coefficient of friction. At 0, touches press straight down; with friction they also push "
               "tangentially, up to 0.7 of the friction limit, and each solve takes about five times as long."));
  margin_ = number("touchMargin", tr("Margin"), 0, kMost_mm, tr(" mm"));
  margin_->setToolTip(tr("Smallest distance of a touch from the sides of the block"));
  form_->addRow(tr("Margin to the edges"), margin_);
  problem_ = new QLabel;
  problem_->setObjectName("touchProblem");
  problem_->setProperty("role", "problem");
  problem_->setWordWrap(true);
  form_->addRow(problem_);
}

QDoubleSpinBox* SamplesBox::number(const char* name, const QString& label, double low, double high,
                                   const QString& unit) {
  auto* box = new NumberBox;
  box->setObjectName(name);
  box->setAccessibleName(tr("Touches, %1").arg(label));
  box->setRange(low, high);
  box->setDecimals(2);
  box->setSingleStep(0.1);
  box->setSuffix(unit);
  box->setKeyboardTracking(false);
  connect(box, &QDoubleSpinBox::valueChanged, this, [this] { read(tr("Change the touches of the samples")); });
  return box;
}

SamplesBox::Pair SamplesBox::range(const char* name, const QString& label, double high, const QString& unit,
                                   const QString& tip) {
  const QByteArray least = QByteArray(name) + "Minimum", most = QByteArray(name) + "Maximum";
  const Pair pair{number(least.constData(), tr("%1, minimum").arg(label), 0, high, {}),
                  number(most.constData(), tr("%1, maximum").arg(label), 0, high, unit)};
  auto* both = new QWidget;
  auto* row = new QHBoxLayout(both);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(pair[0], 1);
  row->addWidget(new QLabel(tr("to")));
  row->addWidget(pair[1], 1);
  for (QDoubleSpinBox* box : pair) {
    box->setToolTip(tip);
    box->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed); // the panel keeps its width
  }
  form_->addRow(label, both);
  return pair;
}

void SamplesBox::buildFiles() {
  planned_ = new WrappedLabel;
  planned_->setObjectName("plannedSamples");
  planned_->setProperty("role", "hint");
  form_->addRow(planned_);
  generate_ = new QPushButton(tr("Generate samples"));
  generate_->setObjectName("generate");
  form_->addRow(generate_);
  auto* files = new QHBoxLayout;
  auto* open = new QPushButton(tr("Open..."));
  open->setObjectName("openSamples");
  open->setToolTip(tr("Opens samples of this design or imported ones from files; several parts of one set are joined"));
  save_ = new QPushButton(tr("Save..."));
  save_->setObjectName("saveSamples");
  save_->setToolTip(tr("Saves NAME.csv for training and NAME-test.csv for testing next to it, as palp sample writes "
                       "them; .h5 and .npz are possible as well"));
  files->addWidget(open);
  files->addWidget(save_);
  form_->addRow(files);
  connect(open, &QPushButton::clicked, this, &SamplesBox::openAsked);
  connect(save_, &QPushButton::clicked, this, &SamplesBox::saveAsked);
  words_ = new QLabel;
  words_->setObjectName("samplesWords");
  words_->setWordWrap(true);
  words_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  words_->setMinimumHeight(2 * fontMetrics().lineSpacing()); // what is below does not jump
  form_->addRow(words_);
}

void SamplesBox::display(const SampleSettings& samples, const SensorDesign& design, const MeshOptions& mesh) {
  displaying_ = true;
  samples_ = samples;
  design_ = design;
  mesh_ = mesh;
  if (samples.touches) touches_ = *samples.touches;
  kind_->setCurrentIndex(samples.touches ? 1 : 0);
  perArea_->setValue(samples.perArea);
  seed_->setValue(static_cast<int>(samples.seed));
  surrogate_->setChecked(samples.surrogate);
  showTouches();
  check();
  displaying_ = false;
}

void SamplesBox::showTouches() {
  count_->setValue(touches_.count);
  const auto& shapes = kIndenterShapes.all();
  const auto its =
      std::find_if(shapes.begin(), shapes.end(), [&](const auto& shape) { return shape.first == touches_.shape; });
  shape_->setCurrentIndex(static_cast<int>(its - shapes.begin()));
  const auto show = [](const Pair& pair, double least, double most) {
    showExactly(*pair[0], least);
    showExactly(*pair[1], most);
  };
  show(radius_, touches_.smallest_mm, touches_.largest_mm);
  show(press_, touches_.leastPress_N, touches_.mostPress_N);
  show(friction_, touches_.leastFriction, touches_.mostFriction);
  showExactly(*rim_, touches_.rim_mm);
  showExactly(*margin_, touches_.margin_mm);
  const bool touches = samples_.touches.has_value();
  for (QWidget* row :
       std::initializer_list<QWidget*>{shape_, press_[0]->parentWidget(), friction_[0]->parentWidget(), margin_})
    form_->setRowVisible(row, touches);
  form_->setRowVisible(radius_[0]->parentWidget(), touches && touches_.shape != IndenterShape::Plane);
  form_->setRowVisible(rim_, touches && touches_.shape == IndenterShape::Flat);
  countLabel_->setText(touches ? tr("Touches") : tr("Per area"));
  countLabel_->setBuddy(touches ? count_ : perArea_);
  perArea_->setVisible(!touches);
  count_->setVisible(touches);
  form_->setRowVisible(surrogate_, !touches);
}

/// What cannot be sampled is said before anybody waits for it.
void SamplesBox::check() {
  std::optional<std::string> wrong;
  if (samples_.touches) wrong = whyInvalid(rangeOf(*samples_.touches, design_), design_);
  const double half_mm = design_.block_mm.head<2>().minCoeff() / 2;
  if (wrong && samples_.touches->margin_mm > half_mm) // in the words of the field
    problem_->setText(tr("Margin to the edges: got %1 mm, expected at most %2 mm, half of the block's shorter side")
                          .arg(samples_.touches->margin_mm)
                          .arg(half_mm));
  else
    problem_->setText(wrong ? QString::fromStdString(*wrong) : QString());
  form_->setRowVisible(problem_, wrong.has_value());
  generate_->setEnabled(!wrong);
  planned_->say(wrong ? QString() : plannedWords(samples_, design_, mesh_));
}

void SamplesBox::displayState(bool there, const QString& words, bool goOn) {
  words_->setText(words);
  save_->setEnabled(there);
  check(); // the time that samples take may be known better
  generate_->setText(goOn ? tr("Continue generating samples") : tr("Generate samples"));
}

/// The first touches are the usual ones of the design, later ones those of before.
void SamplesBox::readKind() {
  const bool touches = kind_->currentIndex() == 1;
  if (displaying_ || touches == samples_.touches.has_value()) return;
  samples_.touches.reset();
  if (touches) samples_.touches = touches_ == TouchSampling() ? usualTouches(design_) : touches_;
  emit edited(tr("Change what is sampled"));
}

void SamplesBox::read(const QString& what) {
  if (displaying_) return;
  samples_.perArea = perArea_->value();
  samples_.seed = static_cast<std::uint64_t>(seed_->value());
  samples_.surrogate = surrogate_->isChecked();
  if (samples_.touches) {
    TouchSampling& touches = *samples_.touches;
    touches.count = count_->value();
    touches.shape = kIndenterShapes.all()[static_cast<std::size_t>(shape_->currentIndex())].first;
    const auto ordered = [](const Pair& pair) { return std::minmax({pair[0]->value(), pair[1]->value()}); };
    std::tie(touches.smallest_mm, touches.largest_mm) = ordered(radius_);
    std::tie(touches.leastPress_N, touches.mostPress_N) = ordered(press_);
    std::tie(touches.leastFriction, touches.mostFriction) = ordered(friction_);
    touches.rim_mm = rim_->value();
    touches.margin_mm = margin_->value();
  }
  emit edited(what);
}

} // namespace palp
