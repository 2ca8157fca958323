#include "app/gui/reports/WrittenReports.h"

#include "app/gui/reports/ReportFolders.h"

namespace palp {

namespace {

constexpr int kFolderRole = Qt::UserRole;

} // namespace

WrittenReports::WrittenReports(QWidget* parent) : QListWidget(parent) {
  setObjectName("writtenReports");
  setAccessibleName(tr("Earlier reports"));
  setToolTip(tr("Reports in the folder; a click shows a report or continues a cancelled study"));
  const auto choose = [this](const QListWidgetItem* item) { emit chosen(item->data(kFolderRole).toString()); };
  connect(this, &QListWidget::itemActivated, this, choose);
  connect(this, &QListWidget::itemClicked, this, choose);
}

void WrittenReports::list(const QString& base, const QString& shown, const QString& running) {
  clear();
  for (const WrittenReport& report : reportsBelow(base)) {
    if (report.folder == running) continue;
    auto* item = new QListWidgetItem(report.title, this);
    item->setData(kFolderRole, report.folder);
    item->setToolTip(report.folder);
  }
  mark(shown);
}

void WrittenReports::mark(const QString& shown) {
  setCurrentItem(nullptr);
  for (int row = 0; row < count(); ++row)
    if (item(row)->data(kFolderRole).toString() == shown) setCurrentRow(row);
}

} // namespace palp
