#include "app/gui/network/SweepTab.h"

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

SweepTab::SweepTab(QWidget* parent) : QWidget(parent) {
  error_ = networkChart("sweepError");
  leaveOneOut_ = networkChart("leaveOneOut");
  condition_ = networkChart("condition");
  time_ = networkChart("errorTime");
  words_ = textLabel("sweepWords");
  best_ = pushButton(
      tr("Take the best spread"), "bestSpread",
      tr("Sets the spread with the smallest test error of the sweep (bold in the table) and trains with it"));
  table_ = new DataTable("sweep.csv");
  table_->setObjectName("sweepTable");
  table_->setAccessibleName(tr("Table of the sweep"));
  auto* bar = inRow({{words_, 1}, best_});
  auto* list = new QWidget;
  auto* below = new QVBoxLayout(list);
  below->setContentsMargins(0, 0, 0, 0);
  below->addLayout(bar);
  below->addWidget(table_, 1);
  auto* small = new QSplitter(Qt::Horizontal);
  for (ChartView* view : {leaveOneOut_, condition_, time_}) small->addWidget(view);
  auto* all = new QSplitter(Qt::Vertical);
  all->setObjectName("networkSweep");
  for (QWidget* part : std::initializer_list<QWidget*>{error_, small, list}) all->addWidget(part);
  all->setSizes({280, 180, 260});
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(all);
  connect(best_, &QPushButton::clicked, this, [this] { emit spreadRequested(bestSpread_); });
}

void SweepTab::display(const NetworkSession& session, const NetworkSettings& now) {
  const std::vector<SweepPoint>& points = session.sweepPoints();
  const InputKind input = points.empty() ? now.input : session.sweepSettings().input;
  error_->setChart(sweepErrorChart(points, session.fit(), input));
  leaveOneOut_->setChart(sweepLeaveOneOutChart(points));
  condition_->setChart(sweepConditionChart(points));
  time_->setChart(errorTimeChart(points));
  const QString reason = staleSweepReason(session, now);
  for (ChartView* view : {error_, leaveOneOut_, condition_, time_}) view->setFaint(!reason.isEmpty());
  const auto best = bestPoint(points);
  best_->setEnabled(best.has_value() && session.upToDate());
  if (best) bestSpread_ = points[*best].spread;
  const bool atEnd = best && points.size() > 2 && (*best == 0 || *best + 1 == points.size());
  words_->setText(best ? tr("Smallest test error at spread %1 (RMSE over all forces, in % of range). %2%3")
                             .arg(points[*best].spread, 0, 'g', 4)
                             .arg(atEnd && !session.working()
                                      ? tr("It is at the end of the range: a wider range may contain a better one. ")
                                      : QString(),
                                  reason)
                       : tr("Results of a sweep appear here; it trains once per spread."));
  const TableText table = sweepTable(points, session.samples());
  const bool grew = table_->rowCount() != static_cast<int>(table.rows.size());
  table_->show(table.heads, table.rows);
  if (!best) return;
  table_->mark(static_cast<int>(*best));
  if (grew) table_->scrollToItem(table_->item(table_->shownRow(static_cast<int>(*best)), 0));
}

} // namespace palp
