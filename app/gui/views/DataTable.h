#pragma once

#include <QTableWidget>

#include <vector>

namespace palp {

/// Rows that are read, not written: any range can be marked and copied into a spreadsheet, all of it saved as CSV.
class DataTable : public QTableWidget {
  Q_OBJECT

public:
  /// `file` is the name that is proposed for the CSV.
  explicit DataTable(const QString& file, QWidget* parent = nullptr);

  void show(const QStringList& heads, const std::vector<QStringList>& rows);
  /// Bold.
  void mark(int row);
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

  QString file_;
};

} // namespace palp
