#include "app/gui/views/StripChart.h"

#include "app/scenes/ColorScale.h"

#include <QPainter>

#include <algorithm>
#include <cmath>
#include <limits>

namespace palp {

namespace {

constexpr double kLegendLine_px = 32; // of a legend's entry without its name
constexpr double kMarkGap_px = 3;     // between a mark's line and its words
constexpr double kSwatch_px = 18;     // of a curve's colour and the gap after it, in the reading
constexpr double kReadingGap_px = 6;  // around what is read
constexpr double kHatch = 0.25;       // opacity of the ground where values are doubted
constexpr double kOwnColor = 0.25;    // share of a curve's colour that it keeps there
constexpr int kGrey = 150;            // the rest
constexpr double kBeyond = 10;        // heights of the plot by which a curve leaves it at most

/// Ticks of the value's axis, so few that no number covers the next.
std::vector<double> valueTicks(const std::array<double, 2>& range, double height_px, double line_px) {
  std::vector<double> ticks = roundTicks(range[0], range[1], 6);
  for (int most = 5; most > 1 && static_cast<double>(ticks.size()) * line_px > height_px + line_px; --most)
    ticks = roundTicks(range[0], range[1], most);
  return ticks;
}

QColor ink(const Color& color) {
  return QColor::fromRgbF(static_cast<float>(color[0]), static_cast<float>(color[1]), static_cast<float>(color[2]));
}

/// Of a curve that can hardly be true: little is left of its own colour.
QColor greyed(const QColor& color) {
  const auto mixed = [](int part) { return static_cast<int>(kOwnColor * part + (1 - kOwnColor) * kGrey); };
  return {mixed(color.red()), mixed(color.green()), mixed(color.blue())};
}

} // namespace

StripChart::StripChart(QWidget* parent) : QWidget(parent) {
  setAttribute(Qt::WA_OpaquePaintEvent);
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setToolTip(tr("Wheel: zoom in time, with Ctrl in value; drag: move; double click or Esc: resume. Keys: + and - zoom, "
                "with Shift in value; arrows move; Ctrl with left or right moves the cursor"));
  setMinimumSize(180, 110);
}

void StripChart::setChart(StripSpec spec) {
  if (held_) return;
  spec_ = std::move(spec);
  zero_s_ = spec_.zero_s.value_or(spec_.end_s);
  update();
}

void StripChart::setTheme(Theme theme) {
  theme_ = theme;
  update();
}

QRectF StripChart::plotRectangle() const {
  const QFontMetricsF metrics(font());
  double widest = 0;
  for (const std::string& text : tickTexts(roundTicks(spec_.yRange[0], spec_.yRange[1], 6)))
    widest = std::max(widest, metrics.horizontalAdvance(QString::fromStdString(text)));
  const double line = metrics.height();
  QRectF plot = QRectF(rect()).adjusted(widest + line + 14, line + 14, -12, -2 * line - 10);
  plot.setTop(plot.top() + (linesAbove(plot.width()) - 1) * line);
  return plot;
}

double StripChart::xOf(const QRectF& plot, double t_s) const {
  return plot.right() - (spec_.end_s - t_s) / spec_.window_s * plot.width();
}

double StripChart::yOf(const QRectF& plot, double y) const {
  return plot.bottom() - (y - spec_.yRange[0]) / (spec_.yRange[1] - spec_.yRange[0]) * plot.height();
}

void StripChart::paintEvent(QPaintEvent*) {
  ++paintCount_;
  QPainter painter(this);
  painter.fillRect(rect(), ink(palp::palette(theme_).ground));
  const QRectF plot = plotRectangle();
  if (plot.width() < 10 || plot.height() < 10) return;
  paintAxes(painter, plot);
  const bool empty = std::all_of(spec_.series.begin(), spec_.series.end(),
                                 [](const StripSeries& series) { return series.t_s.empty(); });
  if (empty) {
    const QRectF place = painter.boundingRect(plot, Qt::AlignCenter | Qt::TextWordWrap, spec_.empty);
    painter.fillRect(place, ink(palp::palette(theme_).ground));
    painter.setPen(QWidget::palette().color(QPalette::PlaceholderText));
    painter.drawText(plot, Qt::AlignCenter | Qt::TextWordWrap, spec_.empty);
    return;
  }
  paintCurves(painter, plot);
  paintLegend(painter, plot);
  paintReading(painter, plot);
  if (!hasFocus()) return;
  painter.setPen(QPen(QWidget::palette().color(QPalette::Highlight), 2));
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(rect().adjusted(1, 1, -1, -1));
}

void StripChart::paintAxes(QPainter& painter, const QRectF& plot) const {
  const QColor text = ink(palp::palette(theme_).text);
  const QColor grid = ink(palp::palette(theme_).grid);
  const double line = QFontMetricsF(font()).height();
  QFont bold = font();
  bold.setBold(true);
  painter.setFont(bold);
  painter.setPen(text);
  painter.drawText(QRectF(plot.left(), 5, plot.width(), line + 2), Qt::AlignLeft | Qt::AlignVCenter,
                   QFontMetricsF(bold).elidedText(spec_.title, Qt::ElideRight, plot.width()));
  painter.setFont(font());
  const std::vector<double> yTicks = valueTicks(spec_.yRange, plot.height(), line);
  const std::vector<std::string> yTexts = tickTexts(yTicks);
  for (std::size_t k = 0; k < yTicks.size(); ++k) {
    const double y = std::round(yOf(plot, yTicks[k])) + 0.5;
    painter.setPen(QPen(yTicks[k] == 0 ? text : grid, 1));
    painter.drawLine(QPointF(plot.left(), y), QPointF(plot.right(), y));
    painter.setPen(text);
    painter.drawText(QRectF(0, y - line / 2, plot.left() - 5, line), Qt::AlignRight | Qt::AlignVCenter,
                     QString::fromStdString(yTexts[k]));
  }
  const double end_s = spec_.end_s - zero_s_; // 0 while a board runs
  const std::vector<double> xTicks = roundTicks(end_s - spec_.window_s, end_s, 6);
  const std::vector<std::string> xTexts = tickTexts(xTicks);
  for (std::size_t k = 0; k < xTicks.size(); ++k) {
    const double x = std::round(xOf(plot, zero_s_ + xTicks[k])) + 0.5;
    painter.setPen(QPen(grid, 1));
    painter.drawLine(QPointF(x, plot.top()), QPointF(x, plot.bottom()));
    painter.setPen(text);
    painter.drawText(QRectF(x - 40, plot.bottom() + 3, 80, line), Qt::AlignHCenter | Qt::AlignTop,
                     QString::fromStdString(xTexts[k]));
  }
  painter.setPen(text);
  painter.drawText(QRectF(plot.left(), plot.bottom() + line + 3, plot.width(), line + 2), Qt::AlignCenter,
                   (spec_.zero_s ? tr("time in the recording [s]") : tr("time before the last frame [s]")) +
                       (held_ ? tr(", frozen: double click to resume") : QString()));
  painter.save();
  const double label = std::max(plot.height(), QFontMetricsF(font()).horizontalAdvance(spec_.yLabel) + 2);
  const double middle = std::max(label / 2, std::min(plot.center().y(), height() - label / 2)); // complete, if it fits
  painter.translate(line / 2 + 4, middle);
  painter.rotate(-90);
  painter.drawText(QRectF(-label / 2, -line / 2, label, line), Qt::AlignCenter, spec_.yLabel);
  painter.restore();
  painter.setPen(QPen(text, 1));
  painter.drawLine(plot.bottomLeft(), plot.bottomRight());
  painter.drawLine(plot.topLeft(), plot.bottomLeft());
}

/// The time of doubt that holds a time; null: none.
const ImplausibleSpan* StripChart::implausibleAt(double t_s) const {
  const auto next = std::lower_bound(spec_.doubts.begin(), spec_.doubts.end(), t_s,
                                     [](const ImplausibleSpan& doubt, double at_s) { return doubt.to_s < at_s; });
  return next != spec_.doubts.end() && next->from_s <= t_s ? &*next : nullptr;
}

void StripChart::paintImplausible(QPainter& painter, const QRectF& plot) const {
  QColor hatch = ink(palp::palette(theme_).text);
  hatch.setAlphaF(kHatch);
  for (const ImplausibleSpan& doubt : spec_.doubts)
    painter.fillRect(
        QRectF(QPointF(xOf(plot, doubt.from_s), plot.top()), QPointF(xOf(plot, doubt.to_s), plot.bottom())),
        QBrush(hatch, Qt::BDiagPattern));
}

void StripChart::paintCurves(QPainter& painter, const QRectF& plot) const {
  painter.save();
  painter.setClipRect(plot.adjusted(0, -1, 0, 1));
  QColor tint = ink(palp::palette(theme_).force);
  tint.setAlphaF(0.15F);
  for (const auto& [from_s, to_s] : spec_.spans)
    painter.fillRect(QRectF(QPointF(xOf(plot, from_s), plot.top()), QPointF(xOf(plot, to_s), plot.bottom())), tint);
  paintImplausible(painter, plot);
  painter.setRenderHint(QPainter::Antialiasing);
  // Lines, and no polyline: its stroke is one path, and a frame of a noisy signal took Qt's painter seconds to fill it.
  QList<QLineF> lines, doubted;
  for (const StripSeries& series : spec_.series) {
    double column = -1; // of pixels; -1: the curve begins
    QPointF last;
    bool inDoubt = false;
    const auto lineTo = [&](const QPointF& point) {
      if (column >= 0) (inDoubt ? doubted : lines) << QLineF(last, point);
      last = point;
    };
    double least = 0, most = 0; // of the pixels' column, so that no peak is lost
    for (std::size_t k = 0; k < series.t_s.size(); ++k) {
      const double x = xOf(plot, series.t_s[k]);
      const bool before = k + 1 < series.t_s.size() && xOf(plot, series.t_s[k + 1]) < plot.left();
      if (before) continue;
      if (!std::isfinite(series.y[k])) {
        column = -1;
        continue;
      }
      inDoubt = implausibleAt(series.t_s[k]) != nullptr;
      const double y = std::clamp(yOf(plot, series.y[k]), plot.top() - kBeyond * plot.height(),
                                  plot.bottom() + kBeyond * plot.height());
      if (std::floor(x) == column) {
        if (y < least || y > most) lineTo({x, y});
        least = std::min(least, y);
        most = std::max(most, y);
        continue;
      }
      lineTo({x, y});
      column = std::floor(x);
      least = most = y;
    }
    const QColor color = ink(seriesColor(series.color, theme_));
    painter.setPen(QPen(greyed(color), 1.6));
    painter.drawLines(doubted);
    painter.setPen(QPen(color, 1.6));
    painter.drawLines(lines);
    lines.clear();
    doubted.clear();
  }
  painter.setPen(QPen(ink(palp::palette(theme_).force), 1, Qt::DotLine));
  for (const double limit : spec_.limits) {
    const double y = yOf(plot, limit);
    if (y >= plot.top() && y <= plot.bottom()) painter.drawLine(QPointF(plot.left(), y), QPointF(plot.right(), y));
  }
  paintMarks(painter, plot);
  painter.restore();
}

/// Each right of its mark, or as far left as the plot asks for, in the lowest line where it covers no other.
std::vector<StripChart::WordsOfMark> StripChart::wordsOfMarks(const QRectF& plot) const {
  const QFontMetricsF metrics(font());
  const double height = metrics.height();
  const int most = std::max(1, static_cast<int>(plot.height() / height));
  std::vector<WordsOfMark> all;
  for (const auto& [t_s, text] : spec_.marks) {
    const double x = xOf(plot, t_s);
    if (x < plot.left() || x > plot.right() || text.isEmpty()) continue;
    const bool alarm = text.startsWith("alarm: "); // the cursor shows more of it
    const QString words =
        metrics.elidedText(alarm ? tr("alarm") : text, Qt::ElideRight, plot.width() - 2 * kMarkGap_px);
    const double width = metrics.horizontalAdvance(words);
    QRectF place(std::min(x + kMarkGap_px, plot.right() - kMarkGap_px - width), plot.bottom() - height - 2, width,
                 height);
    const auto covers = [&](const WordsOfMark& other) {
      return other.place.adjusted(-kMarkGap_px, 1, kMarkGap_px, -1).intersects(place);
    };
    for (int line = 1; line < most && std::any_of(all.begin(), all.end(), covers); ++line) place.translate(0, -height);
    if (std::none_of(all.begin(), all.end(), covers)) all.push_back({place, words}); // else the cursor reads it
  }
  return all;
}

void StripChart::paintMarks(QPainter& painter, const QRectF& plot) const {
  QColor ground = ink(palp::palette(theme_).ground);
  ground.setAlphaF(0.8F);
  painter.setPen(QPen(ink(palp::palette(theme_).selection), 1, Qt::DashLine));
  for (const auto& mark : spec_.marks) {
    const double x = xOf(plot, mark.first);
    if (x >= plot.left() && x <= plot.right()) painter.drawLine(QPointF(x, plot.top()), QPointF(x, plot.bottom()));
  }
  for (const WordsOfMark& mark : wordsOfMarks(plot)) {
    painter.fillRect(mark.place, ground);
    painter.drawText(mark.place, Qt::AlignLeft | Qt::AlignVCenter, mark.words);
  }
}

double StripChart::legendWidth(std::size_t first, std::size_t count) const {
  double width = 0;
  for (std::size_t k = first; k < first + count; ++k)
    width += QFontMetricsF(font()).horizontalAdvance(spec_.series[k].name) + kLegendLine_px;
  return width;
}

std::vector<std::size_t> StripChart::legendLines(double room_px) const {
  std::vector<std::size_t> lines{0};
  std::size_t first = 0;
  for (std::size_t k = 0; k < spec_.series.size(); ++k) {
    if (lines.back() > 0 && legendWidth(first, lines.back() + 1) > room_px) {
      lines.push_back(0);
      first = k;
    }
    ++lines.back();
  }
  return lines;
}

int StripChart::linesAbove(double room_px) const {
  const std::vector<std::size_t> lines = legendLines(room_px);
  QFont bold = font();
  bold.setBold(true);
  const double title = QFontMetricsF(bold).horizontalAdvance(spec_.title);
  const bool shared = lines[0] == 0 || title + legendWidth(0, lines[0]) <= room_px;
  return static_cast<int>(lines.size()) + (shared ? 0 : 1);
}

void StripChart::paintLegend(QPainter& painter, const QRectF& plot) const {
  const QFontMetricsF metrics(font());
  const std::vector<std::size_t> lines = legendLines(plot.width());
  double y = 5 + (linesAbove(plot.width()) - static_cast<double>(lines.size())) * metrics.height();
  std::size_t first = 0;
  for (const std::size_t count : lines) {
    double x = plot.right();
    for (std::size_t k = first + count; k-- > first;) {
      const StripSeries& series = spec_.series[k];
      x -= metrics.horizontalAdvance(series.name);
      painter.setPen(ink(palp::palette(theme_).text));
      painter.drawText(QPointF(x, y + metrics.ascent()), series.name);
      painter.setPen(QPen(ink(seriesColor(series.color, theme_)), 3));
      painter.drawLine(QPointF(x - 18, y + 1 + metrics.height() / 2), QPointF(x - 5, y + 1 + metrics.height() / 2));
      x -= kLegendLine_px;
    }
    first += count;
    y += metrics.height();
  }
}

std::vector<StripChart::ReadingLine> StripChart::readingLines() const {
  const QRectF plot = plotRectangle();
  if (pointer_px_ < plot.left() || pointer_px_ > plot.right()) return {};
  const double t_s = spec_.end_s - (plot.right() - pointer_px_) / plot.width() * spec_.window_s;
  std::vector<ReadingLine> lines{{tr("time"), tr("%1 s").arg(t_s - zero_s_, 0, 'f', held_ ? 3 : 2), {}}};
  for (const StripSeries& series : spec_.series) {
    const auto next = std::lower_bound(series.t_s.begin(), series.t_s.end(), t_s);
    if (next == series.t_s.end()) continue;
    const auto place = static_cast<std::size_t>(next - series.t_s.begin());
    // Before the first value, and where the curve is broken, there is none until the next one is under the pointer.
    const bool joined = place > 0 && std::isfinite(series.y[place - 1]);
    const bool there = joined || xOf(plot, *next) - pointer_px_ <= kMarkGap_px;
    const double value = there ? series.y[place] : std::numeric_limits<double>::quiet_NaN();
    QString text = std::isfinite(value) ? QString::number(value, 'g', 4) : tr("none");
    const bool known = std::isfinite(value) && place < series.deviation.size();
    if (known && std::isfinite(series.deviation[place]))
      text += QString::fromUtf8(" \u00b1 %1").arg(series.deviation[place], 0, 'g', 2);
    lines.push_back({series.name, std::isfinite(value) ? text + unit() : text, series.color});
  }
  if (const ImplausibleSpan* doubt = implausibleAt(t_s)) lines.push_back({tr("implausible"), doubt->why, {}});
  for (const auto& [mark_s, text] : spec_.marks)
    if (std::abs(xOf(plot, mark_s) - pointer_px_) <= kMarkGap_px) lines.push_back({tr("mark"), text, {}});
  return lines;
}

QString StripChart::reading() const {
  QStringList words;
  for (const ReadingLine& line : readingLines()) words << line.name + " " + line.value;
  return words.join("\n");
}

/// The unit of the values: the text in brackets in the axis label.
QString StripChart::unit() const {
  const QString unit = spec_.yLabel.section('[', 1).section(']', 0, 0);
  return unit.isEmpty() ? QString() : " " + unit;
}

/// The values under the pointer, or under the cursor that the keys moved, one below the other.
void StripChart::paintReading(QPainter& painter, const QRectF& plot) const {
  const std::vector<ReadingLine> lines = readingLines();
  if (lines.empty()) return;
  painter.setPen(QPen(ink(palp::palette(theme_).text), 1));
  painter.drawLine(QPointF(pointer_px_, plot.top()), QPointF(pointer_px_, plot.bottom()));
  const QFontMetricsF metrics(font());
  double names = 0, values = 0;
  for (const ReadingLine& line : lines) {
    names = std::max(names, metrics.horizontalAdvance(line.name));
    values = std::max(values, metrics.horizontalAdvance(line.value));
  }
  const double height = metrics.height();
  QRectF box(0, plot.top() + 2, kSwatch_px + names + values + 4 * kReadingGap_px,
             height * static_cast<double>(lines.size()) + kReadingGap_px);
  const bool left = pointer_px_ + kReadingGap_px + box.width() > plot.right(); // it hides nothing newer than the cursor
  box.moveLeft(std::max(plot.left(), left ? pointer_px_ - kReadingGap_px - box.width() : pointer_px_ + kReadingGap_px));
  QColor ground = ink(palp::palette(theme_).ground);
  ground.setAlphaF(0.9F);
  painter.setBrush(ground);
  painter.setPen(QPen(ink(palp::palette(theme_).grid), 1));
  painter.drawRect(box);
  QRectF row(box.left() + kReadingGap_px, box.top() + kReadingGap_px / 2, box.width() - 2 * kReadingGap_px, height);
  for (const ReadingLine& line : lines) {
    if (line.color) {
      painter.setPen(QPen(ink(seriesColor(*line.color, theme_)), 3));
      const double y = row.center().y();
      painter.drawLine(QPointF(row.left(), y), QPointF(row.left() + kSwatch_px - kReadingGap_px, y));
    }
    painter.setPen(ink(palp::palette(theme_).text));
    painter.drawText(row.adjusted(kSwatch_px, 0, 0, 0), Qt::AlignLeft | Qt::AlignVCenter, line.name);
    painter.drawText(row, Qt::AlignRight | Qt::AlignVCenter, line.value);
    row.translate(0, height);
  }
}

} // namespace palp
