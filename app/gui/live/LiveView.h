#pragma once

#include "app/gui/views/VtkView.h"
#include "app/scenes/block/LiveScene.h"

namespace palp {

/// Force vectors over the sensor at rest; double click looks at all of it again.
class LiveView : public VtkView {
  Q_OBJECT

public:
  explicit LiveView(QWidget* parent = nullptr);
  ~LiveView() override;

  void showSensor(const SensorDesign& design, double mm_per_N, bool electrodes);
  /// Draws only where something changed.
  void showForces(const std::vector<LiveArrow>& arrows, bool stale, const std::vector<std::string>& lines);
  void setTheme(Theme theme);
  void lookAlong(const Eigen::Vector3d& direction);
  [[nodiscard]] const std::vector<LiveArrow>& arrows() const;
  [[nodiscard]] bool stale() const;

private:
  struct Parts;
  LiveView(std::unique_ptr<Parts> parts, QWidget* parent);
  void draw();

  std::unique_ptr<Parts> parts_;
};

} // namespace palp
