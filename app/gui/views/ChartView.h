#pragma once

#include "app/gui/views/VtkView.h"
#include "app/scenes/charts/Chart.h"

#include <optional>

class vtkAxis;

namespace palp {

/// A chart that can be zoomed with the wheel and moved; double click shows all of it again. The point under the pointer
/// is read; by keys: arrows move, + and - zoom, Home shows all, Ctrl and arrows go from point to point.
class ChartView : public VtkView {
  Q_OBJECT

public:
  explicit ChartView(QWidget* parent = nullptr);
  ~ChartView() override;

  void setChart(const ChartSpec& spec);
  void setTheme(Theme theme);
  [[nodiscard]] bool hasSvg() const override { return !empty(); }
  [[nodiscard]] std::string svg() const override;
  [[nodiscard]] QString table() const override;
  [[nodiscard]] bool worthSaving() const override { return !empty(); }
  [[nodiscard]] const ChartSpec& chart() const { return spec_; }
  /// Faint, for what does not hold any more.
  void setFaint(bool faint);
  [[nodiscard]] bool faint() const { return faint_; }
  /// A point of a curve.
  struct Point {
    std::size_t series = 0, at = 0;
  };
  /// The one that is read, as text; empty: none.
  [[nodiscard]] QString reading() const;
  /// Where a point was drawn; nullopt outside the axes.
  [[nodiscard]] std::optional<QPointF> placeOf(const Point& point) const;

protected:
  [[nodiscard]] bool standsStill() const override { return true; }
  /// The ground, the axes, then the words: with the curves they are 60 ms of shaders and letters, once in a process.
  [[nodiscard]] bool drawPart(int part) override;
  [[nodiscard]] bool prepared() override { return empty() || VtkView::prepared(); }
  void render(QImage& image) override;
  void paintEvent(QPaintEvent* event) override;
  void changeEvent(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  [[nodiscard]] Picture renderPicture(int width, int height) override;

private:
  struct Parts;
  ChartView(std::unique_ptr<Parts> parts, QWidget* parent);
  void fill();
  void fill(double scale, const QSizeF& size);
  /// Moves and zooms the axes: shares of what they show.
  void moveAxes(double x, double y, double zoom);
  [[nodiscard]] vtkAxis& axis(int position) const;
  void readAt(const QPointF& place);
  /// The next point of the curve, or the same of the next curve.
  void readNext(int points, int curves);
  void paintReading(QPainter& painter) const;
  /// Nothing to draw but words.
  [[nodiscard]] bool empty() const;
  [[nodiscard]] QColor ground() const;

  std::unique_ptr<Parts> parts_;
  ChartSpec spec_;
  Theme theme_ = Theme::Light;
  bool faint_ = false;
  std::optional<Point> read_;
};

} // namespace palp
