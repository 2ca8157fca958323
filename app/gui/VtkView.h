#pragma once

#include "app/scenes/Palette.h"
#include "app/scenes/Picture.h"

#include <QImage>
#include <QPointF>
#include <QWidget>

#include <memory>

class vtkInteractorObserver;
class vtkRenderer;

namespace palp {

/// A VTK renderer in a plain widget: drawn without a surface, read back and painted. Rendered at most once a paint, and
/// only where something changed; costs nothing while hidden.
class VtkView : public QWidget {
  Q_OBJECT

public:
  /// `style` may be null: then the mouse turns, pans and zooms the camera.
  VtkView(vtkRenderer* renderer, vtkInteractorObserver* style, QWidget* parent = nullptr);
  ~VtkView() override;

  /// Something changed: render at the next paint.
  void invalidate();
  /// What the view shows, as an image of its size in device pixels.
  [[nodiscard]] const QImage& image();
  /// The view in another size.
  [[nodiscard]] Picture picture(int width, int height);
  [[nodiscard]] int renderCount() const { return renderCount_; }
  [[nodiscard]] double aspect() const;
  /// A place of the widget as VTK counts: device pixels from the lower left.
  [[nodiscard]] QPointF devicePlace(const QPointF& place) const;

signals:
  /// Pressed and released at one place.
  void clicked(const QPointF& place);
  void hovered(const QPointF& place);
  void doubleClicked();
  void sizeChanged();

protected:
  /// Takes the left button for the view itself, before VTK: true at the press, then dragging until the release.
  virtual bool grab(const QPointF& place);
  virtual void dragTo(const QPointF& place, Qt::KeyboardModifiers modifiers);
  virtual void drop();

  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void leaveEvent(QEvent* event) override;

private:
  void draw();
  /// Asks for a size and a file and saves the view as PNG; or copies it.
  void offerPicture(const QPoint& globalPlace);
  /// Empty where none was given.
  [[nodiscard]] QSize askSize(const QSize& now);
  void savePicture(const QSize& size);
  void tellPlace(const QPointF& place, Qt::KeyboardModifiers modifiers);

  struct Vtk;
  std::unique_ptr<Vtk> vtk_;
  QImage image_;
  bool changed_ = true;
  int renderCount_ = 0;
  int wheel_ = 0;
  QPointF pressed_;
  bool grabbed_ = false;
};

} // namespace palp
