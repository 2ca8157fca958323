#include "app/gui/views/BlockView.h"

#include "app/scenes/block/Overlay.h"

#include <vtkCamera.h>
#include <vtkCellPicker.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace palp {

namespace {

constexpr double kGrip_px = 9; ///< around an arrow
constexpr double kCutGrip_px = 12;
constexpr double kPlaneHandle_mm = 2; ///< a plane has no rim: it is taken near its place
constexpr double kWayStep_mm = 0.2;   ///< between the points of a way that is drawn
constexpr double kStepsANewton = 100; ///< a force is dragged to hundredths
constexpr double kLeast_N = 0.01;

double distance(const QPointF& place, const QPointF& from, const QPointF& to) {
  const QPointF way = to - from;
  const double length2 = QPointF::dotProduct(way, way);
  const double t = length2 > 0 ? std::clamp(QPointF::dotProduct(place - from, way) / length2, 0.0, 1.0) : 0;
  const QPointF off = place - (from + t * way);
  return std::hypot(off.x(), off.y());
}

} // namespace

struct BlockView::Parts {
  DeformationScene scene;
  std::optional<SensorDesign> design; ///< of the last state; none before the first
  Eigen::Vector3d look = kFirstLook;  ///< along which the camera was fitted last
  std::array<double, 6> fitted{};     ///< where that put it
  double legendRoom_px = 0;           ///< that it left free

  [[nodiscard]] std::array<double, 6> camera() const {
    vtkCamera& its = *scene.renderer()->GetActiveCamera();
    std::array<double, 6> places{};
    its.GetPosition(places.data());
    its.GetFocalPoint(places.data() + 3);
    return places;
  }
};

BlockView::BlockView(QWidget* parent) : BlockView(std::make_unique<Parts>(), parent) {}

BlockView::BlockView(std::unique_ptr<Parts> parts, QWidget* parent)
    : VtkView(parts->scene.renderer(), nullptr, parent), parts_(std::move(parts)) {
  connect(this, &VtkView::clicked, this, &BlockView::pick);
  connect(this, &VtkView::doubleClicked, this, &BlockView::resetCamera);
  connect(this, &VtkView::sizeChanged, this, [this] {
    // A panel next to the view opened or closed: all of the block stays in sight, unless the user looks elsewhere.
    if (renderCount() == 0)
      resetCamera();
    else if (parts_->camera() == parts_->fitted)
      lookAlong(parts_->look);
  });
  connect(this, &VtkView::hovered, this, &BlockView::showCursor);
}

BlockView::~BlockView() = default;

void BlockView::show(const DeformationState& state, const DeformationOptions& options, bool meshChanged) {
  parts_->scene.show(state, options, meshChanged);
  const bool other = !parts_->design || parts_->design->block_mm != state.design->block_mm;
  parts_->design = *state.design;
  cut_ = options.cutGrip ? options.cut : std::nullopt;
  scale_ = options.scale;
  scaleText();
  if (other)
    resetCamera();
  else if (parts_->legendRoom_px != parts_->scene.legendRoom_px() && parts_->camera() == parts_->fitted)
    lookAlong(parts_->look); // another legend: the block keeps clear of it
  invalidate();
}

void BlockView::setTheme(Theme theme) {
  const Color& ground = palp::palette(theme).ground;
  parts_->scene.renderer()->SetBackground(ground[0], ground[1], ground[2]);
  invalidate();
}

void BlockView::resetCamera() {
  lookAlong(kFirstLook);
}

void BlockView::lookAlong(const Eigen::Vector3d& direction) {
  if (!parts_->design) return;
  parts_->scene.resetCamera(
      *parts_->design, aspect(), direction,
      std::clamp(parts_->scene.legendRoom_px() / (devicePixelRatioF() * std::max(width(), 1)), 0.02, 0.4));
  parts_->legendRoom_px = parts_->scene.legendRoom_px();
  parts_->look = direction;
  parts_->fitted = parts_->camera();
  invalidate();
}

double BlockView::deformationScale() const {
  return parts_->scene.deformationScale();
}

std::array<double, 2> BlockView::colorRange() const {
  return parts_->scene.colorRange();
}

std::array<double, 3> BlockView::cameraPosition() const {
  std::array<double, 3> place{};
  parts_->scene.renderer()->GetActiveCamera()->GetPosition(place.data());
  return place;
}

void BlockView::setTextScale(double scale) {
  parts_->scene.setTextScale(scale);
}

int BlockView::loadCount() const {
  return static_cast<int>(parts_->scene.forces().size());
}

std::vector<PatchLoad> BlockView::handles() const {
  if (handles_ == Movable::Discs) return parts_->scene.discs();
  std::vector<PatchLoad> all;
  if (handles_ == Movable::Indenters)
    for (const Indenter& indenter : parts_->scene.indenters()) {
      PatchLoad& handle = all.emplace_back();
      handle.centre_mm = indenter.place_mm;
      handle.radius_mm = indenter.shape == IndenterShape::Plane ? kPlaneHandle_mm : indenter.radius_mm;
    }
  return all;
}

double BlockView::height_mm() const {
  return parts_->design ? parts_->design->block_mm.z() : 0;
}

vtkCamera* BlockView::camera() const {
  return parts_->scene.renderer()->GetActiveCamera();
}

QPointF BlockView::placeOf(const Eigen::Vector3d& drawn_mm) const {
  vtkRenderer& renderer = *parts_->scene.renderer();
  renderer.SetWorldPoint(drawn_mm.x(), drawn_mm.y(), drawn_mm.z(), 1);
  renderer.WorldToDisplay();
  const double* place = renderer.GetDisplayPoint();
  return {place[0] / devicePixelRatioF(), height() - 1 - place[1] / devicePixelRatioF()};
}

void BlockView::markNode(int node) {
  parts_->scene.markNode(node);
  invalidate();
}

std::optional<QPointF> BlockView::gripOf(int load) const {
  const double scale = parts_->scene.arrowScale_mmPerN();
  for (const PlacedForce& force : parts_->scene.forces())
    if (force.load == load && force.movable && !force.hidden) return placeOf(force.freeEnd_mm(scale));
  return {};
}

int BlockView::arrowAt(const QPointF& place) const {
  if (renderCount() == 0) return -1;
  const std::vector<PlacedForce>& forces = parts_->scene.forces();
  const double scale = parts_->scene.arrowScale_mmPerN();
  int nearest = -1;
  double least = kGrip_px;
  for (std::size_t k = 0; k < forces.size(); ++k) {
    if (forces[k].hidden || !forces[k].movable || !(forces[k].force_N.norm() > 0)) continue;
    const Eigen::Vector3d end = forces[k].freeEnd_mm(scale);
    const double away = distance(place, placeOf(end), placeOf(0.5 * (end + forces[k].place_mm)));
    if (away >= least) continue;
    least = away;
    nearest = static_cast<int>(k);
  }
  return nearest;
}

Eigen::Vector3d BlockView::pointAt(const QPointF& place, const Eigen::Vector3d& anchor_mm) const {
  vtkRenderer& renderer = *parts_->scene.renderer();
  renderer.SetWorldPoint(anchor_mm.x(), anchor_mm.y(), anchor_mm.z(), 1);
  renderer.WorldToDisplay();
  const double depth = renderer.GetDisplayPoint()[2];
  const QPointF device = devicePlace(place);
  renderer.SetDisplayPoint(device.x(), device.y(), depth);
  renderer.DisplayToWorld();
  const double* point = renderer.GetWorldPoint();
  return Eigen::Vector3d(point[0], point[1], point[2]) / point[3];
}

std::optional<Eigen::Vector2d> BlockView::topPlace_mm(const QPointF& place) const {
  if (!parts_->design || renderCount() == 0) return {};
  vtkRenderer& renderer = *parts_->scene.renderer();
  const QPointF device = devicePlace(place);
  std::array<Eigen::Vector3d, 2> ends;
  for (std::size_t k = 0; k < 2; ++k) {
    renderer.SetDisplayPoint(device.x(), device.y(), static_cast<double>(k));
    renderer.DisplayToWorld();
    const double* point = renderer.GetWorldPoint();
    ends[k] = Eigen::Vector3d(point[0], point[1], point[2]) / point[3];
  }
  const Eigen::Vector3d way = ends[1] - ends[0];
  const double t = (parts_->design->block_mm.z() - ends[0].z()) / way.z();
  if (!(t >= 0 && t <= 1)) return {};
  return (ends[0] + t * way).head<2>();
}

QString BlockView::tipAt(const QPointF& place) const {
  if (renderCount() == 0) return {};
  QString words;
  double least = kGrip_px;
  for (const PlacedText& tip : parts_->scene.tips()) {
    const QPointF away = placeOf(tip.place_mm) - place;
    if (std::hypot(away.x(), away.y()) >= least) continue;
    least = std::hypot(away.x(), away.y());
    words = QString::fromStdString(tip.text);
  }
  return words;
}

void BlockView::showCursor(const QPointF& place) {
  if (!movable_ && handles_ == Movable::None && !cut_) return;
  Qt::CursorShape shape = Qt::ArrowCursor;
  const auto top = topPlace_mm(place), beside = topPlace_mm(place + QPointF(kGrip_px, 0));
  DiscHandle under;
  if (place.x() >= 0 && (cutAt(place) || (movable_ && arrowAt(place) >= 0)))
    shape = Qt::OpenHandCursor;
  else if (top && beside && under.take(handles(), *top, (*beside - *top).norm()))
    shape = under.sizes() ? Qt::SizeAllCursor : Qt::OpenHandCursor;
  setCursor(shape);
}

std::optional<QPointF> BlockView::cutGrip() const {
  if (!cut_ || !parts_->design) return {};
  return placeOf(cut_->grip_mm(parts_->design->block_mm));
}

bool BlockView::cutAt(const QPointF& place) const {
  const auto grip = renderCount() > 0 ? cutGrip() : std::nullopt;
  return grip && std::hypot(place.x() - grip->x(), place.y() - grip->y()) <= kCutGrip_px;
}

void BlockView::dragCut(const QPointF& place) {
  if (!cut_ || !parts_->design) return;
  // How far a millimetre along the axis goes in the view.
  const Eigen::Vector3d& block_mm = parts_->design->block_mm;
  CutPlane beside = *cut_;
  beside.at_mm += 1;
  const QPointF grip = placeOf(cut_->grip_mm(block_mm)), millimetre = placeOf(beside.grip_mm(block_mm)) - grip;
  const double length2 = QPointF::dotProduct(millimetre, millimetre);
  if (!(length2 > 1e-6)) return; // looked at along the axis
  const double way_mm = QPointF::dotProduct(place - grip, millimetre) / length2;
  const double at_mm = std::clamp(std::round(10 * (cut_->at_mm + way_mm)) / 10, 0.0, block_mm[cut_->axis]);
  if (at_mm == cut_->at_mm) return;
  cut_->at_mm = at_mm;
  emit cutDragged(at_mm);
}

bool BlockView::grab(const QPointF& place, Qt::KeyboardModifiers modifiers) {
  cutHeld_ = cutAt(place);
  wayOf_ = -1;
  if (cutHeld_) {
    dragged_ = -1;
    disc_.release();
    setCursor(Qt::ClosedHandCursor);
    return true;
  }
  dragged_ = movable_ ? arrowAt(place) : -1;
  disc_.release();
  const auto top = topPlace_mm(place), beside = topPlace_mm(place + QPointF(kGrip_px, 0));
  if (modifiers.testFlag(Qt::ControlModifier) && top && beginWay(*top)) {
    dragged_ = -1;
    setCursor(Qt::CrossCursor);
    return true;
  }
  if (dragged_ < 0 && !modifiers.testFlag(Qt::ShiftModifier) && top && beside)
    disc_.take(handles(), *top, (*beside - *top).norm());
  const bool grabbed = dragged_ >= 0 || disc_.disc() >= 0;
  if (grabbed) setCursor(Qt::ClosedHandCursor);
  return grabbed;
}

void BlockView::dragTo(const QPointF& place, Qt::KeyboardModifiers modifiers) {
  if (cutHeld_) {
    dragCut(place);
    return;
  }
  if (wayOf_ >= 0) {
    if (const auto top = topPlace_mm(place)) drawWay(*top);
    return;
  }
  if (disc_.disc() >= 0) {
    const auto top = topPlace_mm(place);
    if (!top) return;
    moveHandle(disc_.draggedTo(*top, parts_->design->block_mm, handles_ == Movable::Discs));
    invalidate();
    return;
  }
  // Another state may have come while the button was down.
  if (dragged_ < 0 || dragged_ >= static_cast<int>(parts_->scene.forces().size())) return;
  const PlacedForce& force = parts_->scene.forces()[static_cast<std::size_t>(dragged_)];
  const double scale = parts_->scene.arrowScale_mmPerN();
  const bool push = force.force_N.z() < 0;
  const Eigen::Vector3d arrow = pointAt(place, force.freeEnd_mm(scale)) - force.place_mm;
  Eigen::Vector3d next = (push ? -1 : 1) / scale * arrow;
  if (modifiers.testFlag(Qt::ShiftModifier)) { // the length alone
    const Eigen::Vector3d along = force.force_N.normalized();
    next = std::max(next.dot(along), 0.0) * along;
  }
  // A push stays a push: the arrow would jump to the other side of its place.
  next.z() = push ? std::min(next.z(), -kLeast_N) : std::max(next.z(), 0.0);
  for (double& component : next) component = std::round(component * kStepsANewton) / kStepsANewton;
  parts_->scene.moveForce(static_cast<std::size_t>(dragged_), next);
  invalidate();
}

bool BlockView::beginWay(const Eigen::Vector2d& at_mm) {
  if (handles_ != Movable::Indenters) return false;
  const std::vector<PatchLoad> all = handles();
  for (std::size_t k = all.size(); k-- > 0;)
    if ((at_mm - all[k].centre_mm).norm() <= all[k].radius_mm) {
      wayOf_ = static_cast<int>(k);
      const Motion* motion = parts_->scene.indenters()[k].motion();
      way_mm_ = all[k].centre_mm;
      if (motion != nullptr) way_mm_ += motion->shift_mm;
      return true;
    }
  return false;
}

void BlockView::drawWay(const Eigen::Vector2d& at_mm) {
  const Eigen::Vector2d next = at_mm.cwiseMax(0).cwiseMin(parts_->design->block_mm.head<2>());
  const Eigen::Index count = way_mm_.cols();
  if ((next - way_mm_.col(count - 1)).norm() < kWayStep_mm) return;
  way_mm_.conservativeResize(2, count + 1);
  way_mm_.col(count) = next;
  parts_->scene.showWay(way_mm_);
  invalidate();
}

void BlockView::moveHandle(const PatchLoad& to) {
  const auto k = static_cast<std::size_t>(disc_.disc());
  if (handles_ == Movable::Discs) return parts_->scene.moveDisc(k, to);
  if (k >= parts_->scene.indenters().size()) return;
  Indenter next = parts_->scene.indenters()[k];
  next.place_mm = to.centre_mm;
  if (next.shape != IndenterShape::Plane) next.radius_mm = std::max(to.radius_mm, next.rim_mm);
  parts_->scene.moveIndenter(k, next);
}

void BlockView::drop() {
  setCursor(Qt::OpenHandCursor);
  if (std::exchange(cutHeld_, false)) return;
  if (const int indenter = std::exchange(wayOf_, -1); indenter >= 0) {
    if (way_mm_.cols() > 1) emit wayDrawn(indenter, way_mm_);
    return;
  }
  if (disc_.disc() >= 0) {
    const auto disc = static_cast<std::size_t>(disc_.disc());
    disc_.release();
    const std::vector<PatchLoad> all = handles();
    if (disc >= all.size()) return; // another load may have come while the button was down
    if (handles_ == Movable::Discs)
      emit discDragged(static_cast<int>(disc), all[disc]);
    else if (disc_.sizes() && parts_->scene.indenters()[disc].shape != IndenterShape::Plane)
      emit indenterSized(static_cast<int>(disc), all[disc].radius_mm);
    else
      emit indenterMoved(static_cast<int>(disc), all[disc].centre_mm);
    return;
  }
  const int arrow = std::exchange(dragged_, -1);
  if (arrow < 0 || arrow >= static_cast<int>(parts_->scene.forces().size())) return;
  const PlacedForce force = parts_->scene.forces()[static_cast<std::size_t>(arrow)];
  emit forceDragged(force.load, force.force_N);
}

void BlockView::pick(const QPointF& place) {
  vtkNew<vtkCellPicker> picker;
  picker->SetTolerance(0.0005);
  const QPointF device = devicePlace(place);
  if (picker->Pick(device.x(), device.y(), 0, parts_->scene.renderer()) == 0) return;
  const Eigen::Vector3d drawn_mm(picker->GetPickPosition());
  const int node = parts_->scene.nearestNode(drawn_mm);
  if (node < 0) return;
  const Eigen::Vector3d rest_mm = parts_->scene.restPlace_mm(picker->GetCellId(), drawn_mm);
  emit nodeClicked(node);
  emit materialClicked(rest_mm);
}

} // namespace palp
