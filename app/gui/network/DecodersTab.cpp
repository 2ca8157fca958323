#include "app/gui/network/DecodersTab.h"

#include "app/gui/network/NetworkCharts.h"
#include "app/gui/network/NetworkTables.h"
#include "app/gui/network/words/FitWords.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/views/DataTable.h"
#include "app/gui/widgets/MakeWidgets.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSplitter>
#include <QVBoxLayout>

namespace palp {

DecodersTab::DecodersTab(QWidget* parent) : QWidget(parent) {
  error_ = networkChart("trialsError");
  time_ = networkChart("trialsTime");
  words_ = textLabel("trialsWords");
  table_ = new DataTable("decoders.csv");
  table_->setObjectName("trialsTable");
  table_->setAccessibleName(tr("Table of the decoders"));
  train_ = pushButton(tr("Train the selected decoder"), "trainMarked",
                      tr("Trains the decoder of the selected row with the settings of the comparison; it is then shown "
                         "and added to the trained networks"));
  connect(table_, &QTableWidget::itemSelectionChanged, this, &DecodersTab::displayMarked);
  connect(train_, &QPushButton::clicked, this, [this] {
    if (const auto network = marked()) emit networkRequested(*network);
  });
  auto* charts = new QSplitter(Qt::Horizontal);
  charts->addWidget(error_);
  charts->addWidget(time_);
  auto* all = new QSplitter(Qt::Vertical);
  all->setObjectName("networkTrials");
  all->addWidget(charts);
  all->addWidget(table_);
  all->setSizes({340, 280});
  auto* column = new QVBoxLayout(this);
  column->addLayout(inRow({{words_, 1}, train_}));
  column->addWidget(all, 1);
}

void DecodersTab::display(const NetworkSession& session, const NetworkSettings& now, const NoiseBound* bound) {
  const std::vector<DecoderTrial>& trials = session.trials();
  const bool curve = !trials.empty() && sweepAndTrialsAgree(session);
  error_->setChart(trialsErrorChart(trials, curve ? session.sweepPoints() : std::vector<SweepPoint>{},
                                    trials.empty() ? now.input : session.trialsSettings().input));
  time_->setChart(trialsTimeChart(trials));
  const bool stale = !staleTrialsReason(session, now).isEmpty();
  for (ChartView* view : {error_, time_}) view->setFaint(stale);
  const TableText table = trialsTable(trials, bound, session.samples());
  table_->show(table.heads, table.rows);
  if (const auto best = bestTrial(trials)) table_->mark(static_cast<int>(*best));
  words_->setText(trialsWords(session, now));
  networks_.clear();
  for (const DecoderTrial& trial : trials) {
    NetworkSettings network = session.trialsSettings();
    network.decoder = trial.kind;
    networks_.push_back(session.upToDate() && trial.refusal.isEmpty() ? std::optional(network) : std::nullopt);
  }
  displayMarked();
}

/// By what is marked, not by the cursor, which Ctrl with an arrow moves alone.
std::optional<NetworkSettings> DecodersTab::marked() const {
  const QList<QTableWidgetItem*> items = table_->selectedItems();
  if (items.isEmpty()) return {};
  const auto row = static_cast<std::size_t>(table_->dataRow(items.front()->row()));
  return row < networks_.size() ? networks_[row] : std::nullopt; // the bound is not a network
}

void DecodersTab::displayMarked() {
  train_->setEnabled(marked().has_value());
}

} // namespace palp
