#include "app/gui/network/NetworkPanel.h"

#include "app/gui/network/AdvancedOptions.h"
#include "app/gui/network/NetworkCharts.h"
#include "app/gui/network/NetworkTables.h"
#include "app/gui/network/SamplesBox.h"
#include "app/gui/network/words/FitWords.h"
#include "app/gui/widgets/SpinBoxes.h"
#include "app/gui/widgets/WrappedLabel.h"
#include "model/base/Error.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QSpinBox>
#include <QVBoxLayout>

#include <algorithm>
#include <array>
#include <cmath>

namespace palp {

namespace {

// The slider runs over the logarithm of the spread.
constexpr double kLeastNoise = 1e-6; ///< of a board's readings, relative
constexpr double kLowSpread = 0.05, kHighSpread = 50;
constexpr int kSpreadSteps = 300;
double spreadAt(int step) {
  return kLowSpread * std::pow(kHighSpread / kLowSpread, double(step) / kSpreadSteps);
}
int stepOf(double spread) {
  const double share = std::log(spread / kLowSpread) / std::log(kHighSpread / kLowSpread);
  return static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * kSpreadSteps));
}

QDoubleSpinBox* spreadBox(const char* name) {
  auto* box = new NumberBox;
  box->setObjectName(name);
  box->setRange(0.01, 1000);
  box->setDecimals(3);
  box->setKeyboardTracking(false);
  return box;
}

} // namespace

NetworkPanel::NetworkPanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 6, 0);
  buildSamples(*column);
  buildTraining(*column);
  buildSweep(*column);
  column->addStretch(1);
}

void NetworkPanel::buildSamples(QVBoxLayout& column) {
  samplesBox_ = new SamplesBox;
  column.addWidget(samplesBox_);
  connect(samplesBox_, &SamplesBox::edited, this,
          [this](const QString& what) { emit edited(what, samplesBox_->settings(), network_); });
  connect(samplesBox_, &SamplesBox::generateAsked, this, &NetworkPanel::generateAsked);
  connect(samplesBox_, &SamplesBox::openAsked, this, &NetworkPanel::openSamplesAsked);
  connect(samplesBox_, &SamplesBox::saveAsked, this, &NetworkPanel::saveSamplesAsked);
}

void NetworkPanel::buildTraining(QVBoxLayout& column) {
  auto* box = new QGroupBox(tr("Network"));
  auto* form = new QFormLayout(box);
  buildInput(*form);
  buildNetwork(*form);
  buildSpread(*form);
  advanced_ = new AdvancedOptions;
  form->addRow(advanced_);
  connect(advanced_, &AdvancedOptions::edited, this, &NetworkPanel::read);
  train_ = new QPushButton(tr("Train"));
  train_->setObjectName("train");
  form->addRow(train_);
  auto* follows = new WrappedLabel(
      tr("Once there is a network, each change above trains immediately and is kept in the tab Trained networks."));
  follows->setObjectName("trainsAtOnce");
  follows->setProperty("role", "hint");
  form->addRow(follows);
  connect(train_, &QPushButton::clicked, this, &NetworkPanel::trainAsked);
  column.addWidget(box);
}

/// What the network reads.
void NetworkPanel::buildInput(QFormLayout& form) {
  input_ = new QComboBox;
  input_->setObjectName("input");
  input_->addItems({tr("Displacements (Table 1)"), tr("Resistances (Fig. 12)")});
  form.addRow(tr("Input"), input_);
  forLive_ = new QPushButton(tr("Set for a board (Live)"));
  forLive_->setObjectName("forLive");
  forLive_->setToolTip(
      tr("Selects the resistances of all row-wires with the noise of the simulated board. A network of displacements "
         "cannot read a board, and a network trained without noise amplifies the noise."));
  form.addRow(QString(), forLive_);
  connect(forLive_, &QPushButton::clicked, this, &NetworkPanel::takeLiveSettings);
  rows_ = new QLineEdit;
  rows_->setObjectName("rows");
  rows_->setToolTip(tr(
      "Row-wires whose resistances or electrode displacements are read, counted from 0: 4, or 1,4,7, or 2-5, or all"));
  form.addRow(tr("Row-wires"), rows_);
  rowsProblem_ = new WrappedLabel;
  rowsProblem_->setObjectName("rowsProblem");
  rowsProblem_->setProperty("role", "problem");
  rowsProblem_->hide();
  rowsHint_ = new WrappedLabel(tr("Counted from 0: 4, or 1,4,7, or 2-5, or all"));
  rowsHint_->setProperty("role", "hint");
  auto* room = new QWidget; // always there: no field moves when a problem comes or goes
  room->setMinimumHeight(2 * fontMetrics().lineSpacing());
  auto* column = new QVBoxLayout(room);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(rowsHint_);
  column->addWidget(rowsProblem_);
  column->addStretch(1);
  form.addRow(room);
  connect(input_, &QComboBox::currentIndexChanged, this, [this] { read(tr("Change the network's input")); });
  connect(rows_, &QLineEdit::editingFinished, this, [this] { readRows(); });
}

/// What it is, and the noise that it is trained with.
void NetworkPanel::buildNetwork(QFormLayout& form) {
  mode_ = new QComboBox;
  mode_->setObjectName("mode");
  mode_->addItems({tr("Default"), tr("Paper")});
  mode_->setToolTip(tr("Default: one global scale, linear tail, leave-one-out. Paper: as described in the paper."));
  form.addRow(tr("Mode"), mode_);
  decoder_ = new QComboBox;
  decoder_->setObjectName("decoder");
  for (const auto& [kind, text] : kDecoderKinds.all()) {
    decoder_->addItem(QString::fromStdString(text));
    decoder_->setItemData(decoder_->count() - 1, QString(traits(kind).description), Qt::ToolTipRole);
  }
  decoder_->setToolTip(
      tr("Method that maps the readings to the force: rbf is the paper's radial basis function network, ml is maximum "
         "likelihood, gp is a Gaussian process; the tab Decoders describes all"));
  form.addRow(tr("Decoder"), decoder_);
  target_ = new QComboBox;
  target_->setObjectName("target");
  target_->addItems({tr("Force"), tr("Force and position")});
  target_->setToolTip(tr("Outputs of the decoder. The position is known for touches and for measured samples that "
                         "include it. It needs all row-wires, as a single one cannot tell on which side of it a touch "
                         "is. The decoder touch is made for both outputs and trains in about a minute."));
  form.addRow(tr("Outputs"), target_);
  centers_ = new WholeBox;
  centers_->setObjectName("centers");
  centers_->setRange(0, 100000);
  centers_->setSpecialValueText(tr("From mode"));
  centers_->setKeyboardTracking(false);
  centers_->setToolTip(
      tr("Number of centres of the radial basis functions; fewer centres than samples make a smoother network"));
  form.addRow(tr("Centres"), centers_);
  noise_ = new PercentBox;
  noise_->setObjectName("noise");
  noise_->setRange(0, 10);
  noise_->setDecimals(8);
  noise_->setKeyboardTracking(false);
  noise_->setToolTip(
      tr("Relative noise of each input in training, in percent or as a ratio with an exponent (1e-4 is 0.01 %)"));
  form.addRow(tr("Noise"), noise_);
  testNoise_ = new PercentBox;
  testNoise_->setObjectName("testNoise");
  testNoise_->setRange(0, 50);
  testNoise_->setDecimals(8);
  testNoise_->setKeyboardTracking(false);
  testNoise_->setToolTip(tr("Relative noise of the test samples, separate from that of the training, in percent or as "
                            "a ratio with an exponent (1e-4 is 0.01 %)"));
  form.addRow(tr("Test noise"), testNoise_);
  noiseWords_ = new WrappedLabel;
  noiseWords_->setObjectName("noiseWords");
  noiseWords_->setProperty("role", "hint");
  form.addRow(QString(), noiseWords_);
  connect(mode_, &QComboBox::currentIndexChanged, this, [this] { read(tr("Change the network's mode")); });
  connect(decoder_, &QComboBox::currentIndexChanged, this, [this] {
    if (displaying_) return;
    const QSignalBlocker quiet(target_); // one edit
    const auto chosen = kDecoderKinds.value(decoder_->currentText().toStdString());
    if (!traits(chosen).ofAreas && network_.decoder != chosen)
      targetBefore_ = std::exchange(network_.target, DecoderTarget::ForceAndPlace);
    else if (!traits(network_.decoder).ofAreas && targetBefore_)
      network_.target = *std::exchange(targetBefore_, {});
    target_->setCurrentIndex(network_.target == DecoderTarget::Force ? 0 : 1);
    read(tr("Change the decoder"));
  });
  connect(target_, &QComboBox::currentIndexChanged, this, [this] { read(tr("Change the outputs")); });
  connect(centers_, &QSpinBox::valueChanged, this, [this] { read(tr("Change the centres")); });
  connect(noise_, &QDoubleSpinBox::valueChanged, this, [this] { read(tr("Change the noise")); });
  connect(testNoise_, &QDoubleSpinBox::valueChanged, this, [this] { read(tr("Change the test noise")); });
}

void NetworkPanel::buildSpread(QFormLayout& form) {
  automatic_ = new QCheckBox(tr("By leave-one-out"));
  automatic_->setObjectName("automaticSpread");
  spread_ = spreadBox("spread");
  spread_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed); // however many digits: the panel keeps its width
  spread_->setToolTip(tr("Spread of the Gaussians (radbas: half height at this distance, in scaled inputs)"));
  form.addRow(tr("Spread"), spread_);
  paper_ = new QPushButton;
  paper_->setObjectName("paperSpread");
  auto* row = new QHBoxLayout;
  row->addWidget(automatic_, 1);
  row->addWidget(paper_);
  form.addRow(row);
  spreadSlider_ = new QSlider(Qt::Horizontal);
  spreadSlider_->setObjectName("spreadSlider");
  spreadSlider_->setRange(0, kSpreadSteps);
  form.addRow(spreadSlider_);
  connect(automatic_, &QCheckBox::toggled, this, [this] { read(tr("Change the spread")); });
  connect(spread_, &QDoubleSpinBox::valueChanged, this, [this] { read(tr("Change the spread")); });
  connect(spreadSlider_, &QSlider::sliderPressed, this, [this] { ++slides_; });
  connect(spreadSlider_, &QSlider::valueChanged, this, [this](int step) {
    if (displaying_) return;
    sliding_ = true;
    spread_->setValue(spreadAt(step));
    sliding_ = false;
  });
  connect(paper_, &QPushButton::clicked, this, [this] {
    const QSignalBlocker quietBox(spread_), quietCheck(automatic_); // one edit
    spread_->setValue(paperSpread(network_.input));
    automatic_->setChecked(false);
    read(tr("Take the paper's spread"));
  });
}

void NetworkPanel::buildSweep(QVBoxLayout& column) {
  auto* box = new QGroupBox(tr("Sweep of the spread"));
  auto* form = new QFormLayout(box);
  from_ = spreadBox("sweepFrom");
  to_ = spreadBox("sweepTo");
  count_ = new WholeBox;
  count_->setObjectName("sweepCount");
  count_->setRange(2, 100);
  count_->setSuffix(tr(" spreads"));
  auto* row = new QHBoxLayout;
  row->addWidget(from_, 1);
  row->addWidget(new QLabel(tr("to")));
  row->addWidget(to_, 1);
  form->addRow(row);
  form->addRow(count_);
  sweep_ = new QPushButton(tr("Sweep"));
  sweep_->setObjectName("sweep");
  form->addRow(sweep_);
  compare_ = new QPushButton(tr("Compare all decoders"));
  compare_->setObjectName("compare");
  form->addRow(compare_);
  column.addWidget(box);
  for (QDoubleSpinBox* spin : {from_, to_})
    connect(spin, &QDoubleSpinBox::valueChanged, this, [this] { read(tr("Change the sweep")); });
  connect(count_, &QSpinBox::valueChanged, this, [this] { read(tr("Change the sweep")); });
  connect(sweep_, &QPushButton::clicked, this, &NetworkPanel::sweepAsked);
  connect(compare_, &QPushButton::clicked, this, &NetworkPanel::compareAsked);
}

void NetworkPanel::display(const Project& project, int rowWires) {
  displaying_ = true;
  samplesBox_->display(project.samples, project.design, project.mesh);
  network_ = project.network;
  input_->setCurrentIndex(network_.input == InputKind::Displacement ? 0 : 1);
  mode_->setCurrentIndex(network_.mode == DecoderMode::Default ? 0 : 1);
  decoder_->setCurrentText(QString::fromStdString(name(network_.decoder)));
  target_->setCurrentIndex(network_.target == DecoderTarget::Force ? 0 : 1);
  // The decoder of touches learns both; an older file may say otherwise.
  target_->setEnabled(traits(network_.decoder).ofAreas || network_.target == DecoderTarget::Force);
  rows_->setText(QString::fromStdString(network_.rows));
  rowWires_ = rowWires;
  showRowsProblem({});
  showExactly(*testNoise_, 100 * network_.testNoise);
  advanced_->display(network_);
  centers_->setValue(network_.centers.value_or(0));
  showExactly(*noise_, 100 * network_.noise);
  automatic_->setChecked(network_.automaticSpread);
  showSixDigits(*from_, network_.sweepFrom);
  showSixDigits(*to_, network_.sweepTo);
  count_->setValue(network_.sweepCount);
  boardNoise_ = std::max(project.live.simulation.noise, kLeastNoise);
  forLive_->setEnabled(!readableLive());
  showSpread();
  showNoise();
  displaying_ = false;
}

bool NetworkPanel::readableLive() const {
  return network_.input == InputKind::Resistance && network_.rows == "all" && network_.noise >= boardNoise_;
}

void NetworkPanel::takeLiveSettings() {
  displaying_ = true; // one edit
  input_->setCurrentIndex(1);
  rows_->setText("all");
  showRowsProblem({});
  noise_->setValue(100 * boardNoise_);
  testNoise_->setValue(100 * boardNoise_);
  displaying_ = false;
  read(tr("Set the network for a board"));
}

void NetworkPanel::showNoise() {
  const auto noiseIn = [](double share) { return share > 0 ? percentWords(share) : tr("no noise"); };
  noiseWords_->say(tr("trained with: %1; tested with: %2").arg(noiseIn(network_.noise), noiseIn(network_.testNoise)));
}

void NetworkPanel::showSpread() {
  const bool rbf = traits(network_.decoder).hasRbf;
  const QString paper = QString::number(paperSpread(network_.input), 'g', 4);
  paper_->setText(tr("Paper's: %1").arg(paper));
  paper_->setToolTip(tr("Sets the spread for which the paper prints its smallest errors from this input; the paper "
                        "does not say how it scaled the inputs"));
  paper_->setEnabled(rbf);
  automatic_->setEnabled(rbf);
  centers_->setEnabled(rbf);
  showSixDigits(*spread_, network_.chosenSpread);
  spreadSlider_->setValue(stepOf(network_.chosenSpread));
  spread_->setEnabled(rbf && !network_.automaticSpread);
  spreadSlider_->setEnabled(rbf && !network_.automaticSpread);
}

void NetworkPanel::displaySamples(bool there, const QString& words, bool goOn) {
  samplesBox_->displayState(there, words, goOn);
}

void NetworkPanel::displayReadiness(bool there, bool beingMade) {
  const std::array<std::pair<QPushButton*, QString>, 3> buttons{
      {{train_, tr("Trains the network on the training samples and evaluates it on the test samples")},
       {sweep_, tr("Trains once per spread")},
       {compare_, tr("Trains every kind of decoder on the same samples and compares error and time")}}};
  for (const auto& [button, tip] : buttons) {
    button->setEnabled(there && !beingMade);
    button->setToolTip(beingMade ? tr("Samples are being generated")
                       : there   ? tip
                                 : tr("Generate or open samples first"));
  }
}

void NetworkPanel::displayChosenSpread(double spread) {
  automatic_->setText(spread > 0 ? tr("By leave-one-out: %1").arg(spread, 0, 'g', 4) : tr("By leave-one-out"));
}

/// In the place of the hint: no field moves.
void NetworkPanel::showRowsProblem(const QString& sentence) {
  rowsProblem_->say(sentence);
  rowsHint_->setVisible(sentence.isEmpty());
}

/// Rows that the design does not have stay in the field and are not used.
void NetworkPanel::readRows() {
  if (displaying_) return;
  try {
    rowsNamed(rows_->text().trimmed().toStdString(), rowWires_);
  } catch (const Error& error) {
    showRowsProblem(tr("%1. The network uses %2.")
                        .arg(QString::fromStdString(error.what()), QString::fromStdString(network_.rows)));
    return;
  }
  showRowsProblem({});
  read(tr("Change the row-wires"));
}

void NetworkPanel::read(const QString& what) {
  if (displaying_) return;
  if (!sliding_) ++slides_;
  network_.input = input_->currentIndex() == 0 ? InputKind::Displacement : InputKind::Resistance;
  network_.mode = mode_->currentIndex() == 0 ? DecoderMode::Default : DecoderMode::Paper;
  network_.decoder = kDecoderKinds.value(decoder_->currentText().toStdString());
  network_.target = target_->currentIndex() == 0 ? DecoderTarget::Force : DecoderTarget::ForceAndPlace;
  network_.testNoise = readExactly(*testNoise_, network_.testNoise, true);
  advanced_->read(network_);
  if (rowsProblem_->isHidden()) network_.rows = rows_->text().trimmed().toStdString();
  network_.centers = centers_->value() > 0 ? std::optional(centers_->value()) : std::nullopt;
  network_.noise = readExactly(*noise_, network_.noise, true);
  network_.automaticSpread = automatic_->isChecked();
  network_.chosenSpread = readExactly(*spread_, network_.chosenSpread);
  const double from = readExactly(*from_, network_.sweepFrom), to = readExactly(*to_, network_.sweepTo);
  network_.sweepFrom = std::min(from, to);
  network_.sweepTo = std::max(from, to);
  network_.sweepCount = count_->value();
  emit edited(what, samplesBox_->settings(), network_);
}

} // namespace palp
