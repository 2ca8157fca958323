#include "app/gui/views/VtkView.h"

#include "app/gui/jobs/ReturnMemory.h"
#include "app/gui/views/UprightCamera.h"
#include "app/scenes/gl/OffscreenWindow.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkGenericRenderWindowInteractor.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <cmath>

namespace palp {

namespace {

constexpr int kWheelNotch = 120;       ///< eighths of a degree
constexpr double kKeyDragShare = 0.04; ///< of the view, that a key drags

void invalidateView(vtkObject*, unsigned long, void* view, void*) {
  static_cast<VtkView*>(view)->invalidate();
}

unsigned long pressEvent(Qt::MouseButton button) {
  if (button == Qt::LeftButton) return vtkCommand::LeftButtonPressEvent;
  return button == Qt::RightButton ? vtkCommand::RightButtonPressEvent : vtkCommand::MiddleButtonPressEvent;
}

unsigned long releaseEvent(Qt::MouseButton button) {
  if (button == Qt::LeftButton) return vtkCommand::LeftButtonReleaseEvent;
  return button == Qt::RightButton ? vtkCommand::RightButtonReleaseEvent : vtkCommand::MiddleButtonReleaseEvent;
}

} // namespace

/// The window is opened when the view is first drawn: a context costs 30 MB on a software renderer, and a view that
/// nobody looks at needs none.
struct VtkView::Vtk {
  vtkSmartPointer<vtkRenderer> renderer;
  vtkSmartPointer<vtkInteractorObserver> style;
  vtkNew<vtkCallbackCommand> changed;
  std::unique_ptr<OffscreenWindow> window; ///< null before the first drawing, and after giveBack()
  vtkNew<vtkGenericRenderWindowInteractor> interactor;
  bool rendered = false; ///< into this window
  int parts = 0;         ///< of a first drawing, that were drawn into it

  void open(const QSize& size) {
    if (window) return;
    window = std::make_unique<OffscreenWindow>();
    window->vtk()->AddRenderer(renderer);
    interactor->SetRenderWindow(window->vtk());
    // The interactor asks for a rendering after each event; the view renders once a paint instead.
    interactor->EnableRenderOff();
    interactor->Initialize();
    interactor->SetInteractorStyle(style);
    interactor->AddObserver(vtkCommand::RenderEvent, changed);
    interactor->UpdateSize(size.width(), size.height());
  }
  /// The style stays with its interactor: a chart's asks it for a timer whenever the chart changes.
  void close() {
    if (!window) return;
    interactor->RemoveObserver(changed);
    interactor->SetRenderWindow(nullptr);
    window->vtk()->MakeCurrent(); // what it drew with is of its context
    window->vtk()->RemoveRenderer(renderer);
    window.reset();
    rendered = false;
    parts = 0;
  }
  /// Hands an event on; before the first drawing there is nothing that it could change.
  void invoke(unsigned long event) {
    if (window) interactor->InvokeEvent(event);
  }
};

VtkView::VtkView(vtkRenderer* renderer, vtkInteractorObserver* style, QWidget* parent)
    : PictureView(parent), vtk_(std::make_unique<Vtk>()), hasCamera_(style == nullptr) {
  vtk_->renderer = renderer;
  vtk_->style = style;
  if (style == nullptr) vtk_->style = vtkSmartPointer<UprightCamera>::New();
  vtk_->changed->SetCallback(invalidateView);
  vtk_->changed->SetClientData(this);
}

VtkView::~VtkView() {
  vtk_->interactor->SetInteractorStyle(nullptr);
  vtk_->close();
}

void VtkView::giveBack() {
  if (isVisible() && !standsStill()) return;
  vtk_->close();
  if (!isVisible()) forget();
}

void releaseViews(const QWidget& window) {
  for (VtkView* view : window.findChildren<VtkView*>()) view->giveBack();
  returnMemory();
}

bool VtkView::drawn() const {
  return vtk_->window != nullptr;
}

bool VtkView::prepared() {
  if (vtk_->rendered) return true;
  if (vtk_->window) return !drawPart(vtk_->parts++);
  vtk_->open(deviceSize());
  return false;
}

void VtkView::renderUnseen(const QSize& size) {
  vtk_->open(size);
  vtk_->window->setSize(size.width(), size.height());
  vtk_->window->render();
}

void VtkView::render(QImage& image) {
  renderUnseen(image.size());
  vtk_->rendered = true;
  vtk_->window->copyBgra(image.bits(), static_cast<std::size_t>(image.bytesPerLine()));
}

Picture VtkView::renderPicture(int width, int height) {
  renderUnseen({width, height});
  Picture picture = vtk_->window->picture();
  invalidate(); // the window has another size now
  return picture;
}

void VtkView::resizeEvent(QResizeEvent* event) {
  if (vtk_->window) vtk_->interactor->UpdateSize(deviceSize().width(), deviceSize().height());
  PictureView::resizeEvent(event);
}

void VtkView::passPlace(const QPointF& place, Qt::KeyboardModifiers modifiers) {
  const QPointF device = devicePlace(place);
  vtk_->interactor->SetEventInformation(
      static_cast<int>(std::lround(device.x())), static_cast<int>(std::lround(device.y())),
      modifiers.testFlag(Qt::ControlModifier) ? 1 : 0, modifiers.testFlag(Qt::ShiftModifier) ? 1 : 0);
}

/// The mouse acts on what is drawn, which a picture alone is not.
void VtkView::drawFirst() {
  if (vtk_->rendered) return;
  invalidate();
  (void)image();
}

bool VtkView::grab(const QPointF&, Qt::KeyboardModifiers) {
  return false;
}

void VtkView::dragTo(const QPointF&, Qt::KeyboardModifiers) {}

void VtkView::drop() {}

void VtkView::mousePressEvent(QMouseEvent* event) {
  PictureView::mousePressEvent(event);
  drawFirst();
  grabbed_ = event->button() == Qt::LeftButton && grab(event->position(), event->modifiers());
  if (grabbed_) return;
  passPlace(event->position(), event->modifiers());
  vtk_->invoke(pressEvent(event->button()));
}

void VtkView::mouseReleaseEvent(QMouseEvent* event) {
  if (grabbed_ && event->button() == Qt::LeftButton) {
    grabbed_ = false;
    drop();
    return;
  }
  passPlace(event->position(), event->modifiers());
  vtk_->invoke(releaseEvent(event->button()));
  PictureView::mouseReleaseEvent(event);
}

void VtkView::mouseMoveEvent(QMouseEvent* event) {
  if (grabbed_) {
    dragTo(event->position(), event->modifiers());
    return;
  }
  passPlace(event->position(), event->modifiers());
  vtk_->invoke(vtkCommand::MouseMoveEvent);
  PictureView::mouseMoveEvent(event);
}

void VtkView::wheelEvent(QWheelEvent* event) {
  drawFirst();
  passPlace(event->position(), event->modifiers());
  wheel_ += event->angleDelta().y();
  for (; wheel_ >= kWheelNotch; wheel_ -= kWheelNotch) vtk_->invoke(vtkCommand::MouseWheelForwardEvent);
  for (; wheel_ <= -kWheelNotch; wheel_ += kWheelNotch) vtk_->invoke(vtkCommand::MouseWheelBackwardEvent);
  event->accept();
}

void VtkView::dragCamera(const QPointF& way, bool moving) {
  const Qt::KeyboardModifiers modifiers = moving ? Qt::ShiftModifier : Qt::NoModifier;
  const QPointF middle = QRectF(rect()).center();
  passPlace(middle, modifiers);
  vtk_->invoke(vtkCommand::LeftButtonPressEvent);
  passPlace(middle + way, modifiers);
  vtk_->invoke(vtkCommand::MouseMoveEvent);
  vtk_->invoke(vtkCommand::LeftButtonReleaseEvent);
}

void VtkView::keyPressEvent(QKeyEvent* event) {
  const bool shift = event->modifiers().testFlag(Qt::ShiftModifier);
  const auto drag = [&](double x, double y) {
    dragCamera({kKeyDragShare * width() * x, kKeyDragShare * height() * y}, shift);
  };
  const bool plain = hasCamera_ && !(event->modifiers() & (Qt::ControlModifier | Qt::AltModifier));
  switch (plain ? event->key() : 0) {
  case Qt::Key_Left:
    return drag(-1, 0);
  case Qt::Key_Right:
    return drag(1, 0);
  case Qt::Key_Up:
    return drag(0, -1);
  case Qt::Key_Down:
    return drag(0, 1);
  case Qt::Key_Plus:
  case Qt::Key_Equal:
    return vtk_->invoke(vtkCommand::MouseWheelForwardEvent);
  case Qt::Key_Minus:
    return vtk_->invoke(vtkCommand::MouseWheelBackwardEvent);
  case Qt::Key_Home:
    emit doubleClicked();
    return;
  default:
    QWidget::keyPressEvent(event);
  }
}

void VtkView::leaveEvent(QEvent* event) {
  vtk_->invoke(vtkCommand::LeaveEvent);
  PictureView::leaveEvent(event);
}

} // namespace palp
