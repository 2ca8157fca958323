#include "app/gui/live/LiveView.h"

#include "app/gui/views/TextScale.h"

#include <QKeyEvent>
#include <QPainter>

#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>

namespace palp {

struct LiveView::Parts {
  LiveScene scene;
  SensorDesign design;
  LiveSceneOptions options;
  std::vector<LiveArrow> arrows;
  std::vector<std::string> lines;
  std::optional<Eigen::Vector2d> truth_mm;
  bool stale = false;
};

namespace {

constexpr double kForceStep_N = 0.1, kPlaceStep_mm = 0.5;

} // namespace

LiveView::LiveView(QWidget* parent) : LiveView(std::make_unique<Parts>(), parent) {}

LiveView::LiveView(std::unique_ptr<Parts> parts, QWidget* parent)
    : VtkView(parts->scene.renderer(), nullptr, parent), parts_(std::move(parts)) {
  parts_->design = paperDesign();
  setFocusPolicy(Qt::StrongFocus);
  draw();
  fit(liveDirection);
  connect(this, &VtkView::doubleClicked, this, [this] { lookAlong(liveDirection); });
  connect(this, &VtkView::sizeChanged, this, [this] {
    if (renderCount() == 0 || eye() == fittedEye_) fit(direction_);
  });
}

LiveView::~LiveView() = default;

void LiveView::draw() {
  parts_->options.scale = devicePixelRatioF();
  parts_->options.textScale = devicePixelRatioF() * textScale(*this);
  parts_->scene.showSensor(parts_->design, parts_->options);
  parts_->scene.showForces(parts_->arrows, parts_->stale, parts_->lines, parts_->truth_mm);
  invalidate();
}

void LiveView::showSensor(const SensorDesign& design, double mm_per_N, bool electrodes) {
  const bool otherBlock = !(design.block_mm == parts_->design.block_mm);
  parts_->design = design;
  parts_->options.mm_per_N = mm_per_N;
  parts_->options.electrodes = electrodes;
  draw();
  if (otherBlock) fit(liveDirection);
}

void LiveView::showForces(const std::vector<LiveArrow>& arrows, bool stale, const std::vector<std::string>& lines,
                          const std::optional<Eigen::Vector2d>& truth_mm) {
  const bool unchanged =
      arrows == parts_->arrows && stale == parts_->stale && lines == parts_->lines && truth_mm == parts_->truth_mm;
  if (unchanged && parts_->options.scale == devicePixelRatioF()) return;
  parts_->arrows = arrows;
  parts_->stale = stale;
  parts_->lines = lines;
  parts_->truth_mm = truth_mm;
  if (parts_->options.scale != devicePixelRatioF()) return draw();
  parts_->scene.showForces(arrows, stale, lines, truth_mm);
  invalidate();
}

void LiveView::setTheme(Theme theme) {
  parts_->options.theme = theme;
  draw();
}

void LiveView::lookAlong(const Eigen::Vector3d& direction) {
  fit(direction);
  invalidate();
}

void LiveView::fit(const Eigen::Vector3d& direction) {
  parts_->scene.resetCamera(aspect(), direction);
  direction_ = direction;
  fittedEye_ = eye();
}

Eigen::Vector3d LiveView::eye() const {
  return Eigen::Vector3d(parts_->scene.renderer()->GetActiveCamera()->GetPosition());
}

void LiveView::changeEvent(QEvent* event) {
  VtkView::changeEvent(event);
  if (event->type() == QEvent::FontChange) draw();
}

std::optional<Eigen::Vector2d> LiveView::topPlace(const QPointF& place) const {
  const QPointF device = devicePlace(place);
  return parts_->scene.topPlace(device.x(), device.y());
}

bool LiveView::grab(const QPointF& place, Qt::KeyboardModifiers) {
  if (!pressable_) return false;
  const std::optional<Eigen::Vector2d> at_mm = topPlace(place);
  if (!at_mm) return false;
  if (placed_) {
    const bool onFace =
        (at_mm->array() >= 0).all() && (at_mm->array() <= parts_->design.block_mm.head<2>().array()).all();
    if (onFace) emit placePressed(*at_mm);
    return onFace;
  }
  for (int area = 0; area < parts_->design.areas.count(); ++area) {
    const Rectangle box = parts_->design.areaRectangle(area);
    if ((at_mm->array() < box.low_mm.array()).any() || (at_mm->array() > box.high_mm.array()).any()) continue;
    pressed_mm_ = *at_mm;
    emit areaPressed(area);
    return true;
  }
  return false;
}

void LiveView::dragTo(const QPointF& place, Qt::KeyboardModifiers) {
  const auto at_mm = topPlace(place);
  if (at_mm && placed_)
    emit placePressed(at_mm->cwiseMax(0).cwiseMin(parts_->design.block_mm.head<2>()));
  else if (at_mm)
    emit sheared((*at_mm - pressed_mm_) / parts_->options.mm_per_N);
}

int LiveView::areaBeside(int dx, int dy) const {
  const LoadAreas& areas = parts_->design.areas;
  const int column = std::clamp(area_ % areas.columns + dx, 0, areas.columns - 1);
  const int row = std::clamp(area_ / areas.columns + dy, 0, areas.rows - 1);
  return row * areas.columns + column;
}

void LiveView::keyPressEvent(QKeyEvent* event) {
  const auto way = [&]() -> std::optional<std::array<int, 2>> {
    switch (event->key()) {
    case Qt::Key_Left:
      return std::array{-1, 0};
    case Qt::Key_Right:
      return std::array{1, 0};
    case Qt::Key_Up:
      return std::array{0, 1};
    case Qt::Key_Down:
      return std::array{0, -1};
    default:
      return {};
    }
  }();
  const bool harder = event->key() == Qt::Key_Plus, softer = event->key() == Qt::Key_Minus;
  if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter)
    emit handRequested();
  else if (pressable_ && placed_ && way)
    emit placeStepped(kPlaceStep_mm * Eigen::Vector2d((*way)[0], (*way)[1]));
  else if (pressable_ && way && event->modifiers().testFlag(Qt::ShiftModifier))
    emit forceStepped(kForceStep_N * Eigen::Vector3d((*way)[0], (*way)[1], 0));
  else if (pressable_ && way)
    emit areaPressed(areaBeside((*way)[0], (*way)[1]));
  else if (pressable_ && (harder || softer))
    emit forceStepped({0, 0, harder ? -kForceStep_N : kForceStep_N}); // a push is negative in z
  else
    VtkView::keyPressEvent(event);
}

void LiveView::paintEvent(QPaintEvent* event) {
  VtkView::paintEvent(event);
  if (!hasFocus()) return;
  QPainter painter(this);
  painter.setPen(QPen(palette().color(QPalette::Highlight), 2));
  painter.drawRect(rect().adjusted(1, 1, -1, -1));
}

void LiveView::focusInEvent(QFocusEvent* event) {
  VtkView::focusInEvent(event);
  update();
}

void LiveView::focusOutEvent(QFocusEvent* event) {
  VtkView::focusOutEvent(event);
  update();
}

const std::vector<LiveArrow>& LiveView::arrows() const {
  return parts_->arrows;
}

const std::optional<Eigen::Vector2d>& LiveView::truth_mm() const {
  return parts_->truth_mm;
}

bool LiveView::stale() const {
  return parts_->stale;
}

} // namespace palp
