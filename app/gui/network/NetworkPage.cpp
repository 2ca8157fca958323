#include "app/gui/network/NetworkPage.h"

#include "app/gui/network/DecodersTab.h"
#include "app/gui/network/NetworkBound.h"
#include "app/gui/network/NetworkCharts.h"
#include "app/gui/network/NetworkFiles.h"
#include "app/gui/network/NetworkPanel.h"
#include "app/gui/network/NetworkSource.h"
#include "app/gui/network/SweepTab.h"
#include "app/gui/network/TouchBounds.h"
#include "app/gui/network/TrainedNetworks.h"
#include "app/gui/network/words/FitWords.h"
#include "app/gui/network/words/SamplesWords.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/widgets/KeepRoom.h"
#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/Markup.h"
#include "app/gui/widgets/SpinBoxes.h"
#include "app/gui/window/SidePanel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QSplitter>
#include <QStyle>
#include <QTabWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

namespace palp {

namespace {

constexpr int kNetworkPanelWidth_px = 330;
constexpr int kHeadLines = 8; // of the words above the charts; more are scrolled to, or the splitter is drawn

QSplitter* beside(std::initializer_list<QWidget*> widgets, Qt::Orientation orientation) {
  auto* splitter = new QSplitter(orientation);
  for (QWidget* widget : widgets) splitter->addWidget(widget);
  return splitter;
}

/// A sweep is not part of what a network was trained with.
NetworkSettings withSweepOf(const NetworkSettings& now, NetworkSettings network) {
  network.sweepFrom = now.sweepFrom;
  network.sweepTo = now.sweepTo;
  network.sweepCount = now.sweepCount;
  return network;
}

} // namespace

NetworkPage::NetworkPage(Workbench& workbench, NetworkSession& session, QWidget* parent)
    : Scene(parent), workbench_(workbench), session_(session), bound_(new NetworkBound(session, this)),
      touchBounds_(new TouchBounds(session, this)), files_(new NetworkFiles(workbench, session, this)) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(8, 8, 8, 8);
  panel_ = new NetworkPanel;
  row->addWidget(sidePanel(panel_, kNetworkPanelWidth_px));
  row->addWidget(buildCharts(), 1);

  connect(panel_, &NetworkPanel::edited, this, &NetworkPage::edit);
  connect(panel_, &NetworkPanel::generateRequested, this,
          [this] { session_.generate(workbench_.project().samples, workbench_.project().mesh); });
  connect(panel_, &NetworkPanel::trainRequested, this, [this] { session_.train(workbench_.project().network); });
  connect(panel_, &NetworkPanel::sweepRequested, this, [this] {
    tabs_->setCurrentWidget(sweep_);
    session_.sweep(workbench_.project().network);
  });
  connect(panel_, &NetworkPanel::compareRequested, this, [this] {
    tabs_->setCurrentWidget(decoders_);
    session_.compare(workbench_.project().network);
  });
  connect(&workbench_, &Workbench::projectChanged, this, &NetworkPage::displayProject);
  connect(area_, &QSpinBox::valueChanged, this, [this](int area) {
    workbench_.edit(tr("Choose a test area"), [&](Project& next) { next.view.testArea = area; });
  });
  connect(panel_, &NetworkPanel::openSamplesRequested, files_, [this] { files_->openSamples(); });
  connect(panel_, &NetworkPanel::importRequested, files_, &NetworkFiles::chooseTables);
  connect(files_, &NetworkFiles::importRequested, this, &NetworkPage::importRequested);
  connect(panel_, &NetworkPanel::saveSamplesRequested, files_, &NetworkFiles::saveSamples);
  connect(save_, &QPushButton::clicked, files_, &NetworkFiles::saveNetwork);
  connect(open_, &QPushButton::clicked, files_, &NetworkFiles::openNetwork);
  connect(live_, &QPushButton::clicked, files_, &NetworkFiles::useInLive);
  connect(files_, &NetworkFiles::problem, this, &NetworkPage::showProblem);
  connect(files_, &NetworkFiles::sceneRequested, this, &NetworkPage::sceneRequested);
  connect(files_, &NetworkFiles::liveNetworkReplaced, this, &NetworkPage::liveNetworkReplaced);
  connect(sweep_, &SweepTab::spreadRequested, this, [this](double spread) {
    NetworkSettings next = workbench_.project().network;
    next.chosenSpread = spread;
    next.automaticSpread = false;
    takeOver(tr("Take the best spread of the sweep"), next);
  });
  connect(decoders_, &DecodersTab::networkRequested, this,
          [this](const NetworkSettings& network) { takeOver(tr("Take a decoder of the comparison"), network); });
  connect(trained_, &TrainedNetworks::goBackRequested, this, &NetworkPage::goBackTo);
  connect(trained_, &TrainedNetworks::removeRequested, &session_, &NetworkSession::takeAway);
  connect(trained_, &TrainedNetworks::bringBackRequested, &session_, &NetworkSession::bringBack);
  connect(trained_, &TrainedNetworks::nameRequested, &session_, &NetworkSession::rename);
  connectSession();
  displayProject();
  displaySamples();
}

void NetworkPage::openSamples(const std::vector<std::filesystem::path>& files) {
  files_->openSamples(files);
}

void NetworkPage::chooseTables() {
  files_->chooseTables();
}

void NetworkPage::connectSession() {
  connect(&session_, &NetworkSession::samplesChanged, this, &NetworkPage::displaySamples);
  connect(&session_, &NetworkSession::samplesOpened, this, &NetworkPage::takeSampleSettings);
  connect(&session_, &NetworkSession::fitChanged, this, &NetworkPage::displayFit);
  connect(&session_, &NetworkSession::sweepChanged, this, &NetworkPage::displaySweep);
  connect(&session_, &NetworkSession::trialsChanged, this, &NetworkPage::displayTrials);
  connect(bound_, &NetworkBound::changed, this, [this] {
    displayWords();
    displayTrials();
  });
  connect(touchBounds_, &TouchBounds::changed, this, &NetworkPage::displayWords);
  connect(&session_.runner(), &JobRunner::started, this, [this] {
    showProblem({});
    displayReadiness();
  });
  connect(&session_.runner(), &JobRunner::finished, this, &NetworkPage::displayReadiness);
  connect(&session_.runner(), &JobRunner::failed, this, &NetworkPage::showProblem);
  connect(&session_, &NetworkSession::problem, this, &NetworkPage::showProblem);
  connect(&session_, &NetworkSession::note, this, [this](const QString& sentence) { showSentence(sentence, "hint"); });
}

void NetworkPage::edit(const QString& what, const SampleSettings& samples, const NetworkSettings& network) {
  Project next = workbench_.project();
  const bool retrain =
      next.network != network && session_.fit() != nullptr && session_.upToDate() && !session_.generating();
  next.samples = samples;
  next.network = network;
  editing_ = true;
  workbench_.edit(what, next);
  editing_ = false;
  if (retrain) session_.train(network, panel_->slide()); // the error follows the spread
}

/// Where one looks: below the numbers that there are none of now.
void NetworkPage::showProblem(const QString& sentence) {
  showSentence(sentence, "problem");
}

void NetworkPage::showSentence(const QString& sentence, const char* role) {
  problem_->setProperty("role", role); // its colour
  problem_->style()->unpolish(problem_);
  problem_->style()->polish(problem_);
  problem_->setText(sentence);
  problem_->setVisible(!sentence.isEmpty());
}

/// The panel shows how the opened samples were made, as far as their file contains it.
void NetworkPage::takeSampleSettings() {
  const NetworkSamples* samples = session_.samples();
  if (samples == nullptr || samples->training.origin.imported()) return;
  Project next = workbench_.project();
  const SampleSettings& made = samples->settings;
  next.samples.seed = made.seed;
  if (made.touches) {
    if (!next.samples.touches) next.samples.touches = usualTouches(next.design);
    next.samples.touches->count = made.touches->count;
  } else {
    next.samples.touches.reset();
    next.samples.perArea = made.perArea;
  }
  workbench_.edit(tr("Open samples"), next);
}

/// Requested alone: what is trained stays in the list.
void NetworkPage::takeOver(const QString& what, const NetworkSettings& network) {
  Project next = workbench_.project();
  next.network = withSweepOf(next.network, network);
  workbench_.closeEntry();
  workbench_.edit(what, next);
  session_.train(next.network);
}

/// The panel shows what the network was trained with; it is not trained again.
void NetworkPage::goBackTo(std::size_t network) {
  Project next = workbench_.project();
  next.network = withSweepOf(next.network, session_.kept()[network]->settings);
  const bool otherDesign = !session_.upToDate() && session_.samples() != nullptr;
  if (otherDesign) next.design = session_.results().design; // samples, sweep and comparison hold again, too
  workbench_.closeEntry();
  workbench_.edit(otherDesign ? tr("Restore a network and its design") : tr("Restore a network"), next);
  session_.goBackTo(network);
}

QLayout* NetworkPage::buildBar() {
  auto* bar = new QHBoxLayout;
  auto* words = new QLabel(tr("Test area"));
  bar->addWidget(words);
  area_ = wholeBox("testArea", {.whileTyping = true}, tr("Area whose test samples are plotted"));
  words->setBuddy(area_);
  bar->addWidget(area_);
  bar->addStretch(1);
  save_ =
      pushButton(tr("Save network..."), "saveNetwork", tr("Saves the network shown, for Live and for palp predict"));
  open_ = pushButton(tr("Open network..."), "openNetwork",
                     tr("Opens a network from a file and evaluates it on the test samples"));
  live_ = pushButton(tr("Use in Live..."), "useInLive");
  addTo(*bar, {live_, save_, open_});
  return bar;
}

QWidget* NetworkPage::buildCharts() {
  fitWords_ = markupLabel();
  fitWords_->setObjectName("fitWords");
  fitWords_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  fitWords_->setWordWrap(true);
  fitWords_->setAlignment(Qt::AlignTop);
  head_ = new QScrollArea; // of the splitter's height, so that the tabs stay where they are
  head_->setFrameShape(QFrame::NoFrame);
  head_->setWidgetResizable(true);
  head_->setWidget(fitWords_);
  const int line = fitWords_->fontMetrics().lineSpacing();
  head_->setMinimumHeight(4 * line);
  auto* rest = new QWidget;
  auto* column = new QVBoxLayout(rest);
  column->setContentsMargins(0, 0, 0, 0);
  problem_ = textLabel("trainingProblem", "problem");
  keepRoom(*problem_);
  problem_->hide();
  column->addWidget(problem_);
  column->addLayout(buildBar());
  sweep_ = new SweepTab;
  decoders_ = new DecodersTab;
  trained_ = new TrainedNetworks;
  tabs_ = new QTabWidget;
  tabs_->setObjectName("networkTabs");
  tabs_->addTab(sweep_, tr("Spread"));
  tabs_->addTab(buildFit(), tr("Decoded against true force"));
  tabs_->addTab(decoders_, tr("Decoders"));
  tabs_->addTab(trained_, tr("Trained networks"));
  column->addWidget(tabs_, 1);
  auto* page = beside({head_, rest}, Qt::Vertical);
  page->setObjectName("networkHead");
  page->setChildrenCollapsible(false);
  page->setStretchFactor(1, 1);
  page->setSizes({kHeadLines * line, 100 * line});
  return page;
}

QWidget* NetworkPage::buildFit() {
  constexpr std::array kNames{"decoupledFx", "decoupledFy", "decoupledFz"};
  for (std::size_t d = 0; d < 3; ++d) decoupled_[d] = networkChart(kNames[d]);
  relative_ = networkChart("relativeError");
  place_ = networkChart("placeError");
  place_->hide();
  QSplitter* fit = beside({beside({decoupled_[0], decoupled_[1], decoupled_[2]}, Qt::Horizontal),
                           beside({relative_, place_}, Qt::Horizontal)},
                          Qt::Vertical);
  fit->setSizes({360, 360});
  fit->setObjectName("networkFit");
  return fit;
}

void NetworkPage::setTheme(Theme theme) {
  for (auto* view : findChildren<ChartView*>()) view->setTheme(theme);
}

void NetworkPage::showEvent(QShowEvent* event) {
  Scene::showEvent(event);
  displaySweep();
  displayFit();
  displayTrials();
}

QString NetworkPage::commands(const Project& project, const QString& designFile) const {
  return commandsOfShown(project, session_, designFile);
}

std::vector<JobRunner*> NetworkPage::runners() {
  return {&bound_->runner(), &touchBounds_->runner()};
}

void NetworkPage::displayProject() {
  session_.setDesign(workbench_.project().design);
  choices_ = rowWiresAndAreas();
  panel_->display(workbench_.project(), choices_[0]);
  const QSignalBlocker quiet(area_);
  const int before = area_->value();
  area_->setRange(0, std::max(0, choices_[1] - 1));
  area_->setValue(workbench_.project().view.testArea);
  displaySweep();
  displayTrials();
  if (area_->value() != before || settingsShown_ != workbench_.project().network) displayFit();
  // An undone change of the settings brings back the network that was trained with those of before.
  if (!editing_ && settingsShown_ != workbench_.project().network) session_.goBackTo(workbench_.project().network);
  settingsShown_ = workbench_.project().network;
}

std::array<int, 2> NetworkPage::rowWiresAndAreas() const {
  const SensorDesign& design = workbench_.project().design;
  if (!session_.upToDate()) return {design.rowWires(), design.areas.count()};
  return {session_.samples()->training.rowWires, session_.samples()->training.areaCount};
}

void NetworkPage::displaySamples() {
  if (rowWiresAndAreas() != choices_) displayProject();
  const auto [made, all] = session_.stoppedAt();
  QString words = samplesWords(session_);
  if (all > 0) words += tr(" Stopped at sample %1 of %2; it can be continued.").arg(made).arg(all);
  panel_->displaySamples(session_.upToDate(), words, all > 0);
  displayReadiness();
  displayFit(); // its text depends on the samples and on what runs next
}

void NetworkPage::displayReadiness() {
  panel_->displayReadiness(session_.upToDate(), session_.generating());
}

void NetworkPage::displaySweep() {
  if (isVisible()) sweep_->display(session_, workbench_.project().network);
}

void NetworkPage::displayTrials() {
  if (!isVisible()) return;
  const bool there = !session_.trials().empty();
  decoders_->display(session_, workbench_.project().network, there ? bound_->of(session_.trialsSettings()) : nullptr);
}

/// The words alone: the charts stay.
void NetworkPage::displayWords() {
  const NetworkFit* fit = session_.fit();
  const bool asked = isVisible() && fit != nullptr && session_.fitIsCurrent();
  panel_->displayChosenSpread(
      fit != nullptr && session_.fitIsCurrent() && fit->settings.automaticSpread ? fit->decoder.report.spread : 0);
  const QString words = fitWords(session_, workbench_.project().network, asked ? bound_->of(fit->settings) : nullptr,
                                 asked && fit->error.place ? touchBounds_->ofTheShown() : nullptr);
  fitWords_->setText(words);
  if (std::exchange(wordsOf_, fit) != fit) head_->verticalScrollBar()->setValue(0); // what is new begins at its top
}

void NetworkPage::displayFit() {
  const NetworkFit* fit = session_.fit();
  save_->setEnabled(fit != nullptr);
  const bool reads = fit != nullptr && fit->decoder.input.kind == InputKind::Resistance;
  live_->setEnabled(reads);
  live_->setToolTip(reads || fit == nullptr
                        ? tr("Saves the network shown and uses it for decoding in Live")
                        : tr("A board delivers resistances: train a network on those first (Set for a board)"));
  displayWords();
  const bool stale = !staleReason(session_, workbench_.project().network).isEmpty();
  for (ChartView* view : decoupled_) view->setFaint(stale);
  relative_->setFaint(stale);
  place_->setFaint(stale);
  trained_->display(session_);
  drawCharts();
}

void NetworkPage::drawCharts() {
  if (!isVisible()) return;
  const NetworkFit* fit = session_.fit();
  const NetworkSamples* samples = session_.samples();
  displaySweep();
  const bool places = fit != nullptr && samples != nullptr && fit->error.place;
  place_->setVisible(places);
  place_->setChart(places ? placeErrorChart(*samples, *fit) : ChartSpec());
  if (fit == nullptr || samples == nullptr) {
    for (ChartView* view : decoupled_) view->setChart({});
    relative_->setChart({});
    return;
  }
  for (int d = 0; d < 3; ++d)
    decoupled_[static_cast<std::size_t>(d)]->setChart(decoupledChart(*samples, *fit, d, area_->value()));
  relative_->setChart(relativeErrorChart(*samples, *fit, area_->value()));
}

} // namespace palp
