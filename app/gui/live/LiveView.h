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
  /// A press on an area, and a drag from there, are a touch instead of a turn of the camera.
  void setPressable(bool pressable) { pressable_ = pressable; }
  void lookAlong(const Eigen::Vector3d& direction);
  [[nodiscard]] const std::vector<LiveArrow>& arrows() const;
  [[nodiscard]] bool stale() const;

signals:
  void areaPressed(int area);
  /// How far the press was dragged over the top face, as a force by the scale of the arrows [N].
  void sheared(const Eigen::Vector2d& force_N);

protected:
  bool grab(const QPointF& place, Qt::KeyboardModifiers modifiers) override;
  void dragTo(const QPointF& place, Qt::KeyboardModifiers modifiers) override;

private:
  struct Parts;
  LiveView(std::unique_ptr<Parts> parts, QWidget* parent);
  void draw();

  [[nodiscard]] std::optional<Eigen::Vector2d> topPlace(const QPointF& place) const;

  std::unique_ptr<Parts> parts_;
  bool pressable_ = false;
  Eigen::Vector2d pressed_mm_ = Eigen::Vector2d::Zero();
};

} // namespace palp
