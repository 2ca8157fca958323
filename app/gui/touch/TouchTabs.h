#pragma once

#include "app/gui/project/Project.h"
#include "app/gui/touch/DeformationCharts.h"

#include <QTabWidget>

class QLineEdit;
class QSpinBox;

namespace palp {

class ChartView;
class ElectrodeTable;
class HeatmapView;
class TouchSession;
class Workbench;
struct ReferencePath;

/// Under the block: heatmap and Newton's residuals, a row-wire before and under the load, a plot along a line, the
/// electrodes as a table, reaction and displacement along the load. Only the visible tab is drawn.
class TouchTabs : public QTabWidget {
  Q_OBJECT

public:
  explicit TouchTabs(Workbench& workbench, QWidget* parent = nullptr);

  void setTheme(Theme theme);
  void displayProject(const Project& project);
  /// `kept`: the design that it is compared with; null: none.
  void displayTouch(bool meshChanged, std::shared_ptr<const ReferencePath> kept);
  void drawNewton();
  /// Shows the plot along the line.
  void showLine();
  [[nodiscard]] bool lineShown() const;
  /// Nothing that the visible tab shows is being computed.
  [[nodiscard]] bool complete() const;

signals:
  void lineShownChanged();
  void cellClicked(int rowWire, int columnWire);
  /// By the user's hand only.
  void edited(const QString& what, const palp::ViewSettings& view);

private:
  QWidget* buildTouch();
  QWidget* buildRowWire();
  QWidget* buildLine();
  QWidget* buildLoad();
  void draw();
  void drawHeatmap();
  void drawRowWire();
  void drawLine();
  void drawLoad();
  void fillTable();
  void readLine();

  Workbench& workbench_;
  const TouchSession& session_;
  ViewSettings view_;
  std::vector<NewtonStep> drawnSteps_;
  LinePlot plot_;
  std::shared_ptr<const ReferencePath> kept_;
  HeatmapView* heatmap_ = nullptr;
  ChartView* newton_ = nullptr;
  ChartView* rowWire_ = nullptr;
  ChartView* rowShape_ = nullptr;
  QSpinBox* rowWireNumber_ = nullptr;
  QWidget* linePage_ = nullptr;
  std::array<QLineEdit*, 2> ends_{};
  ChartView* line_ = nullptr;
  ChartView* reaction_ = nullptr;
  ChartView* forceWay_ = nullptr;
  ElectrodeTable* table_ = nullptr;
};

} // namespace palp
