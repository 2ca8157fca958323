#pragma once

#include <QListWidget>

namespace palp {

/// The reports that lie in a folder; a click or Return chooses one.
class WrittenReports : public QListWidget {
  Q_OBJECT

public:
  explicit WrittenReports(QWidget* parent = nullptr);

  /// Lists them anew; the one in the folder `shown` is marked, the one in `running` is not
  /// written yet.
  void list(const QString& base, const QString& shown, const QString& running);
  /// Marks the report that is shown; none where it is not in the list.
  void mark(const QString& shown);

signals:
  void chosen(const QString& folder);
};

} // namespace palp
