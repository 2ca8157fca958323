#pragma once

#include <QTableWidget>

#include <vector>

namespace palp {

/// Rows that are read, not written: any range can be marked and copied into a spreadsheet, all of it saved as CSV. A
/// click on a head sorts by it, a second one the other way round, a third one takes the order of before, which the CSV
/// always has: what is written above it may name its rows one by one.
class DataTable : public QTableWidget {
  Q_OBJECT

public:
  /// `file` is the name that is proposed for the CSV.
  explicit DataTable(const QString& file, QWidget* parent = nullptr);

  void show(const QStringList& heads, const std::vector<QStringList>& rows);
  /// Bold; the row is one of show().
  void mark(int dataRow);
  /// Which row of show() is in a row of the table, and the inverse; -1 for -1.
  [[nodiscard]] int dataRow(int shownRow) const;
  [[nodiscard]] int shownRow(int dataRow) const;
  /// The name that is proposed for the CSV.
  [[nodiscard]] const QString& file() const { return file_; }
  [[nodiscard]] QString csv() const;
  /// What is marked, with tabs between the cells; all of it, with its heads, where nothing
  /// is.
  [[nodiscard]] QString marked() const;

signals:
  /// The table was written.
  void message(const QString& sentence);

protected:
  void keyPressEvent(QKeyEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;

private:
  void copy() const;
  void sortBy(int column);

  QString file_;
  int sortColumn_ = -1; ///< -1: the rows are in the order of show()
  Qt::SortOrder sortOrder_ = Qt::AscendingOrder;
};

} // namespace palp
