#include "app/gui/views/HeatmapView.h"

#include "app/gui/views/CsvExport.h"
#include "app/gui/views/TextScale.h"
#include "model/base/Text.h"

#include <QKeyEvent>
#include <QPainter>

#include <algorithm>

namespace palp {

namespace {

/// "row-wire 3", or of a label with a unit and words at the cells "y 16.33 mm".
QString placeWords(const std::string& label, const std::vector<std::string>& ticks, int cell) {
  const QString words = QString::fromStdString(label);
  const auto unit = words.indexOf(" [");
  const QString at = ticks.empty() ? QString::number(cell) : QString::fromStdString(ticks[std::size_t(cell)]);
  if (unit < 0) return words + " " + at;
  return words.left(unit) + " " + at + " " + words.mid(unit + 2).chopped(1);
}

} // namespace

HeatmapView::HeatmapView(QWidget* parent) : PictureView(parent) {
  connect(this, &PictureView::hovered, this, [this](const QPointF& place) { point(cellAt(place)); });
  connect(this, &PictureView::clicked, this, [this](const QPointF& place) {
    if (const auto cell = cellAt(place)) {
      walked_ = cell;
      emit cellClicked((*cell)[0], (*cell)[1]);
    }
  });
}

void HeatmapView::point(const std::optional<std::array<int, 2>>& cell) {
  if (cell) {
    const HeatmapSpec& spec = heatmap();
    const QString value = QString::number(spec.values((*cell)[0], (*cell)[1]), 'g', 6);
    const QString more = cellWords_ ? cellWords_(*cell) : QString();
    setToolTip(QString("%1, %2: %3 = %4 %5")
                   .arg(placeWords(spec.rowLabel, spec.rowTicks, (*cell)[0]),
                        placeWords(spec.columnLabel, spec.columnTicks, (*cell)[1]))
                   .arg(QString::fromStdString(spec.colors.quantity), value, QString::fromStdString(spec.colors.unit)) +
               (more.isEmpty() ? QString() : "\n" + more));
  } else {
    setToolTip({});
  }
  emit cellHovered(cell);
}

void HeatmapView::walk(int rows, int columns) {
  const HeatmapSpec& spec = heatmap();
  if (spec.values.size() == 0) return;
  const auto last = [](Eigen::Index count) { return static_cast<int>(count) - 1; };
  std::array<int, 2> cell = walked_.value_or(spec.selected.value_or(std::array{0, 0}));
  cell[0] = std::clamp(cell[0] + rows, 0, last(spec.values.rows()));
  cell[1] = std::clamp(cell[1] + columns, 0, last(spec.values.cols()));
  walked_ = cell;
  point(cell);
  setAccessibleDescription(toolTip());
  update();
}

void HeatmapView::keyPressEvent(QKeyEvent* event) {
  switch (event->key()) {
  case Qt::Key_Left:
    return walk(0, -1);
  case Qt::Key_Right:
    return walk(0, 1);
  case Qt::Key_Up:
    return walk(1, 0);
  case Qt::Key_Down:
    return walk(-1, 0);
  case Qt::Key_Space:
  case Qt::Key_Return:
  case Qt::Key_Enter:
    walk(0, 0);
    if (walked_) emit cellClicked((*walked_)[0], (*walked_)[1]);
    return;
  default:
    PictureView::keyPressEvent(event);
  }
}

void HeatmapView::paintEvent(QPaintEvent* event) {
  PictureView::paintEvent(event);
  const HeatmapSpec& spec = heatmap();
  if (!hasFocus() || !walked_ || (*walked_)[0] >= spec.values.rows() || (*walked_)[1] >= spec.values.cols()) return;
  const auto box = heatmap_.cellBox(*walked_);
  if (!box) return;
  const double ratio = devicePixelRatioF();
  const QRectF cell((*box)[0] / ratio, height() - ((*box)[1] + (*box)[3]) / ratio, (*box)[2] / ratio,
                    (*box)[3] / ratio);
  QPainter painter(this);
  painter.setPen(QPen(palette().color(QPalette::Base), 4));
  painter.drawRect(cell);
  painter.setPen(QPen(palette().color(QPalette::WindowText), 2, Qt::DotLine));
  painter.drawRect(cell);
}

void HeatmapView::changeEvent(QEvent* event) {
  PictureView::changeEvent(event);
  if (event->type() == QEvent::FontChange) invalidate();
}

void HeatmapView::setHeatmap(HeatmapSpec spec) {
  heatmap_.spec = std::move(spec);
  invalidate();
}

void HeatmapView::setTheme(Theme theme) {
  heatmap_.theme = theme;
  invalidate();
}

void HeatmapView::render(QImage& image) {
  heatmap_.scale = devicePixelRatioF() * textScale(*this);
  heatmap_.paint(image.bits(), static_cast<std::size_t>(image.bytesPerLine()), image.width(), image.height());
}

Picture HeatmapView::renderPicture(int width, int height) {
  Heatmap larger = heatmap_;
  larger.scale = devicePixelRatioF() * textScale(*this) * magnification(width, height);
  return larger.picture(width, height);
}

std::string HeatmapView::svg() const {
  const QSize shown = size().expandedTo({600, 400}); // a tab that was never seen has no size yet
  Heatmap drawn = heatmap_;
  drawn.scale = textScale(*this);
  return drawn.svg(shown.width(), shown.height());
}

std::optional<std::array<int, 2>> HeatmapView::cellAt(const QPointF& place) const {
  if (place.x() < 0) return {};
  const QPointF device = devicePlace(place);
  return heatmap_.cellAt(device.x(), device.y());
}

/// One cell a line, named as on the axes.
QString HeatmapView::table() const {
  const HeatmapSpec& spec = heatmap_.spec;
  if (spec.values.size() == 0) return {};
  QString csv = csvCell(QString::fromStdString(spec.rowLabel)) + "," +
                csvCell(QString::fromStdString(spec.columnLabel)) + "," + csvCell(QString::fromStdString(spec.title)) +
                "\n";
  for (Eigen::Index row = 0; row < spec.values.rows(); ++row)
    for (Eigen::Index column = 0; column < spec.values.cols(); ++column)
      csv += QString("%1,%2,").arg(row).arg(column) + QString::fromStdString(text(spec.values(row, column))) + "\n";
  return csv;
}

} // namespace palp
