#include "app/gui/network/NetworkPage.h"

#include "app/gui/network/NetworkCharts.h"
#include "app/gui/network/NetworkPanel.h"
#include "app/gui/project/Command.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/window/SidePanel.h"
#include "io/DecoderFile.h"
#include "model/base/Error.h"

#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QSplitter>
#include <QTabWidget>
#include <QVBoxLayout>

namespace palp {

namespace {

constexpr int kPanelWidth_px = 330;

QString triple(const Eigen::VectorXd& values, const QString& unit) {
  QStringList texts;
  for (const double value : values) texts << QString::number(value, 'g', 3);
  return texts.join(" / ") + " " + unit;
}

QSplitter* beside(std::initializer_list<QWidget*> widgets, Qt::Orientation orientation) {
  auto* splitter = new QSplitter(orientation);
  for (QWidget* widget : widgets) splitter->addWidget(widget);
  return splitter;
}

} // namespace

NetworkPage::NetworkPage(Workbench& workbench, NetworkSession& session, QWidget* parent)
    : Scene(parent), workbench_(workbench), session_(session) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(8, 8, 8, 8);
  panel_ = new NetworkPanel;
  row->addWidget(sidePanel(panel_, kPanelWidth_px));
  row->addWidget(buildCharts(), 1);

  connect(panel_, &NetworkPanel::edited, this,
          [this](const QString& what, const SampleSettings& samples, const NetworkSettings& network) {
            Project next = workbench_.project();
            const bool retrain = !(next.network == network) && session_.fit() != nullptr && session_.upToDate();
            next.samples = samples;
            next.network = network;
            workbench_.edit(what, next);
            if (retrain) session_.train(network); // the error follows the spread
          });
  connect(panel_, &NetworkPanel::generateAsked, this,
          [this] { session_.generate(workbench_.project().samples, workbench_.project().mesh); });
  connect(panel_, &NetworkPanel::trainAsked, this, [this] { session_.train(workbench_.project().network); });
  connect(panel_, &NetworkPanel::sweepAsked, this, [this] { session_.sweep(workbench_.project().network); });
  connect(panel_, &NetworkPanel::compareAsked, this, [this] {
    tabs_->setCurrentIndex(2);
    session_.compare(workbench_.project().network);
  });
  connect(&session_, &NetworkSession::trialsChanged, this, &NetworkPage::displayTrials);
  connect(&workbench_, &Workbench::projectChanged, this, &NetworkPage::displayProject);
  connect(&session_, &NetworkSession::samplesChanged, this, &NetworkPage::displaySamples);
  connect(&session_, &NetworkSession::fitChanged, this, &NetworkPage::displayFit);
  connect(&session_, &NetworkSession::sweepChanged, this, &NetworkPage::displaySweep);
  connect(area_, &QSpinBox::valueChanged, this, [this](int area) {
    Project next = workbench_.project();
    next.view.testArea = area;
    workbench_.edit(tr("Choose a test area"), next);
  });
  connect(panel_, &NetworkPanel::openSamplesAsked, this, &NetworkPage::openSamples);
  connect(panel_, &NetworkPanel::saveSamplesAsked, this, &NetworkPage::saveSamples);
  connect(save_, &QPushButton::clicked, this, &NetworkPage::saveNetwork);
  connect(open_, &QPushButton::clicked, this, &NetworkPage::openNetwork);
  displayProject();
  displaySamples();
}

QWidget* NetworkPage::buildCharts() {
  auto* page = new QWidget;
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(0, 0, 0, 0);
  auto* bar = new QHBoxLayout;
  fitWords_ = new QLabel;
  fitWords_->setObjectName("fitWords");
  fitWords_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  fitWords_->setWordWrap(true);
  fitWords_->setMinimumHeight(3 * fitWords_->fontMetrics().lineSpacing()); // the tabs stay where they are
  bar->addWidget(fitWords_, 1);
  bar->addWidget(new QLabel(tr("Test area")));
  area_ = new QSpinBox;
  area_->setObjectName("testArea");
  bar->addWidget(area_);
  area_->setToolTip(tr("Load area whose test samples are drawn"));
  save_ = new QPushButton(tr("Save network..."));
  open_ = new QPushButton(tr("Open network..."));
  open_->setObjectName("openNetwork");
  bar->addWidget(save_);
  bar->addWidget(open_);
  column->addLayout(bar);

  error_ = chart("sweepError");
  leaveOneOut_ = chart("leaveOneOut");
  condition_ = chart("condition");
  time_ = chart("errorTime");
  for (std::size_t d = 0; d < 3; ++d) decoupled_[d] = chart("decoupled");
  relative_ = chart("relativeError");
  tabs_ = new QTabWidget;
  tabs_->setObjectName("networkTabs");
  QSplitter* sweep = beside({error_, beside({leaveOneOut_, condition_, time_}, Qt::Horizontal)}, Qt::Vertical);
  sweep->setSizes({500, 260});
  sweep->setObjectName("networkSweep");
  tabs_->addTab(sweep, tr("Spread"));
  QSplitter* fit =
      beside({beside({decoupled_[0], decoupled_[1], decoupled_[2]}, Qt::Horizontal), relative_}, Qt::Vertical);
  fit->setSizes({360, 360});
  fit->setObjectName("networkFit");
  tabs_->addTab(fit, tr("Decoupled against true force"));
  tabs_->addTab(buildTrials(), tr("Decoders"));
  column->addWidget(tabs_, 1);
  return page;
}

ChartView* NetworkPage::chart(const char* name) {
  auto* view = new ChartView;
  view->setObjectName(name);
  all_.push_back(view);
  return view;
}

QWidget* NetworkPage::buildTrials() {
  trialsError_ = chart("trialsError");
  trialsTime_ = chart("trialsTime");
  trialsWords_ = new QLabel(tr("Compare all decoders trains each kind on the same samples."));
  trialsWords_->setObjectName("trialsWords");
  trialsWords_->setWordWrap(true);
  auto* page = new QWidget;
  auto* column = new QVBoxLayout(page);
  column->addWidget(trialsWords_);
  QSplitter* charts = beside({trialsError_, trialsTime_}, Qt::Horizontal);
  charts->setObjectName("networkTrials");
  column->addWidget(charts, 1);
  return page;
}

void NetworkPage::setTheme(Theme theme) {
  for (ChartView* view : all_) view->setTheme(theme);
}

void NetworkPage::showEvent(QShowEvent* event) {
  Scene::showEvent(event);
  displaySweep();
  displayFit();
  displayTrials();
}

QString NetworkPage::commands(const Project& project, const QString& designFile) const {
  return networkCommands(project, designFile);
}

void NetworkPage::displayProject() {
  panel_->display(workbench_.project());
  session_.setDesign(workbench_.project().design);
  const QSignalBlocker quiet(area_);
  area_->setRange(0, std::max(0, workbench_.project().design.areas.count() - 1));
  const int before = area_->value();
  area_->setValue(workbench_.project().view.testArea);
  displaySweep();
  displayTrials();
  if (area_->value() != before) displayFit();
}

void NetworkPage::displaySamples() {
  const NetworkSamples* samples = session_.samples();
  const auto [made, all] = session_.stoppedAt();
  QString words = tr("None yet for this design.");
  if (samples != nullptr)
    words = tr("%1 for training, %2 for testing%3.")
                .arg(samples->training.size())
                .arg(samples->test.size())
                .arg(samples->batchError > 0
                         ? tr("; batch error against full Newton %1").arg(samples->batchError, 0, 'g', 2)
                         : tr(", from a file"));
  if (samples != nullptr && !session_.upToDate())
    words = tr("%1 for training, %2 for testing, of an earlier design: undo the change, or generate new ones.")
                .arg(samples->training.size())
                .arg(samples->test.size());
  if (all > 0) words += tr(" Stopped at sample %1 of %2; it goes on from there.").arg(made).arg(all);
  panel_->displaySamples(session_.upToDate(), words, all > 0);
  displayFit(); // it says whose it is and what comes next
}

void NetworkPage::displaySweep() {
  if (!isVisible()) return;
  const std::vector<SweepPoint>& points = session_.sweepPoints();
  const InputKind input = points.empty() ? workbench_.project().network.input : session_.sweepSettings().input;
  error_->setChart(sweepErrorChart(points, session_.fit(), input));
  leaveOneOut_->setChart(sweepLeaveOneOutChart(points));
  condition_->setChart(sweepConditionChart(points));
  time_->setChart(errorTimeChart(points));
}

void NetworkPage::displayFit() {
  const NetworkFit* fit = session_.fit();
  save_->setEnabled(fit != nullptr);
  if (fit == nullptr) {
    fitWords_->setText(session_.samples() == nullptr ? tr("No network yet: generate samples, then train.")
                                                     : tr("No network yet: train one on the samples."));
  } else {
    const PredictionError& error = fit->error.error;
    const QString whose = session_.upToDate() ? QString() : tr("<i>Of an earlier design.</i> ");
    fitWords_->setText(whose +
                       tr("<b>Test error Fx / Fy / Fz, all areas:</b> %1 by Eq. (13), %2 with a floor of 0.05 N, %3 of "
                          "range (RMSE). Spread %4, %5 centres, condition %6, trained in %7 s.")
                           .arg(triple(error.eq13Percent, "%"), triple(error.eq13FlooredPercent, "%"),
                                triple(error.rmsePercentOfRange, "%"))
                           .arg(fit->decoder.report.spread, 0, 'g', 4)
                           .arg(fit->decoder.report.centers)
                           .arg(fit->decoder.report.condition, 0, 'g', 2)
                           .arg(fit->decoder.report.seconds, 0, 'g', 2));
  }
  drawCharts();
}

void NetworkPage::drawCharts() {
  if (!isVisible()) return;
  const NetworkFit* fit = session_.fit();
  const NetworkSamples* samples = session_.samples();
  displaySweep();
  if (fit == nullptr || samples == nullptr) {
    for (ChartView* view : decoupled_) view->setChart({});
    relative_->setChart({});
    return;
  }
  for (int d = 0; d < 3; ++d)
    decoupled_[static_cast<std::size_t>(d)]->setChart(decoupledChart(*samples, *fit, d, area_->value()));
  relative_->setChart(relativeErrorChart(*samples, *fit, area_->value()));
}

void NetworkPage::displayTrials() {
  if (!isVisible()) return;
  const std::vector<DecoderTrial>& trials = session_.trials();
  trialsError_->setChart(trialsErrorChart(
      trials,
      session_.sweepSettings().input == session_.trialsInput() ? session_.sweepPoints() : std::vector<SweepPoint>{},
      session_.trialsInput()));
  trialsTime_->setChart(trialsTimeChart(trials));
  QStringList words;
  for (const DecoderTrial& trial : trials)
    if (!trial.refusal.isEmpty()) words << tr("%1: %2").arg(QString::fromStdString(name(trial.kind)), trial.refusal);
  trialsWords_->setText(words.isEmpty() ? tr("Compare all decoders trains each kind on the same samples.")
                                        : tr("Not trained: ") + words.join("; "));
}

void NetworkPage::openSamples() {
  const QStringList chosen = QFileDialog::getOpenFileNames(this, tr("Open samples"), {}, tr("Samples (*.csv)"));
  std::vector<std::filesystem::path> files;
  for (const QString& file : chosen) files.emplace_back(file.toStdString());
  if (!files.empty()) session_.openSamples(files);
}

void NetworkPage::saveSamples() {
  const QString file = QFileDialog::getSaveFileName(this, tr("Save samples"), "samples.csv", tr("Samples (*.csv)"));
  if (!file.isEmpty() && session_.samples() != nullptr) session_.saveSamples(file.toStdString());
}

void NetworkPage::saveNetwork() {
  const QString file = QFileDialog::getSaveFileName(this, tr("Save network"), "network.json", tr("Networks (*.json)"));
  if (file.isEmpty()) return;
  try {
    writeNetwork(session_.fit()->decoder, file.toStdString());
  } catch (const Error& error) {
    emit refused(QString::fromStdString(error.what()));
  }
}

void NetworkPage::openNetwork() {
  const QString file = QFileDialog::getOpenFileName(this, tr("Open network"), {}, tr("Networks (*.json)"));
  if (file.isEmpty()) return;
  try {
    session_.open(file.toStdString());
  } catch (const Error& error) {
    emit refused(QString::fromStdString(error.what()));
  }
}

} // namespace palp
