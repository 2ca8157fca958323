#pragma once

#include "app/gui/jobs/NetworkSession.h"

#include <QWidget>

class QLabel;
class QPushButton;

namespace palp {

class ChartView;
class DataTable;

/// Errors against the spread, as charts and as a table.
class SweepTab : public QWidget {
  Q_OBJECT

public:
  explicit SweepTab(QWidget* parent = nullptr);

  /// Emits nothing.
  void display(const NetworkSession& session, const NetworkSettings& now);

signals:
  /// To train with that of the smallest error.
  void spreadRequested(double spread);

private:
  ChartView* error_ = nullptr;
  ChartView* leaveOneOut_ = nullptr;
  ChartView* condition_ = nullptr;
  ChartView* time_ = nullptr;
  QLabel* words_ = nullptr;
  QPushButton* best_ = nullptr;
  DataTable* table_ = nullptr;
  double bestSpread_ = 0; ///< of the points that are shown
};

} // namespace palp
