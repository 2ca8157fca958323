#include "app/scenes/block/DeformationPicture.h"

#include "app/scenes/block/CameraFit.h"
#include "app/scenes/block/ElectrodeActors.h"
#include "app/scenes/block/Overlay.h"
#include "app/scenes/block/Polylines.h"
#include "app/scenes/gl/OffscreenWindow.h"
#include "model/DesignError.h"
#include "model/base/NumberText.h"

#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <numeric>

namespace palp {

Picture drawDeformation(const DeformationState& state, const DeformationOptions& options, int width, int height) {
  DeformationScene scene;
  scene.show(state, options, true);
  scene.resetCamera(*state.design, static_cast<double>(width) / height, kFirstLook,
                    std::clamp(scene.legendRoom_px() / width, 0.02, 0.4));
  return drawOnce(scene.renderer(), width, height);
}

namespace {

std::vector<std::vector<int>> oneLine(int points) {
  std::vector<int> line(static_cast<std::size_t>(points));
  std::iota(line.begin(), line.end(), 0);
  return {line};
}

/// Each electrode's way from rest to its displaced place.
std::vector<std::vector<int>> ways(int electrodes) {
  std::vector<std::vector<int>> lines;
  for (int e = 0; e < electrodes; ++e) lines.push_back({e, electrodes + e});
  return lines;
}

std::vector<std::string> rowWireTitle(int rowWire, bool displaced, double factor) {
  const std::string second =
      "grey: at rest; colour: loaded, displacements drawn " + withDigits(factor, 6) + " times as large";
  const std::string wire = "Row-wire " + std::to_string(rowWire);
  return displaced ? std::vector<std::string>{wire + " under load", second}
                   : std::vector<std::string>{wire + " at rest"};
}

} // namespace

Picture drawRowWire(const SensorDesign& design, int rowWire, const ElectrodeDisplacements* displacements,
                    std::optional<double> deformationScale, int width, int height, Theme theme) {
  if (rowWire < 0 || rowWire >= design.rowWires())
    throw DesignError("row-wire " + std::to_string(rowWire) + ": expected 0 to " +
                      std::to_string(design.rowWires() - 1));
  const Palette& ink = palette(theme);
  const int count = design.electrodesPerRowWire();
  const Eigen::Matrix3Xd rest = design.upperElectrodes_mm().middleCols(rowWire * count, count);
  Eigen::Matrix3Xd moved = Eigen::Matrix3Xd::Zero(3, count);
  if (displacements != nullptr) moved = displacements->upper_mm.middleCols(rowWire * count, count);
  const double factor = deformationScale.value_or(automaticDeformationScale(design, moved));
  Eigen::Matrix3Xd both(3, 2 * count);
  both << rest, rest + factor * moved;

  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(ink.ground[0], ink.ground[1], ink.ground[2]);
  Polylines box(*renderer);
  box.set(boxCorners(design.block_mm), boxEdges());
  box.setLook(ink.text, 1.2, 0.6);
  Polylines restWire(*renderer);
  Spheres restSpheres(*renderer, 0.3);
  restWire.set(rest, oneLine(count));
  const Color faint{0.5, 0.52, 0.55};
  restWire.setLook(displacements != nullptr ? faint : ink.upper, 2);
  restSpheres.set(rest, displacements != nullptr ? faint : ink.upper);
  Polylines loadedWire(*renderer);
  Polylines way(*renderer);
  Spheres loadedSpheres(*renderer, 0.36);
  if (displacements != nullptr) {
    loadedWire.set(both.rightCols(count), oneLine(count));
    loadedWire.setLook(ink.upper, 2.5);
    loadedSpheres.set(both.rightCols(count), ink.upper);
    way.set(both, ways(count));
    way.setLook(ink.force, 2);
  }
  vtkNew<vtkContextActor> actor;
  vtkNew<Overlay> overlay;
  overlay->theme = theme;
  overlay->lines = rowWireTitle(rowWire, displacements != nullptr, factor);
  actor->GetScene()->AddItem(overlay);
  actor->GetScene()->SetRenderer(renderer);
  renderer->AddActor(actor);
  fitCamera(*renderer, boxCorners(design.block_mm), {0.15, 1.0, -0.38}, static_cast<double>(width) / height,
            {0.04, 0.04, 0.06, 0.14});
  return drawOnce(renderer, width, height);
}

} // namespace palp
