#pragma once

#include "app/gui/jobs/JobRunner.h"
#include "app/gui/project/Workbench.h"
#include "app/scenes/Palette.h"

#include <QWidget>

#include <optional>

class QLabel;
class QPushButton;

namespace palp {

class HeatmapView;

/// The design beside one that was kept: what both resolve, and how their answers to the load differ.
class DesignComparison : public QWidget {
  Q_OBJECT

public:
  explicit DesignComparison(Workbench& workbench, QWidget* parent = nullptr);

  [[nodiscard]] JobRunner& runner() { return runner_; }
  void setTheme(Theme theme);
  void displayProject();

private:
  void compare();

  Workbench& workbench_;
  JobRunner runner_;
  std::optional<SensorDesign> kept_;
  std::optional<SensorDesign> compared_; ///< the other one of the comparison that is shown
  QPushButton* keep_ = nullptr;
  QPushButton* compare_ = nullptr;
  QPushButton* back_ = nullptr;
  QLabel* words_ = nullptr;
  QLabel* stale_ = nullptr;
  HeatmapView* difference_ = nullptr;
};

} // namespace palp
