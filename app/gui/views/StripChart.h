#pragma once

#include "app/scenes/Palette.h"

#include <QString>
#include <QWidget>

#include <array>
#include <vector>

namespace palp {

/// A curve over time; a value that is no number breaks it.
struct StripSeries {
  QString name;
  int color = 0; ///< place in the palette's series colours
  std::vector<double> t_s, y;
};

/// What is drawn: the last seconds, on a scale that stays.
struct StripSpec {
  QString title, yLabel;
  std::array<double, 2> yRange{0, 1};
  double end_s = 0; ///< time at the right edge
  double window_s = 10;
  std::vector<StripSeries> series;
  std::vector<std::pair<double, QString>> marks; ///< events at their times
  QString empty;                                 ///< said where there is no curve
};

/// Curves of a live source. Painted by Qt itself: a chart of VTK costs several times as much a frame.
class StripChart : public QWidget {
  Q_OBJECT

public:
  explicit StripChart(QWidget* parent = nullptr);

  void setChart(StripSpec spec);
  void setTheme(Theme theme);
  [[nodiscard]] const StripSpec& chart() const { return spec_; }
  [[nodiscard]] int paintCount() const { return paintCount_; }

protected:
  void paintEvent(QPaintEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;

private:
  void paintAxes(QPainter& painter, const QRectF& plot) const;
  void paintCurves(QPainter& painter, const QRectF& plot) const;
  void paintLegend(QPainter& painter, const QRectF& plot) const;
  void paintReading(QPainter& painter, const QRectF& plot) const;
  [[nodiscard]] double legendWidth() const;
  [[nodiscard]] QRectF plotRectangle() const;
  [[nodiscard]] double xOf(const QRectF& plot, double t_s) const;
  [[nodiscard]] double yOf(const QRectF& plot, double y) const;

  StripSpec spec_;
  Theme theme_ = Theme::Light;
  double pointer_px_ = -1; ///< where the mouse is; -1: not here
  int paintCount_ = 0;
};

} // namespace palp
