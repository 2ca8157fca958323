#pragma once

#include "app/gui/views/PictureView.h"

#include <memory>

class vtkInteractorObserver;
class vtkRenderer;

namespace palp {

/// A VTK renderer in a plain widget: drawn without a surface, read back and painted. A camera is turned, moved and
/// zoomed by mouse and keys.
class VtkView : public PictureView {
  Q_OBJECT

public:
  /// `style` may be null: then the mouse turns, pans and zooms the camera.
  VtkView(vtkRenderer* renderer, vtkInteractorObserver* style, QWidget* parent = nullptr);
  ~VtkView() override;

  /// Releases what drawing needs, about 10 MB on a software renderer, where the view is not seen or its picture
  /// does not change; the next drawing starts from scratch.
  void giveBack();
  /// It holds what drawing needs.
  [[nodiscard]] bool drawn() const;

protected:
  /// Takes the left button for the view itself, before VTK: true at the press, then dragging until the release.
  virtual bool grab(const QPointF& place, Qt::KeyboardModifiers modifiers);
  virtual void dragTo(const QPointF& place, Qt::KeyboardModifiers modifiers);
  virtual void drop();

  /// What is seen changes only where something new is shown: a picture of it does as long.
  [[nodiscard]] virtual bool standsStill() const { return false; }

  /// Draws a part into the window, by renderUnseen(), as a first drawing of all takes too long for one pass of the
  /// event loop: each of the parts 0, 1... has a pass of its own; false: there is none of this number.
  [[nodiscard]] virtual bool drawPart(int /*part*/) { return false; }
  void renderUnseen(const QSize& size);

  void render(QImage& image) override;
  [[nodiscard]] bool prepared() override;
  [[nodiscard]] Picture renderPicture(int width, int height) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

private:
  void drawFirst();
  void passPlace(const QPointF& place, Qt::KeyboardModifiers modifiers);

  /// As a drag from the middle would do it, with the left button or, moving, with Shift.
  void dragCamera(const QPointF& way, bool moving);

  struct Vtk;
  std::unique_ptr<Vtk> vtk_;
  bool hasCamera_; ///< and no style of its own
  int wheel_ = 0;
  bool grabbed_ = false;
};

/// What all views of a window that need not draw now hold for it goes back to the system.
void releaseViews(const QWidget& window);

} // namespace palp
