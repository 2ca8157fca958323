#include "app/gui/reports/ReportCases.h"

#include "app/gui/jobs/TimeLeft.h"

#include <QHeaderView>

namespace palp {

namespace {

enum Column { kWhat, kState };

} // namespace

ReportCases::ReportCases(QWidget* parent) : QTreeWidget(parent) {
  setObjectName("reportCases");
  setAccessibleName(tr("Parts of the report"));
  setToolTip(tr("Parts of the report in order, and their durations"));
  setHeaderLabels({tr("Part"), tr("Time")});
  setRootIsDecorated(false);
  setSelectionMode(QAbstractItemView::NoSelection);
  header()->setStretchLastSection(false);
  header()->setSectionResizeMode(kWhat, QHeaderView::Stretch);
  header()->setSectionResizeMode(kState, QHeaderView::ResizeToContents);
}

void ReportCases::show(const ReportPlan& plan) {
  plan_ = plan;
  part_ = 0;
  partBegan_s_ = 0;
  took_.clear();
  clear();
  for (const RunPart& part : plan.parts()) {
    auto* item =
        new QTreeWidgetItem(this, {QString::fromStdString(part.name), tr("about %1").arg(roughly(part.seconds))});
    item->setToolTip(kWhat, item->text(kWhat));
  }
}

void ReportCases::setProgress(double share, double elapsed_s, const QString& what) {
  if (plan_.parts().empty()) return;
  while (part_ < plan_.partAt(share)) closePart(elapsed_s);
  QTreeWidgetItem& item = *topLevelItem(static_cast<int>(part_));
  item.setText(kState, tr("running"));
  const QString name = QString::fromStdString(plan_.parts()[part_].name);
  item.setText(kWhat, what.isEmpty() || what == name ? name : name + ": " + what);
}

void ReportCases::closePart(double elapsed_s) {
  took_.push_back(elapsed_s - partBegan_s_);
  partBegan_s_ = elapsed_s;
  QTreeWidgetItem& item = *topLevelItem(static_cast<int>(part_));
  item.setText(kWhat, QString::fromStdString(plan_.parts()[part_].name));
  item.setText(kState, tr("done in %1 s").arg(took_.back(), 0, 'f', 1));
  ++part_;
}

std::vector<double> ReportCases::finish(double elapsed_s) {
  while (part_ < plan_.parts().size()) closePart(elapsed_s);
  return took_;
}

void ReportCases::stop() {
  for (std::size_t k = part_; k < plan_.parts().size(); ++k)
    topLevelItem(static_cast<int>(k))->setText(kState, tr("not done"));
}

} // namespace palp
