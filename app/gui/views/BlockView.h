#pragma once

#include "app/gui/views/VtkView.h"
#include "app/scenes/block/DeformationScene.h"

class vtkCamera;

namespace palp {

/// The block in a view: turned, moved and zoomed by the mouse; double click looks at all of it again.
class BlockView : public VtkView {
  Q_OBJECT

public:
  explicit BlockView(QWidget* parent = nullptr);
  ~BlockView() override;

  /// What is in the state stays the caller's until the next call.
  void show(const DeformationState& state, const DeformationOptions& options, bool meshChanged);
  void resetCamera();
  /// The ground before anything is shown.
  void setTheme(Theme theme);
  /// Looks along a direction, z or y up.
  void lookAlong(const Eigen::Vector3d& direction);
  [[nodiscard]] double warpFactor() const;
  [[nodiscard]] std::array<double, 3> cameraPosition() const;
  [[nodiscard]] vtkCamera* camera() const;
  /// Where a point of the drawn scene lies in the widget.
  [[nodiscard]] QPointF placeOf(const Eigen::Vector3d& drawn_mm) const;
  void markNode(int node);

  /// Where the arrow of the k-th load can be gripped; none where it is not drawn.
  [[nodiscard]] std::optional<QPointF> gripOf(int load) const;
  /// Lets the arrows be dragged.
  void setForcesMovable(bool movable) { movable_ = movable; }

signals:
  /// The mesh node drawn where the surface was clicked.
  void nodeClicked(int node);
  /// The free end of an arrow was dragged and let go: the force as drawn, which is the load's at the load fraction.
  void forceDragged(int load, const Eigen::Vector3d& drawn_N);

protected:
  bool grab(const QPointF& place) override;
  void dragTo(const QPointF& place, Qt::KeyboardModifiers modifiers) override;
  void drop() override;

private:
  struct Parts;
  BlockView(std::unique_ptr<Parts> parts, QWidget* parent);
  void pick(const QPointF& place);
  /// The point of the plane through `anchor`, parallel to the view, that is drawn at a place of the widget.
  [[nodiscard]] Eigen::Vector3d pointAt(const QPointF& place, const Eigen::Vector3d& anchor_mm) const;
  /// The arrow whose free half lies under the place; -1 where none does.
  [[nodiscard]] int arrowAt(const QPointF& place) const;

  std::unique_ptr<Parts> parts_;
  bool movable_ = false;
  int dragged_ = -1; ///< arrow
};

} // namespace palp
