#pragma once

#include "app/gui/jobs/NetworkSession.h"
#include "app/gui/project/Workbench.h"
#include "app/gui/window/Scene.h"
#include "app/scenes/block/DeformationScene.h"
#include "solver/MeshQuality.h"

class QCheckBox;
class QDoubleSpinBox;
class QGroupBox;
class QLabel;

namespace palp {

class BlockView;
class ChartView;
class DesignComparison;
class DesignMap;
class DesignPanel;
class DesignSweep;
class LayoutFinder;
class NoiseFloor;

/// The sensor at rest with all its parameters; the mesh only on request.
class DesignPage : public Scene {
  Q_OBJECT

public:
  DesignPage(Workbench& workbench, NetworkSession& network, QWidget* parent = nullptr);

  [[nodiscard]] Stage stage() const override;
  void setTheme(Theme theme) override;
  [[nodiscard]] bool complete() const override;
  [[nodiscard]] std::vector<JobRunner*> runners() override;
  [[nodiscard]] QString commands(const Project& project, const QString& designFile) const override;

signals:
  /// The page needs another stage than before.
  void stageChanged();
  void sceneRequested(const QString& scene);

protected:
  void showEvent(QShowEvent* event) override;

private:
  QWidget* buildSide();
  QWidget* buildViews();
  QWidget* buildStudies();
  void displayProject();
  void draw();
  void displayMesh();
  void measureMesh();
  void editMesh();
  QGroupBox* buildMesh();

  Workbench& workbench_;
  NetworkSession& network_;
  DeformationOptions options_;
  DesignPanel* panel_ = nullptr;
  LayoutFinder* finder_ = nullptr;
  DesignSweep* sweep_ = nullptr;
  DesignComparison* comparison_ = nullptr;
  DesignMap* map_ = nullptr;
  BlockView* block_ = nullptr;
  QCheckBox* showMesh_ = nullptr;
  QCheckBox* automaticSize_ = nullptr;
  QDoubleSpinBox* size_ = nullptr;
  QLabel* meshWords_ = nullptr;
  ChartView* quality_ = nullptr;
  NoiseFloor* floor_ = nullptr;
  quint64 mesh_ = 0;                    ///< number of the mesh that is shown
  std::optional<MeshQuality> measured_; ///< of that mesh
  bool measureRequested_ = false;
  JobRunner measuring_;
};

} // namespace palp
