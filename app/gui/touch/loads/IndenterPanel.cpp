#include "app/gui/touch/loads/IndenterPanel.h"

#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/ShapeWords.h"
#include "app/gui/widgets/SpinBoxes.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QEvent>
#include <QFormLayout>
#include <QPainter>

#include <algorithm>

namespace palp {

namespace {

constexpr int kPictureWidth_px = 28, kPictureHeight_px = 20;
constexpr double kFirstDepth_mm = 0.2;

/// A section through the indenter on the rubber.
QIcon picture(IndenterShape shape, const QPalette& colors, double ratio) {
  QPixmap pixmap(QSize(kPictureWidth_px, kPictureHeight_px) * ratio);
  pixmap.setDevicePixelRatio(ratio);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  const QPen rubber(colors.color(QPalette::Highlight), 2), body(colors.color(QPalette::WindowText), 1.5);
  constexpr double kGround = 17, kMiddle = 14;
  painter.setPen(rubber);
  painter.drawLine(QPointF(2, kGround), QPointF(26, kGround));
  painter.setPen(body);
  switch (shape) {
  case IndenterShape::Sphere:
    painter.drawEllipse(QPointF(kMiddle, kGround - 8), 7, 7);
    break;
  case IndenterShape::Pin:
    painter.drawArc(QRectF(kMiddle - 4, kGround - 9, 8, 8), 180 * 16, 180 * 16);
    for (const double x : {kMiddle - 4, kMiddle + 4}) painter.drawLine(QPointF(x, 1), QPointF(x, kGround - 5));
    break;
  case IndenterShape::Flat:
    painter.drawRoundedRect(QRectF(kMiddle - 6, 1, 12, kGround - 2), 2, 2);
    break;
  case IndenterShape::CylinderX:
    painter.drawRoundedRect(QRectF(3, kGround - 11, 22, 10), 1, 1);
    painter.drawLine(QPointF(3, kGround - 6), QPointF(25, kGround - 6));
    break;
  case IndenterShape::CylinderY:
    painter.drawEllipse(QPointF(kMiddle, kGround - 7), 6, 6);
    painter.drawEllipse(QPointF(kMiddle + 4, kGround - 10), 6, 6);
    break;
  case IndenterShape::Plane:
    painter.drawRect(QRectF(2, kGround - 5, 24, 4));
    break;
  }
  return pixmap;
}

} // namespace

IndenterPanel::IndenterPanel(QWidget* parent) : QWidget(parent) {
  auto* form = new QFormLayout(this);
  form->setContentsMargins(0, 0, 0, 0);
  shape_ = choiceBox("indenterShape", {},
                     tr("Shape of the rigid indenter. Pin and punch are upright; cylinders extend across the complete "
                        "block. The sensor's own top face is always flat."),
                     tr("Shape of the indenter"));
  shape_->setIconSize({kPictureWidth_px, kPictureHeight_px});
  for (const auto& [shape, name] : kIndenterShapes.all()) shape_->addItem(inWords(shape));
  drawShapes();
  form->addRow(tr("Shape"), shape_);
  radius_ = addNumber(*form, "indenterRadius", tr("Radius"), tr(" mm"),
                      tr("Radius of the indenter; it can also be dragged at its rim in the view"));
  rim_ = addNumber(*form, "indenterRim", tr("Edge radius"), tr(" mm"),
                   tr("Radius of the punch's rounded edge; an edge sharper than the mesh is not resolved"));
  x_ = addNumber(*form, "indenterX", tr("Position x"), tr(" mm"),
                 tr("Position of the indenter's lowest point; it can also be dragged in the view"));
  y_ = addNumber(*form, "indenterY", tr("Position y"), tr(" mm"),
                 tr("Position of the indenter's lowest point; it can also be dragged in the view"));
  friction_ = addNumber(*form, "indenterFriction", tr("Friction"), {},
                        tr("Coulomb's coefficient of friction, 0 to 2; a tangential force needs it. A solve with "
                           "friction takes several times as long."));
  control_ = choiceBox("indenterControl", {tr("Force"), tr("Displacement")},
                       tr("Force control prescribes a force along x, y and z. Displacement control prescribes a depth "
                          "from the first contact and a tangential shift after it."),
                       tr("Control of the indenter"));
  form->addRow(tr("Control"), control_);
  depth_ = addNumber(*form, "indenterDepth", tr("Depth"), tr(" mm"),
                     tr("Depth from the first contact with the top face at rest"));
  shiftX_ = addNumber(*form, "indenterShiftX", tr("Shift x"), tr(" mm"),
                      tr("Tangential shift after the indenter was pressed in"));
  shiftY_ = addNumber(*form, "indenterShiftY", tr("Shift y"), tr(" mm"),
                      tr("Tangential shift after the indenter was pressed in"));
  for (QComboBox* box : {shape_, control_}) connect(box, &QComboBox::activated, this, &IndenterPanel::read);
}

QDoubleSpinBox* IndenterPanel::addNumber(QFormLayout& form, const char* name, const QString& label, const QString& unit,
                                         const QString& tip) {
  auto* box = numberBox(name, {.decimals = 3, .step = 0.1, .unit = unit}, tip, tr("Indenter, %1").arg(label));
  form.addRow(label, box);
  connect(box, &QDoubleSpinBox::valueChanged, this, &IndenterPanel::read);
  return box;
}

void IndenterPanel::drawShapes() {
  for (int k = 0; k < shape_->count(); ++k)
    shape_->setItemIcon(
        k, picture(kIndenterShapes.all()[static_cast<std::size_t>(k)].first, palette(), devicePixelRatioF()));
}

void IndenterPanel::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) drawShapes();
}

void IndenterPanel::display(const Indenter& indenter, const SensorDesign& design) {
  displaying_ = true;
  shown_ = indenter;
  const auto& shapes = kIndenterShapes.all();
  const auto its = std::find_if(shapes.begin(), shapes.end(), [&](const auto& s) { return s.first == indenter.shape; });
  shape_->setCurrentIndex(static_cast<int>(its - shapes.begin()));
  control_->setCurrentIndex(indenter.press() != nullptr ? 0 : 1);
  const auto show = [](QDoubleSpinBox* box, double low, double high, double value) {
    box->setRange(low, high);
    showExactly(*box, value);
  };
  show(radius_, 0.05, 1e5, indenter.radius_mm);
  show(rim_, 0, indenter.radius_mm, indenter.rim_mm);
  show(x_, 0, design.block_mm.x(), indenter.place_mm.x());
  show(y_, 0, design.block_mm.y(), indenter.place_mm.y());
  show(friction_, 0, 2, indenter.friction);
  const Motion* motion = indenter.motion();
  const Eigen::Vector2d shift = motion != nullptr ? motion->shift_mm : Eigen::Vector2d(0, 0);
  show(depth_, 0.001, design.block_mm.z(), motion != nullptr ? motion->depth_mm : kFirstDepth_mm);
  show(shiftX_, -design.block_mm.x(), design.block_mm.x(), shift.x());
  show(shiftY_, -design.block_mm.y(), design.block_mm.y(), shift.y());
  auto* form = static_cast<QFormLayout*>(layout());
  form->setRowVisible(radius_, indenter.shape != IndenterShape::Plane);
  form->setRowVisible(rim_, indenter.shape == IndenterShape::Flat);
  for (QDoubleSpinBox* box : {depth_, shiftX_, shiftY_}) form->setRowVisible(box, motion != nullptr);
  displaying_ = false;
}

void IndenterPanel::read() {
  if (displaying_) return;
  Indenter next = shown_;
  next.shape = kIndenterShapes.all()[static_cast<std::size_t>(shape_->currentIndex())].first;
  next.radius_mm = radius_->value();
  next.rim_mm = next.shape == IndenterShape::Flat ? std::min(rim_->value(), next.radius_mm) : 0;
  if (next.shape == IndenterShape::Flat && shown_.shape != IndenterShape::Flat) next.rim_mm = 0.1 * next.radius_mm;
  next.place_mm = {x_->value(), y_->value()};
  next.friction = friction_->value();
  if (control_->currentIndex() == 1)
    next.control = Motion{depth_->value(), {shiftX_->value(), shiftY_->value()}};
  else if (next.press() == nullptr)
    next.control = Press{};
  emit edited(next);
}

} // namespace palp
