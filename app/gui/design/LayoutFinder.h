#pragma once

#include "app/gui/jobs/JobRunner.h"
#include "app/gui/project/Workbench.h"

#include <QWidget>

#include <optional>

class QComboBox;
class QLabel;
class QPushButton;

namespace palp {

/// Searches places and depths of the electrodes that lower the noise floor, and takes them over by one click.
class LayoutFinder : public QWidget {
  Q_OBJECT

public:
  explicit LayoutFinder(Workbench& workbench, QWidget* parent = nullptr);

  [[nodiscard]] JobRunner& runner() { return runner_; }
  void displayProject();

private:
  void search();
  void takeOver();

  Workbench& workbench_;
  JobRunner runner_;
  std::optional<FoundLayout> shown_; ///< as it is displayed
  QComboBox* freedom_ = nullptr;
  QPushButton* search_ = nullptr;
  QPushButton* takeOver_ = nullptr;
  QLabel* words_ = nullptr;
};

} // namespace palp
