#include "app/gui/views/PictureView.h"

#include "app/gui/views/CsvExport.h"
#include "app/gui/widgets/FileDialogs.h"
#include "io/AtomicFile.h"
#include "model/base/Error.h"

#include <QAbstractEventDispatcher>
#include <QApplication>
#include <QClipboard>
#include <QElapsedTimer>
#include <QInputDialog>
#include <QMenu>
#include <QMessageBox>
#include <QMouseEvent>
#include <QPainter>
#include <QTimer>

#include <algorithm>
#include <cmath>
#include <utility>

namespace palp {

namespace {

constexpr double kClick_px = 4; ///< farther than this, pressing and releasing is a drag

/// One pass of the event loop takes about this time; pictures that would make it longer wait for the next, as a change
/// may concern eight of them, of 8 to 30 ms each on a software renderer, and has panels to fill before.
constexpr qint64 kPass_ms = 20;
qint64 drawnInPass_ms = 0; ///< of the window's thread alone

/// Since when the event loop is awake.
const QElapsedTimer& awakeClock() {
  static QElapsedTimer clock;
  if (!clock.isValid()) {
    clock.start();
    QObject::connect(QAbstractEventDispatcher::instance(), &QAbstractEventDispatcher::awake, qApp,
                     [] { clock.start(); });
  }
  return clock;
}

} // namespace

PictureView::PictureView(QWidget* parent) : QWidget(parent) {
  setAttribute(Qt::WA_OpaquePaintEvent);
  setMouseTracking(true);
  setMinimumSize(160, 120);
  setFocusPolicy(Qt::StrongFocus);
}

void PictureView::invalidate() {
  changed_ = true;
  update();
}

void PictureView::forget() {
  image_ = {};
  changed_ = true;
}

const QImage& PictureView::image() {
  if (changed_) draw();
  return image_;
}

double PictureView::aspect() const {
  return height() > 0 ? static_cast<double>(width()) / height() : 1;
}

QPointF PictureView::devicePlace(const QPointF& place) const {
  return {place.x() * devicePixelRatioF(), (height() - 1 - place.y()) * devicePixelRatioF()};
}

QSize PictureView::deviceSize() const {
  return (QSizeF(size()) * devicePixelRatioF()).toSize().expandedTo({1, 1});
}

double PictureView::magnification(int width, int height) const {
  const QSize own = deviceSize();
  return std::min(static_cast<double>(width) / own.width(), static_cast<double>(height) / own.height());
}

void PictureView::draw() {
  changed_ = false;
  if (image_.size() != deviceSize()) image_ = QImage(deviceSize(), QImage::Format_RGB32);
  QElapsedTimer clock;
  clock.start();
  render(image_);
  lastDraw_ms_ = clock.elapsed() + 1;
  waited_ = false;
  count(lastDraw_ms_);
  ++renderCount_;
  image_.setDevicePixelRatio(devicePixelRatioF());
}

void PictureView::count(qint64 time_ms) {
  if (std::exchange(drawnInPass_ms, drawnInPass_ms + time_ms) == 0)
    QTimer::singleShot(0, qApp, [] { drawnInPass_ms = 0; });
}

bool PictureView::waits() {
  const qint64 own_ms = std::max(lastDraw_ms_, kPass_ms / 2); // an empty first picture does not predict the next
  if (drawnInPass_ms > 0) return drawnInPass_ms + own_ms > kPass_ms;
  // Panels were filled in this pass; a loop that somebody turns by hand does not say when it wakes: once is enough.
  return awakeClock().elapsed() + own_ms > kPass_ms && !std::exchange(waited_, true);
}

bool PictureView::drawsNow() {
  if (waits()) return false;
  QElapsedTimer clock;
  clock.start();
  if (prepared()) return true;
  count(clock.elapsed() + 1);
  return false;
}

void PictureView::paintEvent(QPaintEvent*) {
  if (changed_ && drawsNow())
    draw();
  else if (changed_)
    QTimer::singleShot(0, this, qOverload<>(&QWidget::update));
  QPainter painter(this);
  painter.setCompositionMode(QPainter::CompositionMode_Source);
  if (image_.isNull()) painter.fillRect(rect(), palette().window());
  painter.drawImage(rect(), image_); // one that waits may have another size
  if (!hasFocus()) return;
  painter.setCompositionMode(QPainter::CompositionMode_SourceOver);
  painter.setPen(QPen(palette().color(QPalette::Highlight), 2));
  painter.drawRect(rect().adjusted(1, 1, -1, -1));
}

QPixmap windowPicture(QWidget& window) {
  for (PictureView* view : window.findChildren<PictureView*>())
    if (view->isVisible()) static_cast<void>(view->image());
  return window.grab();
}

void PictureView::focusInEvent(QFocusEvent*) {
  update();
}

void PictureView::focusOutEvent(QFocusEvent*) {
  update();
}

void PictureView::resizeEvent(QResizeEvent*) {
  changed_ = true;
  emit sizeChanged();
}

void PictureView::mousePressEvent(QMouseEvent* event) {
  pressed_ = event->position();
}

void PictureView::mouseReleaseEvent(QMouseEvent* event) {
  const QPointF way = event->position() - pressed_;
  if (std::hypot(way.x(), way.y()) > kClick_px) return;
  if (event->button() == Qt::LeftButton) emit clicked(event->position());
  if (event->button() == Qt::RightButton) offerPicture(event->globalPosition().toPoint());
}

void PictureView::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() == Qt::NoButton) emit hovered(event->position());
}

void PictureView::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) emit doubleClicked();
}

void PictureView::leaveEvent(QEvent*) {
  emit hovered(QPointF(-1, -1));
}

void PictureView::contextMenuEvent(QContextMenuEvent* event) {
  // By the mouse it opens at the release, where the button was not dragged.
  if (event->reason() == QContextMenuEvent::Keyboard) offerPicture(mapToGlobal(rect().center()));
}

void PictureView::offerPicture(const QPoint& globalPlace) {
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
  const QAction* lines = hasSvg() ? menu.addAction(tr("Save as SVG...")) : nullptr;
  const QString numbers = table();
  const QAction* copyTable = numbers.isEmpty() ? nullptr : menu.addAction(tr("Copy points"));
  const QAction* saveTable = numbers.isEmpty() ? nullptr : menu.addAction(tr("Save points as CSV..."));
  const QAction* chosen = menu.exec(globalPlace);
  if (chosen == other && chosen != nullptr) {
    const QSize size = askSize(now);
    if (!size.isEmpty()) savePicture(size);
    return;
  }
  if (chosen != nullptr && chosen == lines) saveSvg();
  if (chosen != nullptr && chosen == copyTable) QApplication::clipboard()->setText(numbers);
  if (chosen != nullptr && chosen == saveTable) {
    const QString written = offerCsv(this, fileName("points") + ".csv", numbers);
    if (!written.isEmpty()) emit message(tr("Wrote %1.").arg(written));
  }
  if (chosen == copy && chosen != nullptr) QApplication::clipboard()->setImage(image());
  for (const auto& [action, size] : sizes) {
    if (action != chosen || chosen == nullptr) continue;
    savePicture(size);
  }
}

void PictureView::saveSvg() {
  const QString file = askFileToSave(this, tr("Save as SVG"), fileName("chart") + ".svg", tr("Drawings (*.svg)"));
  if (file.isEmpty()) return;
  try {
    writeFile(file.toStdString(), svg(), true); // confirmed in the dialog
    emit message(tr("Wrote %1.").arg(file));
  } catch (const Error& error) {
    QMessageBox::warning(this, tr("Save as SVG"), QString::fromStdString(error.what()));
  }
}

QString PictureView::fileName(const QString& otherwise) const {
  return objectName().isEmpty() ? otherwise : objectName();
}

QSize PictureView::askSize(const QSize& now) {
  const QString proposal = QString("%1 x %2").arg(now.width()).arg(now.height());
  const QString words = QInputDialog::getText(this, tr("Save picture"), tr("Width x height in pixels, up to 16384:"),
                                              QLineEdit::Normal, proposal);
  const QStringList parts = words.split('x');
  if (words.isEmpty()) return {};
  const QSize size = parts.size() == 2 ? QSize(parts[0].trimmed().toInt(), parts[1].trimmed().toInt()) : QSize();
  if (size.width() >= 1 && size.height() >= 1 && size.width() <= 16384 && size.height() <= 16384) return size;
  QMessageBox::warning(
      this, tr("Save picture"),
      tr("\"%1\" is not a size; enter two numbers from 1 to 16384, for example 1600 x 900.").arg(words));
  return {};
}

void PictureView::savePicture() {
  savePicture(2 * image().size());
}

void PictureView::savePicture(const QSize& size) {
  const QString file = askFileToSave(this, tr("Save picture"), fileName("picture") + ".png", tr("Pictures (*.png)"));
  if (file.isEmpty()) return;
  try {
    writePng(picture(size.width(), size.height()), file.toStdString());
    emit message(tr("Wrote %1.").arg(file));
  } catch (const Error& error) {
    QMessageBox::warning(this, tr("Save picture"), QString::fromStdString(error.what()));
  }
}

} // namespace palp
