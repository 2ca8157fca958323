#include "app/gui/BlockView.h"

#include <vtkCamera.h>
#include <vtkCellPicker.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

namespace palp {

struct BlockView::Parts {
  DeformationScene scene;
  std::optional<SensorDesign> design; ///< of the last state; none before the first
};

BlockView::BlockView(QWidget* parent) : BlockView(std::make_unique<Parts>(), parent) {}

BlockView::BlockView(std::unique_ptr<Parts> parts, QWidget* parent)
    : VtkView(parts->scene.renderer(), nullptr, parent), parts_(std::move(parts)) {
  connect(this, &VtkView::clicked, this, &BlockView::pick);
  connect(this, &VtkView::doubleClicked, this, &BlockView::resetCamera);
  connect(this, &VtkView::sizeChanged, this, [this] {
    if (renderCount() == 0) resetCamera();
  });
}

BlockView::~BlockView() = default;

void BlockView::show(const DeformationState& state, const DeformationOptions& options, bool meshChanged) {
  parts_->scene.show(state, options, meshChanged);
  const bool other = !parts_->design || parts_->design->block_mm != state.design->block_mm;
  parts_->design = *state.design;
  if (other) resetCamera();
  invalidate();
}

void BlockView::setTheme(Theme theme) {
  const Color& ground = palp::palette(theme).ground;
  parts_->scene.renderer()->SetBackground(ground[0], ground[1], ground[2]);
  invalidate();
}

void BlockView::resetCamera() {
  if (!parts_->design) return;
  parts_->scene.resetCamera(*parts_->design, aspect());
  invalidate();
}

void BlockView::lookAlong(const Eigen::Vector3d& direction) {
  if (!parts_->design) return;
  parts_->scene.resetCamera(*parts_->design, aspect(), direction);
  invalidate();
}

double BlockView::warpFactor() const {
  return parts_->scene.warpFactor();
}

std::array<double, 3> BlockView::cameraPosition() const {
  std::array<double, 3> place{};
  parts_->scene.renderer()->GetActiveCamera()->GetPosition(place.data());
  return place;
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

void BlockView::pick(const QPointF& place) {
  vtkNew<vtkCellPicker> picker;
  picker->SetTolerance(0.0005);
  const QPointF device = devicePlace(place);
  if (picker->Pick(device.x(), device.y(), 0, parts_->scene.renderer()) == 0) return;
  const int node = parts_->scene.nearestNode(Eigen::Vector3d(picker->GetPickPosition()));
  if (node >= 0) emit nodeClicked(node);
}

} // namespace palp
