#include "app/gui/views/DataTable.h"

#include "app/gui/views/CsvExport.h"

#include <QApplication>
#include <QClipboard>
#include <QContextMenuEvent>
#include <QHeaderView>
#include <QKeyEvent>
#include <QMenu>

namespace palp {

namespace {

constexpr int kRowRole = Qt::UserRole; ///< the row of show()

/// Numbers by their value and before words; all alike by their rows where the table is in the order of show().
class Cell : public QTableWidgetItem {
public:
  explicit Cell(const QString& text) : QTableWidgetItem(text) {}
  bool operator<(const QTableWidgetItem& other) const override {
    if (!tableWidget()->horizontalHeader()->isSortIndicatorShown())
      return data(kRowRole).toInt() < other.data(kRowRole).toInt();
    bool number = false, otherNumber = false;
    const double value = text().toDouble(&number), otherValue = other.text().toDouble(&otherNumber);
    if (number && otherNumber) return value < otherValue;
    return number != otherNumber ? number : text().localeAwareCompare(other.text()) < 0;
  }
};

} // namespace

DataTable::DataTable(const QString& file, QWidget* parent) : QTableWidget(parent), file_(file) {
  setEditTriggers(QAbstractItemView::NoEditTriggers);
  setSelectionMode(QAbstractItemView::ContiguousSelection);
  setToolTip(
      tr("Select cells and copy them with Ctrl+C; click a column head to sort; right click to save the table as CSV"));
  verticalHeader()->hide();
  horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  horizontalHeader()->setSectionsClickable(true);
  connect(horizontalHeader(), &QHeaderView::sectionClicked, this, &DataTable::sortBy);
}

void DataTable::show(const QStringList& heads, const std::vector<QStringList>& rows) {
  setColumnCount(static_cast<int>(heads.size()));
  setHorizontalHeaderLabels(heads);
  setRowCount(static_cast<int>(rows.size()));
  for (int row = 0; row < rowCount(); ++row)
    for (int column = 0; column < columnCount(); ++column) {
      const QString text = rows[static_cast<std::size_t>(row)].value(column);
      auto* cell = new Cell(text);
      cell->setData(kRowRole, row);
      bool number = false;
      text.toDouble(&number);
      if (number) cell->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
      setItem(row, column, cell);
    }
  if (sortColumn_ >= columnCount()) sortBy(-1); // it is another table now
  if (sortColumn_ >= 0) sortItems(sortColumn_, sortOrder_);
}

void DataTable::sortBy(int column) {
  const bool again = column == sortColumn_, back = column < 0 || (again && sortOrder_ == Qt::DescendingOrder);
  sortColumn_ = back ? -1 : column;
  sortOrder_ = again && !back ? Qt::DescendingOrder : Qt::AscendingOrder;
  horizontalHeader()->setSortIndicatorShown(!back);
  if (!back) horizontalHeader()->setSortIndicator(column, sortOrder_);
  if (columnCount() > 0) sortItems(back ? 0 : column, sortOrder_);
}

int DataTable::dataRow(int shownRow) const {
  const QTableWidgetItem* cell = item(shownRow, 0);
  return cell != nullptr ? cell->data(kRowRole).toInt() : -1;
}

int DataTable::shownRow(int dataRow) const {
  for (int row = 0; row < rowCount(); ++row)
    if (dataRow >= 0 && this->dataRow(row) == dataRow) return row;
  return -1;
}

void DataTable::mark(int dataRow) {
  const int row = shownRow(dataRow);
  for (int column = 0; column < columnCount(); ++column) {
    QFont font = item(row, column)->font();
    font.setBold(true);
    item(row, column)->setFont(font);
  }
}

QString DataTable::csv() const {
  QStringList lines{{}};
  for (int column = 0; column < columnCount(); ++column)
    lines[0] += (column == 0 ? "" : ",") + csvCell(horizontalHeaderItem(column)->text());
  for (int row = 0; row < rowCount(); ++row) {
    QStringList cells;
    const int shown = shownRow(row);
    for (int column = 0; column < columnCount(); ++column) cells << csvCell(item(shown, column)->text());
    lines << cells.join(',');
  }
  return lines.join('\n') + "\n";
}

QString DataTable::marked() const {
  const QList<QTableWidgetSelectionRange> ranges = selectedRanges();
  const bool all = ranges.isEmpty();
  const QTableWidgetSelectionRange range =
      all ? QTableWidgetSelectionRange(0, 0, rowCount() - 1, columnCount() - 1) : ranges.front();
  QStringList lines, heads;
  for (int column = range.leftColumn(); column <= range.rightColumn(); ++column)
    heads << horizontalHeaderItem(column)->text();
  if (all || (range.rowCount() == rowCount() && range.columnCount() == columnCount())) lines << heads.join('\t');
  for (int row = range.topRow(); row <= range.bottomRow(); ++row) {
    QStringList cells;
    for (int column = range.leftColumn(); column <= range.rightColumn(); ++column) cells << item(row, column)->text();
    lines << cells.join('\t');
  }
  return lines.join('\n') + "\n";
}

void DataTable::copy() const {
  QApplication::clipboard()->setText(marked());
}

void DataTable::keyPressEvent(QKeyEvent* event) {
  if (event->matches(QKeySequence::Copy))
    copy();
  else
    QTableWidget::keyPressEvent(event);
}

void DataTable::contextMenuEvent(QContextMenuEvent* event) {
  QMenu menu(this);
  menu.addAction(selectedRanges().isEmpty() ? tr("Copy all") : tr("Copy selection"), this, &DataTable::copy);
  menu.addAction(tr("Select all"), this, &QTableWidget::selectAll);
  menu.addAction(tr("Save as CSV..."), this, [this] {
    const QString written = offerCsv(this, file_, csv());
    if (!written.isEmpty()) emit message(tr("Wrote %1.").arg(written));
  });
  menu.exec(event->globalPos());
}

} // namespace palp
