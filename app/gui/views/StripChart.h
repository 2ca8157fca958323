#pragma once

#include "app/scenes/Palette.h"

#include <QString>
#include <QWidget>

#include <array>
#include <optional>
#include <vector>

namespace palp {

/// A curve over time; a value that is not a number breaks it.
struct StripSeries {
  QString name;
  int color = 0; ///< place in the palette's series colours
  std::vector<double> t_s, y;
  std::vector<double> deviation{}; ///< standard deviation of each y, no number where it is not known; empty: of none
};

/// A time in which the values can hardly be true: the curves are grey there, on a hatched ground.
struct ImplausibleSpan {
  double from_s = 0, to_s = 0;
  QString why; ///< at its end
};

/// What is drawn: the last seconds, on a scale that stays.
struct StripSpec {
  QString title, yLabel;
  std::array<double, 2> yRange{0, 1};
  double end_s = 0;               ///< time at the right edge
  std::optional<double> zero_s{}; ///< that the axis counts from, the begin of a recording; none: the last frame
  double window_s = 10;
  std::vector<StripSeries> series;
  std::vector<std::pair<double, QString>> marks; ///< events at their times
  std::vector<std::array<double, 2>> spans;      ///< tinted times: from, to
  std::vector<ImplausibleSpan> doubts;           ///< in order
  std::vector<double> limits;                    ///< drawn across
  QString empty;                                 ///< shown where there is no curve
};

/// Curves of a live source. The wheel zooms in time (Ctrl: in value), a drag moves: then the curves are held, until a
/// double click lets them run again. Painted by Qt itself: a chart of VTK costs several times as much a frame.
class StripChart : public QWidget {
  Q_OBJECT

public:
  explicit StripChart(QWidget* parent = nullptr);

  /// Draws another moment; nothing while it is held.
  void setChart(StripSpec spec);
  /// The user looks at one moment.
  [[nodiscard]] bool held() const { return held_; }
  /// All that is to be looked at while it is held, in place of the last seconds.
  void holdChart(StripSpec spec);
  void release();
  /// What is seen of the curves as a table: time [s], one column a curve, then one a deviation; nothing where one has
  /// no value. Where there are times of doubt, a last column is 1 in them and 0 elsewhere.
  [[nodiscard]] QString asCsv() const;
  void setTheme(Theme theme);
  /// Time, values with their deviations and marks at the cursor, a line each; empty where it is not in the plot.
  [[nodiscard]] QString reading() const;
  [[nodiscard]] const StripSpec& chart() const { return spec_; }
  [[nodiscard]] int paintCount() const { return paintCount_; }

signals:
  /// The user begins to look at one moment: who has more than the last seconds may give it by holdChart.
  void heldNow();
  void released();
  void message(const QString& sentence);

protected:
  bool event(QEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;

private:
  struct WordsOfMark {
    QRectF place;
    QString words;
  };
  [[nodiscard]] std::vector<WordsOfMark> wordsOfMarks(const QRectF& plot) const;
  void hold();
  void zoomTime(double factor, double about_px);
  void zoomValue(double factor, double about_px);
  void move(double byTime_s, double byValue);
  void moveCursor(int steps);
  /// Reports the sentence, or why it failed.
  void write(const QString& file, const QByteArray& content, const QString& done);
  void saveCsv();
  void savePdf();
  void paintAxes(QPainter& painter, const QRectF& plot) const;
  void paintCurves(QPainter& painter, const QRectF& plot) const;
  void paintImplausible(QPainter& painter, const QRectF& plot) const;
  void paintMarks(QPainter& painter, const QRectF& plot) const;
  void paintLegend(QPainter& painter, const QRectF& plot) const;
  void paintReading(QPainter& painter, const QRectF& plot) const;
  /// What is shown at the cursor: a curve's name and value, or one text alone.
  struct ReadingLine {
    QString name, value;
    std::optional<int> color;
  };
  [[nodiscard]] std::vector<ReadingLine> readingLines() const;
  /// The legend's lines: how many curves each has, from the first.
  [[nodiscard]] std::vector<std::size_t> legendLines(double room_px) const;
  [[nodiscard]] double legendWidth(std::size_t first, std::size_t count) const;
  /// The title gets a line of its own where it does not fit next to the legend's first line.
  [[nodiscard]] int linesAbove(double room_px) const;
  [[nodiscard]] const ImplausibleSpan* implausibleAt(double t_s) const;
  [[nodiscard]] QString unit() const;
  [[nodiscard]] QRectF plotRectangle() const;
  [[nodiscard]] double xOf(const QRectF& plot, double t_s) const;
  [[nodiscard]] double yOf(const QRectF& plot, double y) const;

  StripSpec spec_;
  Theme theme_ = Theme::Light;
  double pointer_px_ = -1; ///< where the mouse is; -1: not here
  bool held_ = false;
  double zero_s_ = 0;           ///< that the axis counts from
  std::optional<QPointF> drag_; ///< last place of the mouse while it moves the curves
  int paintCount_ = 0;
};

} // namespace palp
