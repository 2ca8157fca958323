#pragma once

#include "app/gui/Scene.h"
#include "app/gui/Workbench.h"
#include "app/scenes/DeformationScene.h"

class QCheckBox;
class QComboBox;
class QLabel;

namespace palp {

class BlockView;
class ChartView;
class HeatmapView;

/// Row-column resistances under the load: a heatmap, the row and the column of a cell as curves, its electrodes lit.
class ResistancePage : public Scene {
  Q_OBJECT

public:
  explicit ResistancePage(Workbench& workbench, QWidget* parent = nullptr);

  [[nodiscard]] Stage stage() const override { return Stage::Resistances; }
  void setTheme(Theme theme) override;
  [[nodiscard]] bool complete() const override;

protected:
  void showEvent(QShowEvent* event) override;

private:
  QWidget* buildBar();
  void draw(bool meshChanged);
  void drawHeatmap();
  void drawCurves();
  void drawBlock(bool meshChanged);

  Workbench& workbench_;
  DeformationOptions options_;
  bool meshDrawn_ = false;
  std::array<int, 2> cell_{4, 15};
  QComboBox* kind_ = nullptr;
  QCheckBox* fixed_ = nullptr;
  std::optional<std::array<double, 2>> fixedRange_; ///< of the colours, while the scale is fixed
  QLabel* reading_ = nullptr;
  HeatmapView* heatmap_ = nullptr;
  ChartView* row_ = nullptr;
  ChartView* column_ = nullptr;
  BlockView* block_ = nullptr;
};

} // namespace palp
