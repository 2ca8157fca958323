#pragma once

#include "model/LoadCase.h"
#include "model/SensorDesign.h"

#include <QPainterPath>
#include <QWidget>

#include <optional>

namespace palp {

enum class LoadKind { Area, Disc, Indenter };

/// One load of a load case: on an area (by its number), on a disc or of an indenter (by its place in the list).
struct LoadPlace {
  LoadKind kind = LoadKind::Area;
  int number = 0;
  bool operator==(const LoadPlace&) const = default;
};

/// The top face from above, to scale and never larger than the panel: the load areas, what they bear, the discs and
/// the indenters.
/// Arrow keys walk over the areas, Space chooses, Delete takes a load away.
class AreaPlan : public QWidget {
  Q_OBJECT

public:
  explicit AreaPlan(QWidget* parent = nullptr);

  void display(const SensorDesign& design, const LoadCase& load, const LoadPlace& chosen);
  /// Middle of an area, a disc or an indenter in the widget.
  [[nodiscard]] QPoint placeOf(const LoadPlace& load) const;

signals:
  void chosen(const palp::LoadPlace& load);
  void removed(const palp::LoadPlace& load);

protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  bool event(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

private:
  void fit();
  [[nodiscard]] double scale() const; ///< pixels a mm
  [[nodiscard]] QPointF place(const Eigen::Vector2d& xy_mm) const;
  [[nodiscard]] QRectF box(const Rectangle& rectangle) const;
  /// The indenter under a place, else the disc, else the area.
  [[nodiscard]] std::optional<LoadPlace> at(const QPointF& place) const;
  [[nodiscard]] const AreaLoad* loadOn(int area) const;
  /// An indenter from above: a circle, a cylinder's strip, or all of the face.
  [[nodiscard]] QPainterPath outline(const Indenter& indenter) const;

  SensorDesign design_;
  LoadCase load_;
  LoadPlace chosen_;
};

} // namespace palp
