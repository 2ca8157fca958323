#pragma once

#include "app/gui/project/Workbench.h"
#include "app/gui/touch/CurrentPathsJob.h"
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
class LawBar;

/// Row-column resistances under the load by the law of the design: a heatmap, under the field with that of Eq. (1)
/// next to it, the row and the column of a cell as curves, its electrodes highlighted.
class ResistancePage : public Scene {
  Q_OBJECT

public:
  explicit ResistancePage(Workbench& workbench, QWidget* parent = nullptr);

  [[nodiscard]] Stage stage() const override { return Stage::Resistances; }
  void setTheme(Theme theme) override;
  [[nodiscard]] bool complete() const override;
  [[nodiscard]] std::vector<JobRunner*> runners() override { return {&current_.runner()}; }
  [[nodiscard]] QString commands(const Project& project, const QString& designFile) const override;

protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

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
  /// The block shows the current paths.
  [[nodiscard]] bool wayShown() const;
  /// Why there is no result of the reference design; empty where there is, or while it is computed.
  [[nodiscard]] QString referenceProblem() const;
  /// Of the touch that is shown, by its law; asks for the field where it is not there yet.
  void findResistances();
  /// How those of the field compare with those of Eq. (1).
  void drawBeside();
  /// A cell's resistance at rest and under the load, and where its current goes.
  void displayWords(const std::array<int, 2>& cell);

  Workbench& workbench_;
  DeformationOptions options_;
  CurrentPathsJob current_;
  std::optional<TouchResistances> resistances_; ///< that are shown
  bool meshDrawn_ = false;
  ViewSettings drawn_; ///< as drawn last
  LawBar* law_ = nullptr;
  QComboBox* kind_ = nullptr;
  QCheckBox* fixed_ = nullptr;
  QCheckBox* currentPaths_ = nullptr;
  QLabel* reading_ = nullptr;
  QLabel* laws_ = nullptr;
  QLabel* paths_ = nullptr;
  HeatmapView* heatmap_ = nullptr;
  HeatmapView* pairs_ = nullptr; ///< by Eq. (1), next to those by the field
  ChartView* row_ = nullptr;
  ChartView* column_ = nullptr;
  BlockView* block_ = nullptr;
};

} // namespace palp
