#pragma once

#include "app/gui/jobs/JobRunner.h"
#include "app/gui/project/Workbench.h"
#include "app/scenes/Palette.h"

#include <QWidget>

#include <optional>
#include <vector>

class QComboBox;
class QLabel;
class QPushButton;

namespace palp {

class HeatmapView;

/// The design compared with an earlier one, of the history or the reference: what both resolve, and how their answers
/// to the load differ.
class DesignComparison : public QWidget {
  Q_OBJECT

public:
  explicit DesignComparison(Workbench& workbench, QWidget* parent = nullptr);

  [[nodiscard]] JobRunner& runner() { return runner_; }
  void setTheme(Theme theme);
  void displayProject();

signals:
  /// The difference of the fields is to be seen.
  void fieldsRequested();

private:
  /// A design that can be compared with.
  struct Choice {
    QString name;
    SensorDesign design;
  };
  void build();
  [[nodiscard]] const Choice* chosen() const;
  void listChoices();
  void choose(int index);
  void keep();
  void goBack();
  void showFields();
  void compare();
  void showCompared();

  Workbench& workbench_;
  JobRunner runner_;
  std::vector<Choice> choices_;
  std::vector<SensorDesign> referencesBefore_; ///< in whose place another one was kept since
  std::optional<SensorDesign> asked_;          ///< chosen by hand, or just kept
  std::optional<DesignsCompared> shown_;       ///< as it is displayed
  QComboBox* list_ = nullptr;
  QPushButton* keep_ = nullptr;
  QPushButton* compare_ = nullptr;
  QPushButton* back_ = nullptr;
  QPushButton* fields_ = nullptr;
  QLabel* words_ = nullptr;
  QLabel* stale_ = nullptr;
  HeatmapView* difference_ = nullptr;
};

} // namespace palp
