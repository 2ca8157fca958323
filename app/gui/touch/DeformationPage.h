#pragma once

#include "app/gui/project/Workbench.h"
#include "app/gui/window/Scene.h"
#include "app/scenes/block/DeformationScene.h"

namespace palp {

class BlockView;
class LoadPanel;
class LoadPathBar;
class PathPanel;
class ResultPanel;
class TouchTabs;
class ViewPanel;

/// The deformed block with the loads to set, and under it what else is known of the touch.
class DeformationPage : public Scene {
  Q_OBJECT

public:
  explicit DeformationPage(Workbench& workbench, QWidget* parent = nullptr);

  [[nodiscard]] Stage stage() const override { return Stage::Resistances; }
  void setTheme(Theme theme) override;
  [[nodiscard]] bool complete() const override;
  [[nodiscard]] BlockView& block() { return *block_; }
  /// How the block is drawn now.
  [[nodiscard]] DeformationOptions blockOptions() const;
  /// What the block is drawn less, where it is; null where not, and before it is computed.
  [[nodiscard]] std::shared_ptr<const ReferencePath> shownLess() const;
  [[nodiscard]] QString commands(const Project& project, const QString& designFile) const override;

signals:
  void message(const QString& sentence);

protected:
  void showEvent(QShowEvent* event) override;

private:
  [[nodiscard]] bool lessReference() const;
  /// What a click on the block does.
  enum class Click { Probe, Load, Disc, Indenter, Line };

  QWidget* buildPanels();
  QWidget* buildViews();
  QWidget* buildClicks();
  void displayProject();
  void displayTouch(bool meshChanged);
  void drawBlock(bool meshChanged);
  void displayResult();
  void probe(int node);
  void clicked(int node);
  void chooseTool(Click click);
  /// A press on the top face, by the selected tool: selects a load, adds one, or removes a disc.
  void press(const Eigen::Vector3d& rest_mm);
  void addLineEnd(int node);
  void setForce(int load, const Eigen::Vector3d& drawn_N);
  void editView(const QString& what, const ViewSettings& view);

  Workbench& workbench_;
  Theme theme_ = Theme::Light;
  bool meshDrawn_ = false;
  ViewSettings drawn_; ///< as the block was drawn last
  std::optional<IndenterPath> drawnPath_;
  int probedNode_ = -1;
  Click click_ = Click::Probe;
  int lineStart_ = -1; ///< node of the first end, while the second is awaited
  LoadPanel* load_ = nullptr;
  ViewPanel* view_ = nullptr;
  ResultPanel* result_ = nullptr;
  BlockView* block_ = nullptr;
  TouchTabs* tabs_ = nullptr;
  LoadPathBar* path_ = nullptr;
  PathPanel* steps_ = nullptr;
};

} // namespace palp
