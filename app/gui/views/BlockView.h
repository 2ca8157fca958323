#pragma once

#include "app/gui/views/DiscHandle.h"
#include "app/gui/views/VtkView.h"
#include "app/scenes/block/DeformationScene.h"

class vtkCamera;

namespace palp {

/// The block in a view: turned, moved and zoomed by the mouse; double click looks at all of it again. By keys: a cross
/// (Ctrl and arrows; N: to the next thing that can be taken) takes what lies under it, carries it and lets it go, or
/// clicks there (space).
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
  /// Looks along a direction, z up, or y where that is straight down or up.
  void lookAlong(const Eigen::Vector3d& direction);
  [[nodiscard]] double deformationScale() const;
  [[nodiscard]] std::array<double, 2> colorRange() const;
  [[nodiscard]] std::array<double, 3> cameraPosition() const;
  [[nodiscard]] vtkCamera* camera() const;
  /// Where a point of the drawn scene lies in the widget.
  [[nodiscard]] QPointF placeOf(const Eigen::Vector3d& drawn_mm) const;
  void markNode(int node);

  /// Where the arrow of the k-th load can be gripped; none where it is not drawn.
  [[nodiscard]] std::optional<QPointF> gripOf(int load) const;
  /// Where the cut is taken by the mouse; none where there is no cut.
  [[nodiscard]] std::optional<QPointF> cutGrip() const;
  /// Lets the arrows be dragged.
  void setForcesMovable(bool movable) { movable_ = movable; }
  /// What the mouse moves on the top face, and sizes at its rim.
  enum class Movable { None, Discs, Indenters };
  void setMovable(Movable what) { handles_ = what; }
  /// The cross of the keys; none before one of them was pressed.
  [[nodiscard]] std::optional<QPointF> cross() const { return cross_; }
  /// What the ball at a position of the widget marks; empty where its label is shown, or there is none.
  [[nodiscard]] QString tipAt(const QPointF& place) const;

signals:
  /// The mesh node drawn where the surface was clicked.
  void nodeClicked(int node);
  /// The same click: where the material under it lies at rest.
  void materialClicked(const Eigen::Vector3d& rest_mm);
  /// The free end of an arrow was dragged and released: the force as drawn, which is the load's at the load fraction.
  void forceDragged(int load, const Eigen::Vector3d& drawn_N);
  /// The cut is being dragged and lies here now.
  void cutDragged(double at_mm);
  /// A disc was dragged by the mouse and released, there or elsewhere.
  void discDragged(int disc, const palp::PatchLoad& to);
  /// A path was drawn over the top face from this indenter's position: by Ctrl and the left button.
  void wayDrawn(int indenter, const Eigen::Matrix2Xd& way_mm);
  /// The same of an indenter: its place, or its radius. What was not dragged may be another by now than is shown.
  void indenterMoved(int indenter, const Eigen::Vector2d& place_mm);
  void indenterSized(int indenter, double radius_mm);

protected:
  [[nodiscard]] Picture renderPicture(int width, int height) override;
  bool event(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  void changeEvent(QEvent* event) override;
  bool grab(const QPointF& place, Qt::KeyboardModifiers modifiers) override;
  void dragTo(const QPointF& place, Qt::KeyboardModifiers modifiers) override;
  void drop() override;

private:
  struct Parts;
  BlockView(std::unique_ptr<Parts> parts, QWidget* parent);
  void pick(const QPointF& place);
  void setTextScale(double scale);
  [[nodiscard]] int loadCount() const;
  /// Discs that the mouse can take: the loads, or the indenters as seen from above.
  [[nodiscard]] std::vector<PatchLoad> handles() const;
  [[nodiscard]] double height_mm() const; ///< of the block; 0 before it is there
  /// Words as large as the widget's.
  void scaleText();
  void moveCross(const QPointF& to);
  void useCross(Qt::KeyboardModifiers modifiers);
  void crossToNextGrip();
  /// Places where something can be taken: arrows, the cut's knob, middles and rims of discs.
  [[nodiscard]] std::vector<QPointF> grips() const;
  /// The point of the plane through `anchor`, parallel to the view, that is drawn at a place of the widget.
  [[nodiscard]] Eigen::Vector3d pointAt(const QPointF& place, const Eigen::Vector3d& anchor_mm) const;
  /// Where the line of sight through a position of the widget meets the top face's plane at rest; nullopt outside it.
  [[nodiscard]] std::optional<Eigen::Vector2d> topPlace_mm(const QPointF& place) const;
  void showCursor(const QPointF& place);
  [[nodiscard]] bool cutAt(const QPointF& place) const;
  void dragCut(const QPointF& place);
  void moveHandle(const PatchLoad& to);
  /// Begins a path at an indenter; false elsewhere.
  bool beginWay(const Eigen::Vector2d& at_mm);
  void drawWay(const Eigen::Vector2d& at_mm);
  /// The arrow whose free half lies under the place; -1 where none does.
  [[nodiscard]] int arrowAt(const QPointF& place) const;

  std::unique_ptr<Parts> parts_;
  bool movable_ = false;
  Movable handles_ = Movable::None;
  DiscHandle disc_;
  std::optional<CutPlane> cut_; ///< as drawn, with its grip
  bool cutHeld_ = false;
  Eigen::Matrix2Xd way_mm_; ///< being drawn
  int wayOf_ = -1;          ///< indenter; -1: none is drawn
  int dragged_ = -1;        ///< arrow
  std::optional<QPointF> cross_;
  bool crossHolds_ = false;
  std::size_t nextGrip_ = 0;
  double scale_ = 1; ///< of the last state's options
};

} // namespace palp
