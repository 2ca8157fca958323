#pragma once

#include "app/gui/project/Workbench.h"
#include "app/gui/window/Scene.h"
#include "app/scenes/block/DeformationScene.h"
#include "app/scenes/charts/Heatmap.h"

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
  [[nodiscard]] QString commands(const Project& project, const QString& designFile) const override;

protected:
  void showEvent(QShowEvent* event) override;

private:
  QWidget* buildBar();
  void draw(bool meshChanged);
  void drawHeatmap();
  void drawCurves();
  void drawBlock(bool meshChanged);
  void displayProject();
  void edit(const QString& what, const ViewSettings& view);
  /// The chosen cell, inside the shown design.
  [[nodiscard]] std::array<int, 2> cell() const;
  /// Another design is kept that has as many wires: the changes can be compared.
  [[nodiscard]] bool comparable() const;
  /// As chosen, where that can be shown.
  [[nodiscard]] ResistanceKind kind() const;
  [[nodiscard]] HeatmapSpec heatmap() const;
  /// Its resistance at rest and under the load.
  [[nodiscard]] QString cellWords(const std::array<int, 2>& cell) const;

  Workbench& workbench_;
  DeformationOptions options_;
  bool meshDrawn_ = false;
  ViewSettings drawn_; ///< as drawn last
  QComboBox* kind_ = nullptr;
  QCheckBox* fixed_ = nullptr;
  QLabel* reading_ = nullptr;
  HeatmapView* heatmap_ = nullptr;
  ChartView* row_ = nullptr;
  ChartView* column_ = nullptr;
  BlockView* block_ = nullptr;
};

} // namespace palp
