#pragma once

#include "app/gui/reports/ReportPlan.h"

#include <QTreeWidget>

namespace palp {

/// The parts of a report: what will run and for how long, what runs now and what is done.
class ReportCases : public QTreeWidget {
public:
  explicit ReportCases(QWidget* parent = nullptr);

  /// What will run.
  void show(const ReportPlan& plan);
  /// The progress of a run after a time [s]; `what` is being done.
  void setProgress(double share, double elapsed_s, const QString& what);
  /// All of it is done. The seconds of each part.
  std::vector<double> finish(double elapsed_s);
  /// It ended before.
  void stop();

private:
  void closePart(double elapsed_s);

  ReportPlan plan_;
  std::size_t part_ = 0;     ///< that runs
  double partBegan_s_ = 0;   ///< into the run
  std::vector<double> took_; ///< [s], of the parts that are done
};

} // namespace palp
