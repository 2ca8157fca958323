// What mouse and keys do with the curves.

#include "app/gui/views/CsvExport.h"
#include "app/gui/views/StripChart.h"
#include "app/gui/widgets/FileDialogs.h"
#include "app/gui/widgets/Png.h"
#include "io/AtomicFile.h"
#include "model/base/Error.h"

#include <QApplication>
#include <QBuffer>
#include <QClipboard>
#include <QContextMenuEvent>
#include <QFile>
#include <QKeyEvent>
#include <QMenu>
#include <QPageSize>
#include <QPainter>
#include <QPdfWriter>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>
#include <set>

namespace palp {

namespace {

constexpr double kWheelStep = 1.25;
constexpr double kNotch = 120;       // of a wheel
constexpr double kArrowShare = 0.1;  // of the window that an arrow key moves
constexpr double kShortest_s = 0.01; // that a zoom shows
constexpr double kLongest_s = 120;
constexpr double kCursorShare = 0.01; // of the plot that a key moves the cursor
constexpr double kDragFrom_px = 3;

} // namespace

void StripChart::hold() {
  if (held_) return;
  held_ = true;
  emit heldNow();
}

void StripChart::holdChart(StripSpec spec) {
  held_ = true;
  // The moment that one looks at stays; only what lies around it is added.
  spec.end_s = spec_.end_s;
  spec.window_s = spec_.window_s;
  spec.yRange = spec_.yRange;
  spec_ = std::move(spec);
  update();
}

void StripChart::release() {
  if (!std::exchange(held_, false)) return;
  emit released();
  update();
}

void StripChart::zoomTime(double factor, double about_px) {
  hold();
  const QRectF plot = plotRectangle();
  const double window_s = std::clamp(spec_.window_s * factor, kShortest_s, kLongest_s);
  const double share = std::clamp((plot.right() - about_px) / plot.width(), 0.0, 1.0);
  spec_.end_s += share * (window_s - spec_.window_s);
  spec_.window_s = window_s;
  update();
}

void StripChart::zoomValue(double factor, double about_px) {
  hold();
  const QRectF plot = plotRectangle();
  auto& [low, high] = spec_.yRange;
  const double about = low + (plot.bottom() - about_px) / plot.height() * (high - low);
  if (!((high - low) * factor > 1e-9) || (high - low) * factor > 1e9) return;
  low = about + (low - about) * factor;
  high = about + (high - about) * factor;
  update();
}

void StripChart::move(double byTime_s, double byValue) {
  hold();
  spec_.end_s += byTime_s;
  for (double& end : spec_.yRange) end += byValue;
  update();
}

void StripChart::wheelEvent(QWheelEvent* event) {
  const double factor = std::pow(kWheelStep, -event->angleDelta().y() / kNotch);
  if (event->modifiers().testFlag(Qt::ControlModifier))
    zoomValue(factor, event->position().y());
  else
    zoomTime(factor, event->position().x());
  event->accept();
}

void StripChart::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) drag_ = event->position();
}

void StripChart::mouseReleaseEvent(QMouseEvent*) {
  drag_.reset();
}

void StripChart::mouseDoubleClickEvent(QMouseEvent*) {
  drag_.reset();
  release();
}

void StripChart::mouseMoveEvent(QMouseEvent* event) {
  pointer_px_ = event->position().x();
  update();
  if (!drag_ || !event->buttons().testFlag(Qt::LeftButton)) return;
  const QPointF by = event->position() - *drag_;
  if (!held_ && by.manhattanLength() < kDragFrom_px) return;
  const QRectF plot = plotRectangle();
  if (plot.width() < 1 || plot.height() < 1) return;
  drag_ = event->position();
  move(-by.x() / plot.width() * spec_.window_s, by.y() / plot.height() * (spec_.yRange[1] - spec_.yRange[0]));
}

void StripChart::keyPressEvent(QKeyEvent* event) {
  const QPointF middle = plotRectangle().center();
  const double height = spec_.yRange[1] - spec_.yRange[0];
  const bool cursor = event->modifiers().testFlag(Qt::ControlModifier);
  if (cursor && (event->key() == Qt::Key_Left || event->key() == Qt::Key_Right))
    return moveCursor(event->key() == Qt::Key_Right ? 1 : -1);
  switch (event->key()) {
  case Qt::Key_Greater: // + and - with Shift, on keyboards of several countries
  case Qt::Key_Asterisk:
  case Qt::Key_PageUp:
    return zoomValue(1 / kWheelStep, middle.y());
  case Qt::Key_Less:
  case Qt::Key_Underscore:
  case Qt::Key_PageDown:
    return zoomValue(kWheelStep, middle.y());
  case Qt::Key_Left:
    return move(-kArrowShare * spec_.window_s, 0);
  case Qt::Key_Right:
    return move(kArrowShare * spec_.window_s, 0);
  case Qt::Key_Up:
    return move(0, kArrowShare * height);
  case Qt::Key_Down:
    return move(0, -kArrowShare * height);
  case Qt::Key_Plus:
    return zoomTime(1 / kWheelStep, middle.x());
  case Qt::Key_Minus:
    return zoomTime(kWheelStep, middle.x());
  case Qt::Key_Escape:
    if (held_) return release();
    break;
  default:
    break;
  }
  QWidget::keyPressEvent(event);
}

/// By keys; screen readers get the values there too.
void StripChart::moveCursor(int steps) {
  const QRectF plot = plotRectangle();
  if (pointer_px_ < plot.left() || pointer_px_ > plot.right()) pointer_px_ = plot.right();
  pointer_px_ = std::clamp(pointer_px_ + steps * kCursorShare * plot.width(), plot.left(), plot.right());
  setAccessibleDescription(reading());
  update();
}

/// Escape is the window's, which stops work, but where the curves are held: they come first.
bool StripChart::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride && held_ && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape)
    event->accept();
  return QWidget::event(event);
}

void StripChart::focusInEvent(QFocusEvent* event) {
  QWidget::focusInEvent(event);
  update();
}

void StripChart::focusOutEvent(QFocusEvent* event) {
  QWidget::focusOutEvent(event);
  update();
}

void StripChart::leaveEvent(QEvent*) {
  pointer_px_ = -1;
  update();
}

QString StripChart::asCsv() const {
  std::set<double> times;
  for (const StripSeries& series : spec_.series)
    for (const double t_s : series.t_s)
      if (t_s >= spec_.end_s - spec_.window_s && t_s <= spec_.end_s) times.insert(t_s);
  QString text = "t_s";
  for (const StripSeries& series : spec_.series) text += ",\"" + series.name + " " + spec_.yLabel + "\"";
  for (const StripSeries& series : spec_.series)
    if (!series.deviation.empty()) text += ",\"sd of " + series.name + " " + spec_.yLabel + "\"";
  text += spec_.doubts.empty() ? "\n" : ",doubted\n";
  std::vector<std::size_t> next(spec_.series.size(), 0);
  for (const double t_s : times) {
    QString values, deviations;
    for (std::size_t k = 0; k < spec_.series.size(); ++k) {
      const StripSeries& series = spec_.series[k];
      values += ',';
      if (!series.deviation.empty()) deviations += ',';
      // A break and the value after it have the same time: the value counts.
      for (; next[k] < series.t_s.size() && series.t_s[next[k]] <= t_s; ++next[k]) {
        if (series.t_s[next[k]] != t_s || !std::isfinite(series.y[next[k]])) continue;
        values += QString::number(series.y[next[k]], 'g', 10);
        if (!series.deviation.empty() && std::isfinite(series.deviation[next[k]]))
          deviations += QString::number(series.deviation[next[k]], 'g', 4);
      }
    }
    const QString doubted = spec_.doubts.empty() ? QString() : implausibleAt(t_s) != nullptr ? ",1" : ",0";
    text += QString::number(t_s - zero_s_, 'f', 6) + values + deviations + doubted + "\n";
  }
  return text;
}

void StripChart::write(const QString& file, const QByteArray& content, const QString& done) {
  try {
    writeFile(file.toStdString(), content.toStdString(), true); // confirmed in the dialog
    emit message(done);
  } catch (const Error& error) {
    emit message(QString::fromStdString(error.what()));
  }
}

void StripChart::saveCsv() {
  const QString table = asCsv(); // of the moment that was clicked on
  const QString file = askFileToSave(this, tr("Save values"), "curves.csv", tr("Tables (*.csv)"));
  if (file.isEmpty()) return;
  write(file, (sourceOf(*this) + table).toUtf8(),
        tr("Wrote the %2 visible times to %1.").arg(file).arg(table.count('\n') - 1));
}

void StripChart::savePdf() {
  const QString file = askFileToSave(this, tr("Save picture"), "curves.pdf", tr("Drawings (*.pdf)"));
  if (file.isEmpty()) return;
  QBuffer out;
  out.open(QIODevice::WriteOnly);
  {
    QPdfWriter writer(&out);
    writer.setPageSize(QPageSize(QSizeF(size()), QPageSize::Point));
    writer.setPageMargins({});
    QPainter painter(&writer);
    const double pixel = writer.logicalDpiX() / 72.0; // of the widget, a point of the page
    painter.scale(pixel, pixel);
    render(&painter); // by lines and letters: it draws itself with Qt's painter
  }
  write(file, out.data(), tr("Wrote the drawing to %1.").arg(file));
}

void StripChart::contextMenuEvent(QContextMenuEvent* event) {
  QMenu menu(this);
  const QAction* copy = menu.addAction(tr("Copy picture"));
  const QAction* save = menu.addAction(tr("Save picture..."));
  const QAction* pdf = menu.addAction(tr("Save picture as PDF..."));
  const QAction* values = menu.addAction(tr("Save values (CSV)..."));
  QAction* run = menu.addAction(tr("Resume"));
  run->setEnabled(held_);
  const QAction* chosen = menu.exec(event->globalPos());
  if (chosen == nullptr) return;
  if (chosen == run) return release();
  if (chosen == values) return saveCsv();
  if (chosen == pdf) return savePdf();
  const QPixmap picture = grab();
  if (chosen == copy) QApplication::clipboard()->setPixmap(picture);
  if (chosen != save) return;
  const QString file = askFileToSave(this, tr("Save picture"), "curves.png", tr("Pictures (*.png)"));
  if (file.isEmpty()) return;
  write(file, pngOf(picture), tr("Wrote the picture to %1.").arg(file));
}

} // namespace palp
