#pragma once

#include "app/gui/jobs/JobRunner.h"
#include "app/gui/project/Workbench.h"
#include "app/scenes/Palette.h"

#include <QWidget>

#include <array>
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

signals:
  /// The difference of the fields is to be seen.
  void fieldsAsked();

private:
  void keep();
  void goBack();
  void showFields();
  void compare();

  Workbench& workbench_;
  JobRunner runner_;
  std::optional<std::array<SensorDesign, 2>> compared_; ///< kept and other one of the comparison that is shown
  QPushButton* keep_ = nullptr;
  QPushButton* compare_ = nullptr;
  QPushButton* back_ = nullptr;
  QPushButton* fields_ = nullptr;
  QLabel* words_ = nullptr;
  QLabel* stale_ = nullptr;
  HeatmapView* difference_ = nullptr;
};

} // namespace palp
