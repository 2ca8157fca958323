#pragma once

#include "app/gui/jobs/JobRunner.h"
#include "app/gui/project/Workbench.h"
#include "app/scenes/Palette.h"
#include "app/study/reports/layout/DesignBounds.h"

#include <QWidget>

#include <vector>

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QSpinBox;

namespace palp {

class ChartView;

/// One number of the design over a range, with the noise floor as the result.
class DesignSweep : public QWidget {
  Q_OBJECT

public:
  explicit DesignSweep(Workbench& workbench, QWidget* parent = nullptr);

  [[nodiscard]] JobRunner& runner() { return runner_; }
  void setTheme(Theme theme);

private:
  struct Point {
    double at = 0;
    DesignBounds bounds;
  };
  void displayProject();
  /// Those of the law that the design has.
  void listNumbers(const SensorDesign& design);
  /// Around the number as it is now, until the user sets a range.
  void proposeRange();
  void run();
  void showResult(const QString& label, const std::vector<Point>& points, int left);
  void saveTable();

  Workbench& workbench_;
  JobRunner runner_;
  bool proposed_ = true;
  std::size_t law_ = 0; ///< whose numbers are listed
  std::vector<Point> points_;
  QString label_; ///< of the number that was swept
  QComboBox* number_ = nullptr;
  QDoubleSpinBox* from_ = nullptr;
  QDoubleSpinBox* to_ = nullptr;
  QSpinBox* steps_ = nullptr;
  QPushButton* start_ = nullptr;
  QPushButton* save_ = nullptr;
  QLabel* words_ = nullptr;
  ChartView* chart_ = nullptr;
};

} // namespace palp
