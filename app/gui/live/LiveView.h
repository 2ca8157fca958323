#pragma once

#include "app/gui/views/VtkView.h"
#include "app/scenes/block/LiveScene.h"

namespace palp {

/// Force vectors over the sensor at rest; double click looks at all of it again. A touch on the simulated board is set
/// by the mouse or by keys: Return takes or releases it, the arrows move it from area to area, + and - press
/// harder and softer, Shift with the arrows shears.
class LiveView : public VtkView {
  Q_OBJECT

public:
  explicit LiveView(QWidget* parent = nullptr);
  ~LiveView() override;

  void showSensor(const SensorDesign& design, double mm_per_N, bool electrodes);
  /// Draws only where something changed.
  /// `truth_mm`: where a simulated indenter truly is.
  void showForces(const std::vector<LiveArrow>& arrows, bool stale, const std::vector<std::string>& lines,
                  const std::optional<Eigen::Vector2d>& truth_mm = {});
  void setTheme(Theme theme);
  /// A press on an area, and a drag from there, are a touch instead of a turn of the camera.
  void setPressable(bool pressable, int area) {
    pressable_ = pressable;
    area_ = area;
  }
  /// The touch is an indenter's: it is pressed at a place, and goes where it is dragged.
  void setPlaced(bool placed) { placed_ = placed; }
  void lookAlong(const Eigen::Vector3d& direction);
  [[nodiscard]] const std::vector<LiveArrow>& arrows() const;
  [[nodiscard]] const std::optional<Eigen::Vector2d>& truth_mm() const;
  [[nodiscard]] bool stale() const;

signals:
  void areaPressed(int area);
  void placePressed(const Eigen::Vector2d& at_mm);
  /// The position of the touch is to change by this.
  void placeStepped(const Eigen::Vector2d& by_mm);
  /// How far the press was dragged over the top face, as a force by the scale of the arrows [N].
  void sheared(const Eigen::Vector2d& force_N);
  /// The force of the touch is to change by this [N].
  void forceStepped(const Eigen::Vector3d& by_N);
  /// The touch is to be taken by hand, or released.
  void handRequested();

protected:
  void changeEvent(QEvent* event) override;
  bool grab(const QPointF& place, Qt::KeyboardModifiers modifiers) override;
  void dragTo(const QPointF& place, Qt::KeyboardModifiers modifiers) override;
  void keyPressEvent(QKeyEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

private:
  struct Parts;
  LiveView(std::unique_ptr<Parts> parts, QWidget* parent);
  void draw();
  /// From where all is seen; a smaller view shows all again, until the user turns it.
  void fit(const Eigen::Vector3d& direction);
  [[nodiscard]] Eigen::Vector3d eye() const;

  [[nodiscard]] std::optional<Eigen::Vector2d> topPlace(const QPointF& place) const;

  std::unique_ptr<Parts> parts_;
  /// The area next to the touch in the direction of an arrow key.
  [[nodiscard]] int areaBeside(int dx, int dy) const;

  bool pressable_ = false, placed_ = false;
  int area_ = 0; ///< of the touch
  Eigen::Vector2d pressed_mm_ = Eigen::Vector2d::Zero();
  Eigen::Vector3d direction_, fittedEye_; ///< of the camera, as it was fitted last
};

} // namespace palp
