#pragma once

#include "app/gui/jobs/JobRunner.h"
#include "app/gui/project/Workbench.h"
#include "app/scenes/Palette.h"

#include <QWidget>

#include <optional>

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
  void build();
  void displayProject();
  /// Those of the law that the design has.
  void listNumbers(const SensorDesign& design);
  /// What the boxes say is what the project keeps; a range that was set by hand stays.
  void readSettings(bool rangeByHand);
  void run();
  void showCurve();
  void saveTable();

  Workbench& workbench_;
  JobRunner runner_;
  std::pair<std::size_t, std::size_t> laws_; ///< of resistance and rubber, whose numbers are listed
  std::optional<DesignSweepCurve> shown_;    ///< as it is displayed
  QComboBox* number_ = nullptr;
  QDoubleSpinBox* from_ = nullptr;
  QDoubleSpinBox* to_ = nullptr;
  QSpinBox* steps_ = nullptr;
  QPushButton* start_ = nullptr;
  QPushButton* save_ = nullptr;
  QLabel* words_ = nullptr;
  QLabel* stale_ = nullptr;
  ChartView* chart_ = nullptr;
};

} // namespace palp
