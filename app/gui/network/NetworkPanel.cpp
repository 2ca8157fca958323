#include "app/gui/network/NetworkPanel.h"

#include "app/gui/network/AdvancedOptions.h"
#include "app/gui/network/NetworkCharts.h"
#include "app/gui/network/NetworkTables.h"
#include "app/gui/network/SamplesBox.h"
#include "app/gui/network/words/FitWords.h"
#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/WrappedLabel.h"
#include "model/base/Error.h"

#include <QFormLayout>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSlider>
#include <QVBoxLayout>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

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

} // namespace

NetworkPanel::NetworkPanel(QWidget* parent)
    : QWidget(parent), fields_([this](const QString& what, const NetworkSettings& next) {
        if (!sliding_) ++slides_;
        emit edited(what, samplesBox_->settings(), next);
      }) {
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
          [this](const QString& what) { emit edited(what, samplesBox_->settings(), fields_.settings()); });
  connect(samplesBox_, &SamplesBox::generateRequested, this, &NetworkPanel::generateRequested);
  connect(samplesBox_, &SamplesBox::openRequested, this, &NetworkPanel::openSamplesRequested);
  connect(samplesBox_, &SamplesBox::importRequested, this, &NetworkPanel::importRequested);
  connect(samplesBox_, &SamplesBox::saveRequested, this, &NetworkPanel::saveSamplesRequested);
}

void NetworkPanel::buildTraining(QVBoxLayout& column) {
  auto* box = new QGroupBox(tr("Network"));
  auto* form = new QFormLayout(box);
  buildInput(*form);
  buildNetwork(*form);
  buildSpread(*form);
  advanced_ = new AdvancedOptions;
  form->addRow(advanced_);
  connect(advanced_, &AdvancedOptions::edited, this, [this](const QString& what) {
    fields_.edit(what, [this](NetworkSettings& network) { advanced_->read(network); });
  });
  train_ = pushButton(tr("Train"), "train");
  form->addRow(train_);
  form->addRow(wrappedLabel(
      "trainsAtOnce", "hint",
      tr("Once there is a network, each change above trains immediately and is kept in the tab Trained networks.")));
  connect(train_, &QPushButton::clicked, this, &NetworkPanel::trainRequested);
  column.addWidget(box);
}

/// What the network reads.
void NetworkPanel::buildInput(QFormLayout& form) {
  form.addRow(tr("Input"),
              fields_.bind(choiceBox("input", {tr("Displacements (Table 1)"), tr("Resistances (Fig. 12)")}, {}),
                           tr("Change the network's input"), &NetworkSettings::input));
  forLive_ = pushButton(
      tr("Set for a board (Live)"), "forLive",
      tr("Selects the resistances of all row-wires with the noise of the simulated board. A network of displacements "
         "cannot read a board, and a network trained without noise amplifies the noise."));
  form.addRow(QString(), forLive_);
  connect(forLive_, &QPushButton::clicked, this, &NetworkPanel::takeLiveSettings);
  rows_ = lineEdit("rows", tr("Row-wires whose resistances or electrode displacements are read, counted from 0: 4, or "
                              "1,4,7, or 2-5, or all"));
  form.addRow(tr("Row-wires"), rows_);
  rowsProblem_ = wrappedLabel("rowsProblem", "problem");
  rowsProblem_->hide();
  rowsHint_ = new WrappedLabel(tr("Counted from 0: 4, or 1,4,7, or 2-5, or all"));
  rowsHint_->setProperty("role", "hint");
  auto* room = new QWidget; // always there: no field moves when a problem comes or goes
  room->setMinimumHeight(2 * fontMetrics().lineSpacing());
  auto* column = new QVBoxLayout(room);
  column->setContentsMargins(0, 0, 0, 0);
  addTo(*column, {rowsHint_, rowsProblem_, Part::stretch()});
  form.addRow(room);
  connect(rows_, &QLineEdit::editingFinished, this, [this] { readRows(); });
}

/// The decoder and the noise that it is trained with.
void NetworkPanel::buildNetwork(QFormLayout& form) {
  form.addRow(tr("Mode"), fields_.bind(choiceBox("mode", {tr("Default"), tr("Paper")},
                                                 tr("Default: one global scale, linear tail, leave-one-out. Paper: as "
                                                    "described in the paper.")),
                                       tr("Change the network's mode"), &NetworkSettings::mode));
  auto* decoder = choiceBox(
      "decoder", {},
      tr("Method that maps the readings to the force: rbf is the paper's radial basis function network, ml is maximum "
         "likelihood, gp is a Gaussian process; the tab Decoders describes all"));
  for (const auto& [kind, text] : kDecoderKinds.all()) {
    decoder->addItem(QString::fromStdString(text));
    decoder->setItemData(decoder->count() - 1, QString(traits(kind).description), Qt::ToolTipRole);
  }
  fields_.add(
      decoder, &QComboBox::currentIndexChanged, tr("Change the decoder"),
      [this, decoder] { decoder->setCurrentText(QString::fromStdString(name(fields_.settings().decoder))); },
      [this](NetworkSettings& network, int index) {
        const DecoderKind chosen = kDecoderKinds.all()[static_cast<std::size_t>(index)].first;
        if (!traits(chosen).ofAreas && network.decoder != chosen)
          targetBefore_ = std::exchange(network.target, DecoderTarget::ForceAndPlace);
        else if (!traits(network.decoder).ofAreas && targetBefore_)
          network.target = *std::exchange(targetBefore_, {});
        network.decoder = chosen;
      });
  form.addRow(tr("Decoder"), decoder);
  target_ = fields_.bind(
      choiceBox("target", {tr("Force"), tr("Force and position")},
                tr("Outputs of the decoder. The position is known for touches and for measured samples that include "
                   "it. It needs all row-wires, as a single one cannot tell on which side of it a touch is. The "
                   "decoder touch is made for both outputs and trains in about a minute.")),
      tr("Change the outputs"), &NetworkSettings::target);
  form.addRow(tr("Outputs"), target_);
  centers_ = wholeBox(
      "centers", {.high = 100000, .special = tr("From mode")},
      tr("Number of centres of the radial basis functions; fewer centres than samples make a smoother network"));
  fields_.add(
      centers_, &QSpinBox::valueChanged, tr("Change the centres"),
      [this] { centers_->setValue(fields_.settings().centers.value_or(0)); },
      [](NetworkSettings& network, int centers) {
        network.centers = centers > 0 ? std::optional(centers) : std::nullopt;
      });
  form.addRow(tr("Centres"), centers_);
  form.addRow(tr("Noise"), fields_.bind(percentBox("noise", 10,
                                                   tr("Relative noise of each input in training, in percent or as a "
                                                      "ratio with an exponent (1e-4 is 0.01 %)")),
                                        tr("Change the noise"), &NetworkSettings::noise, 100));
  form.addRow(
      tr("Test noise"),
      fields_.bind(percentBox("testNoise", 50,
                              tr("Relative noise of the test samples, separate from that of the training, in percent "
                                 "or as a ratio with an exponent (1e-4 is 0.01 %)")),
                   tr("Change the test noise"), &NetworkSettings::testNoise, 100));
  noiseWords_ = wrappedLabel("noiseWords", "hint");
  form.addRow(QString(), noiseWords_);
}

void NetworkPanel::buildSpread(QFormLayout& form) {
  const QString what = tr("Change the spread");
  automatic_ =
      fields_.bind(checkBox(tr("By leave-one-out"), "automaticSpread"), what, &NetworkSettings::automaticSpread);
  spread_ = addSpread("spread", what, &NetworkSettings::chosenSpread);
  spread_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed); // however many digits: the panel keeps its width
  spread_->setToolTip(tr("Spread of the Gaussians (radbas: half height at this distance, in scaled inputs)"));
  form.addRow(tr("Spread"), spread_);
  paper_ = pushButton(QString(), "paperSpread",
                      tr("Sets the spread for which the paper prints its smallest errors from this input; the paper "
                         "does not specify how it scaled the inputs"));
  form.addRow(inRow({{automatic_, 1}, paper_}));
  spreadSlider_ = new QSlider(Qt::Horizontal);
  spreadSlider_->setObjectName("spreadSlider");
  spreadSlider_->setRange(0, kSpreadSteps);
  form.addRow(spreadSlider_);
  connect(spreadSlider_, &QSlider::sliderPressed, this, [this] { ++slides_; });
  connect(spreadSlider_, &QSlider::valueChanged, this, [this](int step) {
    sliding_ = true;
    spread_->setValue(spreadAt(step));
    sliding_ = false;
  });
  connect(paper_, &QPushButton::clicked, this, [this] {
    fields_.edit(tr("Use the paper's spread"), [](NetworkSettings& network) {
      network.chosenSpread = paperSpread(network.input);
      network.automaticSpread = false;
    });
  });
}

QDoubleSpinBox* NetworkPanel::addSpread(const QString& id, const QString& what, double NetworkSettings::*spread) {
  auto* box = numberBox(id, {.low = 0.01, .high = 1000, .decimals = 3}, {});
  return fields_.add(
      box, &QDoubleSpinBox::valueChanged, what,
      [this, box, spread] { showSixDigits(*box, fields_.settings().*spread); },
      [box, spread](NetworkSettings& network, double /*value*/) {
        network.*spread = readExactly(*box, network.*spread);
        if (network.sweepFrom > network.sweepTo) std::swap(network.sweepFrom, network.sweepTo);
      });
}

void NetworkPanel::buildSweep(QVBoxLayout& column) {
  auto* box = new QGroupBox(tr("Sweep of the spread"));
  auto* form = new QFormLayout(box);
  const QString what = tr("Change the sweep");
  auto* from = addSpread("sweepFrom", what, &NetworkSettings::sweepFrom);
  auto* to = addSpread("sweepTo", what, &NetworkSettings::sweepTo);
  form->addRow(inRow({{from, 1}, new QLabel(tr("to")), {to, 1}}));
  form->addRow(
      fields_.bind(wholeBox("sweepCount", {.low = 2, .high = 100, .unit = tr(" spreads"), .whileTyping = true}, {}),
                   what, &NetworkSettings::sweepCount));
  sweep_ = pushButton(tr("Sweep"), "sweep");
  form->addRow(sweep_);
  compare_ = pushButton(tr("Compare all decoders"), "compare");
  form->addRow(compare_);
  column.addWidget(box);
  connect(sweep_, &QPushButton::clicked, this, &NetworkPanel::sweepRequested);
  connect(compare_, &QPushButton::clicked, this, &NetworkPanel::compareRequested);
}

void NetworkPanel::display(const Project& project, int rowWires) {
  samplesBox_->display(project.samples, project.design, project.mesh);
  const NetworkSettings& network = project.network;
  fields_.display(network);
  // The decoder of touches learns both; an older file may have another setting.
  target_->setEnabled(traits(network.decoder).ofAreas || network.target == DecoderTarget::Force);
  rows_->setText(QString::fromStdString(network.rows));
  rowWires_ = rowWires;
  showRowsProblem({});
  advanced_->display(network);
  boardNoise_ = std::max(project.live.simulation.noise, kLeastNoise);
  forLive_->setEnabled(network.input != InputKind::Resistance || network.rows != "all" || network.noise < boardNoise_);
  showSpread();
  showNoise();
}

void NetworkPanel::takeLiveSettings() {
  fields_.edit(tr("Set the network for a board"), [this](NetworkSettings& network) {
    network.input = InputKind::Resistance;
    network.rows = "all";
    network.noise = network.testNoise = boardNoise_;
  });
}

void NetworkPanel::showNoise() {
  const auto noiseIn = [](double share) { return share > 0 ? percentWords(share) : tr("no noise"); };
  noiseWords_->say(tr("trained with: %1; tested with: %2")
                       .arg(noiseIn(fields_.settings().noise), noiseIn(fields_.settings().testNoise)));
}

void NetworkPanel::showSpread() {
  const NetworkSettings& network = fields_.settings();
  const bool rbf = traits(network.decoder).hasRbf;
  paper_->setText(tr("Paper's: %1").arg(QString::number(paperSpread(network.input), 'g', 4)));
  for (QWidget* widget : std::initializer_list<QWidget*>{paper_, automatic_, centers_}) widget->setEnabled(rbf);
  const QSignalBlocker quiet(spreadSlider_);
  spreadSlider_->setValue(stepOf(network.chosenSpread));
  for (QWidget* widget : std::initializer_list<QWidget*>{spread_, spreadSlider_})
    widget->setEnabled(rbf && !network.automaticSpread);
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
  try {
    rowsNamed(rows_->text().trimmed().toStdString(), rowWires_);
  } catch (const Error& error) {
    showRowsProblem(tr("%1. The network uses %2.")
                        .arg(QString::fromStdString(error.what()), QString::fromStdString(fields_.settings().rows)));
    return;
  }
  showRowsProblem({});
  fields_.edit(tr("Change the row-wires"),
               [this](NetworkSettings& network) { network.rows = rows_->text().trimmed().toStdString(); });
}

} // namespace palp
