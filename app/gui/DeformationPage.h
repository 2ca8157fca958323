#pragma once

#include "app/gui/Scene.h"
#include "app/gui/Workbench.h"
#include "app/scenes/DeformationScene.h"

class QLabel;
class QPushButton;
class QSlider;
class QSpinBox;
class QTableWidget;

namespace palp {

class BlockView;
class ChartView;
class HeatmapView;
class LoadPanel;
class ViewPanel;

/// The deformed block, its heatmap and Newton's residuals, with the loads to set.
class DeformationPage : public Scene {
  Q_OBJECT

public:
  explicit DeformationPage(Workbench& workbench, QWidget* parent = nullptr);

  [[nodiscard]] Stage stage() const override { return Stage::Resistances; }
  void setTheme(Theme theme) override;
  [[nodiscard]] bool complete() const override;
  [[nodiscard]] BlockView& block() { return *block_; }

protected:
  void showEvent(QShowEvent* event) override;

private:
  QWidget* buildPanels();
  QWidget* buildViews();
  QWidget* buildElectrodes();
  void displayProject();
  void displayTouch(bool meshChanged);
  void drawBlock(bool meshChanged);
  void drawHeatmap();
  void drawNewton();
  /// Electrodes of a row-wire before and under the load (Figs. 6 and 7), and all of them as a table.
  void drawRowWire();
  void fillTable();
  void tellResult();
  void probe(int node);
  /// Chooses the loaded area on which a node of the top face lies; a click never adds a load by itself.
  void chooseAreaOf(int node);

  Workbench& workbench_;
  DeformationOptions options_;
  bool meshDrawn_ = false;
  int probedNode_ = -1;
  std::vector<NewtonStep> drawnSteps_;
  LoadPanel* load_ = nullptr;
  ViewPanel* view_ = nullptr;
  BlockView* block_ = nullptr;
  HeatmapView* heatmap_ = nullptr;
  ChartView* newton_ = nullptr;
  ChartView* rowWire_ = nullptr;
  QSpinBox* rowWireNumber_ = nullptr;
  QTableWidget* table_ = nullptr;
  QSlider* increments_ = nullptr;
  QLabel* incrementLabel_ = nullptr;
  QLabel* result_ = nullptr;
  QLabel* probe_ = nullptr;
  QPushButton* estimate_ = nullptr;
  QString errorText_;
};

} // namespace palp
