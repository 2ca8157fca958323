#include "app/gui/VtkView.h"

#include "app/scenes/OffscreenWindow.h"
#include "model/Error.h"

#include <QApplication>
#include <QClipboard>
#include <QFileDialog>
#include <QInputDialog>
#include <QMenu>
#include <QMessageBox>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkGenericRenderWindowInteractor.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <cmath>

namespace palp {

namespace {

constexpr int kWheelStep = 120; ///< eighths of a degree
constexpr double kClick_px = 4; ///< farther than this, pressing and releasing is a drag

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
  std::unique_ptr<OffscreenWindow> window; ///< null before the first drawing
  vtkNew<vtkGenericRenderWindowInteractor> interactor;

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
  /// Hands an event on; before the first drawing there is nothing that it could change.
  void invoke(unsigned long event) {
    if (window) interactor->InvokeEvent(event);
  }
};

VtkView::VtkView(vtkRenderer* renderer, vtkInteractorObserver* style, QWidget* parent)
    : QWidget(parent), vtk_(std::make_unique<Vtk>()) {
  setAttribute(Qt::WA_OpaquePaintEvent);
  setMouseTracking(true);
  setMinimumSize(160, 120);
  vtk_->renderer = renderer;
  vtk_->style = style;
  if (style == nullptr) vtk_->style = vtkSmartPointer<vtkInteractorStyleTrackballCamera>::New();
  vtk_->changed->SetCallback(invalidateView);
  vtk_->changed->SetClientData(this);
}

VtkView::~VtkView() {
  if (!vtk_->window) return;
  vtk_->interactor->SetInteractorStyle(nullptr);
  vtk_->interactor->SetRenderWindow(nullptr);
  vtk_->window->vtk()->RemoveRenderer(vtk_->renderer);
}

void VtkView::invalidate() {
  changed_ = true;
  update();
}

const QImage& VtkView::image() {
  if (changed_) draw();
  return image_;
}

double VtkView::aspect() const {
  return height() > 0 ? static_cast<double>(width()) / height() : 1;
}

QPointF VtkView::devicePlace(const QPointF& place) const {
  return {place.x() * devicePixelRatioF(), (height() - 1 - place.y()) * devicePixelRatioF()};
}

void VtkView::draw() {
  changed_ = false;
  const QSize size = (QSizeF(this->size()) * devicePixelRatioF()).toSize().expandedTo({1, 1});
  vtk_->open(size);
  vtk_->window->setSize(size.width(), size.height());
  vtk_->window->render();
  ++renderCount_;
  if (image_.size() != size) image_ = QImage(size, QImage::Format_RGB32);
  vtk_->window->copyBgra(image_.bits(), static_cast<std::size_t>(image_.bytesPerLine()));
  image_.setDevicePixelRatio(devicePixelRatioF());
}

void VtkView::paintEvent(QPaintEvent*) {
  if (changed_) draw();
  QPainter painter(this);
  painter.setCompositionMode(QPainter::CompositionMode_Source);
  painter.drawImage(0, 0, image_);
}

void VtkView::resizeEvent(QResizeEvent*) {
  const QSize size = (QSizeF(this->size()) * devicePixelRatioF()).toSize().expandedTo({1, 1});
  if (vtk_->window) vtk_->interactor->UpdateSize(size.width(), size.height());
  changed_ = true;
  emit sizeChanged();
}

void VtkView::tellPlace(const QPointF& place, Qt::KeyboardModifiers modifiers) {
  const QPointF device = devicePlace(place);
  vtk_->interactor->SetEventInformation(
      static_cast<int>(std::lround(device.x())), static_cast<int>(std::lround(device.y())),
      modifiers.testFlag(Qt::ControlModifier) ? 1 : 0, modifiers.testFlag(Qt::ShiftModifier) ? 1 : 0);
}

bool VtkView::grab(const QPointF&) {
  return false;
}

void VtkView::dragTo(const QPointF&, Qt::KeyboardModifiers) {}

void VtkView::drop() {}

void VtkView::mousePressEvent(QMouseEvent* event) {
  pressed_ = event->position();
  grabbed_ = event->button() == Qt::LeftButton && grab(event->position());
  if (grabbed_) return;
  tellPlace(event->position(), event->modifiers());
  vtk_->invoke(pressEvent(event->button()));
}

void VtkView::mouseReleaseEvent(QMouseEvent* event) {
  if (grabbed_ && event->button() == Qt::LeftButton) {
    grabbed_ = false;
    drop();
    return;
  }
  tellPlace(event->position(), event->modifiers());
  vtk_->invoke(releaseEvent(event->button()));
  const QPointF way = event->position() - pressed_;
  if (event->button() == Qt::LeftButton && std::hypot(way.x(), way.y()) <= kClick_px) emit clicked(event->position());
  if (event->button() == Qt::RightButton && std::hypot(way.x(), way.y()) <= kClick_px)
    offerPicture(event->globalPosition().toPoint());
}

Picture VtkView::picture(int width, int height) {
  vtk_->open({width, height});
  vtk_->window->setSize(width, height);
  vtk_->window->render();
  Picture picture = vtk_->window->picture();
  invalidate(); // the window has another size now
  return picture;
}

void VtkView::offerPicture(const QPoint& globalPlace) {
  QMenu menu(this);
  const QAction* copy = menu.addAction(tr("Copy picture"));
  const QSize now = image().size();
  QList<QPair<QAction*, QSize>> sizes;
  for (const int factor : {1, 2, 4}) {
    const QSize size = now * factor;
    sizes << qMakePair(menu.addAction(tr("Save picture, %1 x %2 pixels...").arg(size.width()).arg(size.height())),
                       size);
  }
  const QAction* other = menu.addAction(tr("Save picture in another size..."));
  const QAction* chosen = menu.exec(globalPlace);
  if (chosen == other && chosen != nullptr) {
    const QSize size = askSize(now);
    if (!size.isEmpty()) savePicture(size);
    return;
  }
  if (chosen == copy && chosen != nullptr) QApplication::clipboard()->setImage(image());
  for (const auto& [action, size] : sizes) {
    if (action != chosen || chosen == nullptr) continue;
    savePicture(size);
  }
}

QSize VtkView::askSize(const QSize& now) {
  const QString proposal = QString("%1 x %2").arg(now.width()).arg(now.height());
  const QString words = QInputDialog::getText(this, tr("Save picture"), tr("Width x height in pixels, up to 16384:"),
                                              QLineEdit::Normal, proposal);
  const QStringList parts = words.split('x');
  if (words.isEmpty()) return {};
  const QSize size = parts.size() == 2 ? QSize(parts[0].trimmed().toInt(), parts[1].trimmed().toInt()) : QSize();
  if (size.width() >= 1 && size.height() >= 1 && size.width() <= 16384 && size.height() <= 16384) return size;
  QMessageBox::warning(this, tr("Save picture"),
                       tr("\"%1\" is no size; write two numbers from 1 to 16384, as 1600 x 900.").arg(words));
  return {};
}

void VtkView::savePicture(const QSize& size) {
  const QString file = QFileDialog::getSaveFileName(this, tr("Save picture"), "picture.png", tr("Pictures (*.png)"));
  if (file.isEmpty()) return;
  try {
    writePng(picture(size.width(), size.height()), file.toStdString());
  } catch (const Error& error) {
    QMessageBox::warning(this, tr("Save picture"), QString::fromStdString(error.what()));
  }
}

void VtkView::mouseMoveEvent(QMouseEvent* event) {
  if (grabbed_) {
    dragTo(event->position(), event->modifiers());
    return;
  }
  tellPlace(event->position(), event->modifiers());
  vtk_->invoke(vtkCommand::MouseMoveEvent);
  if (event->buttons() == Qt::NoButton) emit hovered(event->position());
}

void VtkView::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) emit doubleClicked();
}

void VtkView::wheelEvent(QWheelEvent* event) {
  tellPlace(event->position(), event->modifiers());
  wheel_ += event->angleDelta().y();
  for (; wheel_ >= kWheelStep; wheel_ -= kWheelStep) vtk_->invoke(vtkCommand::MouseWheelForwardEvent);
  for (; wheel_ <= -kWheelStep; wheel_ += kWheelStep) vtk_->invoke(vtkCommand::MouseWheelBackwardEvent);
  event->accept();
}

void VtkView::leaveEvent(QEvent*) {
  vtk_->invoke(vtkCommand::LeaveEvent);
  emit hovered(QPointF(-1, -1));
}

} // namespace palp
