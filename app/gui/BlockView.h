#pragma once

#include "app/gui/VtkView.h"
#include "app/scenes/DeformationScene.h"

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
  /// Where a point of the drawn scene lies in the widget.
  [[nodiscard]] QPointF placeOf(const Eigen::Vector3d& drawn_mm) const;
  void markNode(int node);

signals:
  /// The mesh node drawn where the surface was clicked.
  void nodeClicked(int node);

private:
  struct Parts;
  BlockView(std::unique_ptr<Parts> parts, QWidget* parent);
  void pick(const QPointF& place);

  std::unique_ptr<Parts> parts_;
};

} // namespace palp
