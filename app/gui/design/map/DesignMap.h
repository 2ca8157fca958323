#pragma once

#include "app/gui/jobs/JobRunner.h"
#include "app/gui/project/Workbench.h"
#include "app/scenes/Palette.h"

#include <QWidget>

#include <memory>
#include <optional>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QPushButton;
class QSpinBox;

namespace palp {

class HeatmapView;
struct FaceMap;
struct MapBasis;

/// What the design resolves of a touch at each place of its top face: force, place and two touches apart, as a map that
/// lies over the block too.
class DesignMap : public QWidget {
  Q_OBJECT

public:
  explicit DesignMap(Workbench& workbench, QWidget* parent = nullptr);

  [[nodiscard]] JobRunner& runner() { return runner_; }
  void setTheme(Theme theme);
  void displayProject();
  /// To be drawn over the block: null where there is no map of it, and while this is not seen.
  [[nodiscard]] std::shared_ptr<const FaceMap> overBlock() const;

signals:
  /// Another map, or none, is to be drawn over the block.
  void overBlockChanged();

protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

private:
  void build();
  void buildTouch(QFormLayout& form);
  void listLaws(const SensorDesign& design);
  void readSettings();
  void chooseQuantity(int quantity);
  void run();
  void showMap();
  [[nodiscard]] std::size_t quantity() const;
  [[nodiscard]] QString staleWords() const;

  Workbench& workbench_;
  JobRunner runner_;
  std::shared_ptr<const MapBasis> basis_; ///< of the last map, while this is seen
  std::optional<MappedResolution> shown_; ///< as it is displayed
  std::string shownQuantity_;
  QComboBox* shape_ = nullptr;
  QDoubleSpinBox* radius_ = nullptr;
  QDoubleSpinBox* force_ = nullptr;
  QDoubleSpinBox* noise_ = nullptr;
  QSpinBox* places_ = nullptr;
  QComboBox* law_ = nullptr;
  QComboBox* quantity_ = nullptr;
  QCheckBox* onBlock_ = nullptr;
  QPushButton* start_ = nullptr;
  QLabel* words_ = nullptr;
  QLabel* stale_ = nullptr;
  HeatmapView* map_ = nullptr;
};

} // namespace palp
