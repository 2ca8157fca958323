#include "app/scenes/block/DeformationScene.h"

#include "app/scenes/block/BlockActors.h"
#include "app/scenes/block/CameraFit.h"
#include "app/scenes/block/ElectrodeActors.h"
#include "app/scenes/block/Overlay.h"
#include "app/scenes/block/SceneWords.h"
#include "app/scenes/block/current/CurrentActor.h"
#include "app/scenes/block/loads/IndenterActors.h"
#include "app/scenes/block/map/FaceMap.h"
#include "app/scenes/block/marks/ExtremeMarks.h"
#include "app/scenes/gl/Blending.h"

#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace palp {

namespace {

constexpr double kWayAbove_mm = 0.15; ///< of an indenter's way over the face that it would lie in

/// Diverging where both signs mean something.
ColorMap colorMap(const DeformationOptions& options) {
  const Quantity quantity = options.quantity;
  if (options.lessReference) return ColorMap::Diverging;
  const bool ofOneSign = quantity == Quantity::Displacement || quantity == Quantity::VonMises ||
                         quantity == Quantity::LargestStretch || quantity == Quantity::MiddleStretch ||
                         quantity == Quantity::SmallestStretch || isOfContact(quantity);
  return ofOneSign ? ColorMap::Viridis : ColorMap::Diverging;
}

} // namespace

std::array<double, 2> quantityRange(const DeformationOptions& options, const std::vector<double>& values) {
  const ColorScale scale = fittingScale(options.colorMap.value_or(colorMap(options)), values, {}, {});
  return {scale.low, scale.high};
}

Eigen::Vector3d CutPlane::grip_mm(const Eigen::Vector3d& block_mm) const {
  Eigen::Vector3d place(0.5 * block_mm.x(), 0.5 * block_mm.y(), block_mm.z()); // on the top face
  if (axis == 2) place.y() = 0;                                                // on the front
  place[axis] = at_mm;
  return place;
}

double automaticDeformationScale(const SensorDesign& design, const Eigen::Matrix3Xd& displacement_mm) {
  if (displacement_mm.cols() == 0) return 1;
  const double largest_mm = displacement_mm.colwise().norm().maxCoeff();
  if (!(largest_mm > 0)) return 1;
  const double wanted = 0.2 * design.block_mm.minCoeff() / largest_mm;
  if (!(wanted > 1)) return 1;
  const double power = std::pow(10, std::floor(std::log10(wanted)));
  for (const double step : {5.0, 2.0})
    if (step * power <= wanted) return step * power;
  return power;
}

struct DeformationScene::Parts {
  vtkNew<vtkRenderer> renderer;
  BlockActors block{*renderer};
  CurrentActor current{*renderer};
  ElectrodeActors electrodes{*renderer};
  ForceArrows forces{*renderer};
  Spheres mark{*renderer, 0.3};
  vtkNew<vtkContextActor> overlayActor;
  vtkNew<Overlay> overlay;
  IndenterActors indenters{*renderer};
  FaceMapActor map{*renderer};
  Polylines line{*renderer};
  Polylines way{*renderer};
  Spheres wayPoints{*renderer, 0.25};
  Polylines cutRim{*renderer};
  Spheres cutGrip{*renderer, 0.45};
  Spheres extremes{*renderer, 0.3};
  std::vector<PlacedText> marks; ///< of the largest and the smallest value
  std::vector<PlacedForce> placed;
  std::vector<PatchLoad> discs;
  std::size_t areas = 0; ///< that are loaded: their arrows come first, then the discs', then the indenters'
  DeformationOptions drawnAs;
  double mmPerN = 1;
  Color forceColor{};
  Color textColor{};
  bool areaNumbers = true;
  double deformationScale = 1;
  std::array<double, 2> colorRange{};
  double top_mm = 0; ///< of the block
  int markedNode = -1;
  Color markColor{};

  /// Arrows and all words of the view: the forces, and the numbers of the areas where these are outlined.
  void showForces() {
    forces.showToScale(placed, mmPerN, forceColor);
    overlay->words = forces.words();
    overlay->words.insert(overlay->words.end(), marks.begin(), marks.end());
    if (!areaNumbers) return;
    for (const BlockActors::AreaLabel& label : block.areaLabels())
      overlay->words.push_back({label.place_mm, std::to_string(label.area), textColor});
  }
  void showLine(const DeformationOptions& options, const Color& color) {
    line.setVisible(options.line_mm.has_value());
    if (!options.line_mm) return;
    Eigen::Matrix3Xd ends(3, 2);
    ends << (*options.line_mm)[0], (*options.line_mm)[1];
    line.set(ends, {{0, 1}});
    line.setLook(color, 3 * options.scale);
  }
  void showWay(const Eigen::Matrix2Xd& way_mm) {
    const bool visible = way_mm.cols() > 1;
    way.setVisible(visible);
    wayPoints.setVisible(visible);
    if (!visible) return;
    Eigen::Matrix3Xd places(3, way_mm.cols());
    places.topRows<2>() = way_mm;
    places.row(2).setConstant(top_mm + kWayAbove_mm);
    std::vector<int> all(static_cast<std::size_t>(way_mm.cols()));
    std::iota(all.begin(), all.end(), 0);
    way.set(places, {all});
    way.setLook(palette(drawnAs.theme).selection, 2.5 * drawnAs.scale);
    wayPoints.set(places, palette(drawnAs.theme).selection);
  }
  void showCut(const Eigen::Vector3d& block_mm, const DeformationOptions& drawn, const Color& color) {
    const bool visible = drawn.cut && drawn.cutGrip;
    cutRim.setVisible(visible);
    cutGrip.setVisible(visible);
    if (!visible) return;
    const int axis = drawn.cut->axis, u = (axis + 1) % 3, v = (axis + 2) % 3;
    Eigen::Matrix3Xd rim = Eigen::Matrix3Xd::Zero(3, 4);
    rim.row(axis).setConstant(drawn.cut->at_mm);
    rim(u, 1) = rim(u, 2) = block_mm[u];
    rim(v, 2) = rim(v, 3) = block_mm[v];
    cutRim.set(rim, {{0, 1, 2, 3, 0}});
    cutRim.setLook(color, 1.5 * drawn.scale);
    cutGrip.set(drawn.cut->grip_mm(block_mm), color);
  }
  void showMark() {
    Eigen::Matrix3Xd place(3, markedNode < 0 ? 0 : 1);
    if (markedNode >= 0) place.col(0) = block.drawnPlace_mm(markedNode);
    mark.set(place, markColor);
    mark.setVisible(markedNode >= 0);
  }
};

DeformationScene::DeformationScene() : parts_(std::make_unique<Parts>()) {
  blendInOrder(*parts_->renderer);
  parts_->overlayActor->GetScene()->AddItem(parts_->overlay);
  parts_->overlayActor->GetScene()->SetRenderer(parts_->renderer);
  parts_->renderer->AddActor(parts_->overlayActor);
}

DeformationScene::~DeformationScene() = default;

vtkRenderer* DeformationScene::renderer() const {
  return parts_->renderer;
}

namespace {

/// A force on the plane itself, or rubbed off it by its touch, is of what stays.
bool cutAway(const std::optional<CutPlane>& cut, const Eigen::Vector3d& surface_mm) {
  constexpr double kBeside_mm = 0.2;
  return cut && !cut->keeps(surface_mm + kBeside_mm * cut->normal());
}

/// The loads at their drawn places on the top face.
std::vector<PlacedForce> placedForces(const DeformationState& state, const BlockActors& block,
                                      const std::optional<CutPlane>& cut) {
  std::vector<PlacedForce> forces;
  if (state.load == nullptr) return forces;
  const auto place = [&](const Eigen::Vector2d& xy_mm, const Eigen::Vector3d& force_N) {
    const Eigen::Vector3d surface = block.drawnPlace_mm(xy_mm);
    forces.push_back(
        {surface, force_N * std::min(state.loadFraction, 1.), static_cast<int>(forces.size()), cutAway(cut, surface)});
  };
  const auto onFace = [](const Eigen::Vector2d& xy_mm, const Eigen::Vector3d& block_mm) -> Eigen::Vector2d {
    return xy_mm.cwiseMax(0).cwiseMin(block_mm.head<2>());
  };
  for (const AreaLoad& load : state.load->areas) {
    const Rectangle box = state.design->areaRectangle(load.area);
    place(0.5 * (box.low_mm + box.high_mm), load.force_N);
  }
  for (const PatchLoad& patch : state.load->patches) place(patch.centre_mm, patch.force_N);
  for (std::size_t k = 0; k < state.load->indenters.size(); ++k) {
    const Indenter& indenter = state.load->indenters[k];
    // Of one that is moved the solve finds the force, of one that is pressed the load gives it.
    const Indenter sofar = indenter.at(std::min(state.loadFraction, 1.));
    const IndenterState now = k < state.indenters.size() ? state.indenters[k] : IndenterState{};
    const Eigen::Vector3d surface =
        block.drawnPlace_mm(onFace(indenter.place_mm + now.translation_mm.head<2>(), state.design->block_mm));
    PlacedForce& force = forces.emplace_back(
        PlacedForce{surface, sofar.press() != nullptr && state.loadFraction <= 1 ? sofar.press()->force_N : now.force_N,
                    static_cast<int>(forces.size()), cutAway(cut, surface)});
    force.movable = indenter.press() != nullptr && state.loadFraction <= 1; // the path's steps have forces of their own
  }
  return forces;
}

std::vector<double> shownValues(const DeformationState& state, const DeformationOptions& options) {
  if (nothingColoured(state, options)) return {};
  return options.lessReference ? quantityValues(options.quantity, *state.fields, *state.kept)
                               : quantityValues(options.quantity, *state.fields);
}

ColorScale colorScale(const std::vector<double>& values, const DeformationOptions& options) {
  ColorScale colors = fittingScale(options.colorMap.value_or(colorMap(options)), values,
                                   quantityName(options.quantity) + (!options.lessReference ? ""
                                                                     : options.lessUniform  ? " - uniform"
                                                                                            : " - reference"),
                                   quantityUnit(options.quantity));
  if (options.fixedRange) {
    colors.low = (*options.fixedRange)[0];
    colors.high = (*options.fixedRange)[1];
  }
  colors.ground = palette(options.theme).ground;
  colors.opacity = options.electrodes ? options.opacity : 1;
  return colors;
}

} // namespace

void DeformationScene::show(const DeformationState& state, const DeformationOptions& options, bool meshChanged) {
  Parts& parts = *parts_;
  const Palette& ink = palette(options.theme);
  parts.renderer->SetBackground(ink.ground[0], ink.ground[1], ink.ground[2]);
  if (meshChanged) {
    parts.block.setMesh(*state.design, *state.mesh);
    parts.markedNode = -1;
  }
  const Eigen::Matrix3Xd atRest = Eigen::Matrix3Xd::Zero(3, state.mesh->nodeCount());
  const Eigen::Matrix3Xd& displacement = state.fields != nullptr ? state.fields->displacement_mm : atRest;
  parts.deformationScale = options.deformationScale.value_or(automaticDeformationScale(*state.design, displacement));
  const Eigen::Matrix3Xd drawnDisplacement = parts.deformationScale * displacement;
  const std::vector<double> values = state.current != nullptr ? std::vector<double>() : shownValues(state, options);
  const ColorScale colors = state.current != nullptr ? currentColors(*state.current) : colorScale(values, options);
  const bool coloured = !values.empty() || (state.current != nullptr && !state.current->lines.empty());
  parts.map.show(state.map, state.design->block_mm);
  parts.colorRange = coloured ? std::array{colors.low, colors.high} : std::array<double, 2>{};
  parts.current.show(state.current, parts.deformationScale, colors, 2 * options.scale);
  parts.block.show(*state.mesh, drawnDisplacement, values, colors, options);

  const ElectrodeDisplacements rest = ElectrodeDisplacements::atRest(*state.design);
  const ElectrodeDisplacements& electrodes = state.electrodes != nullptr ? *state.electrodes : rest;
  const Eigen::Matrix3Xd& lower_mm = state.design->lowerFollowsRubber ? electrodes.lower_mm : rest.lower_mm;
  parts.electrodes.show(*state.design, parts.deformationScale * electrodes.upper_mm, parts.deformationScale * lower_mm,
                        options);
  parts.placed = options.forceArrows ? placedForces(state, parts.block, options.cut) : std::vector<PlacedForce>{};
  parts.discs = state.load != nullptr ? state.load->patches : std::vector<PatchLoad>{};
  parts.drawnAs = options;
  parts.areas = state.load != nullptr ? state.load->areas.size() : 0;
  parts.block.showDiscs(parts.discs, options);
  parts.indenters.show(state, parts.deformationScale);
  parts.mmPerN = palp::arrowScale_mmPerN(parts.placed, 0.3 * state.design->block_mm.maxCoeff());
  parts.marks = extremeMarks(values, parts.block.drawn_mm(), options);
  Eigen::Matrix3Xd extremes(3, static_cast<Eigen::Index>(parts.marks.size()));
  for (std::size_t k = 0; k < parts.marks.size(); ++k) {
    extremes.col(static_cast<Eigen::Index>(k)) = parts.marks[k].place_mm;
    parts.marks[k].place_mm.z() += 0.06 * state.design->block_mm.maxCoeff(); // the text next to its point
  }
  parts.extremes.set(extremes, ink.text);
  parts.extremes.setVisible(!parts.marks.empty());
  parts.showCut(state.design->block_mm, options, ink.selection);
  parts.forceColor = ink.force;
  parts.areaNumbers = options.areaOutlines;
  parts.textColor = ink.text;
  parts.showForces();
  parts.showLine(options, ink.selection);
  parts.top_mm = state.design->block_mm.z();
  parts.showWay(options.way_mm);
  parts.overlay->lines = sceneWords(state, options, parts.deformationScale);
  parts.overlay->legend = coloured ? std::optional(colors) : std::nullopt;
  if (state.map != nullptr) parts.overlay->legend = state.map->colors;
  parts.overlay->triad = true;
  parts.overlay->theme = options.theme;
  parts.overlay->scale = options.scale;
  parts.overlay->Modified();
  parts.markColor = ink.selection;
  parts.showMark();
}

void DeformationScene::resetCamera(const SensorDesign& design, double aspect) {
  resetCamera(design, aspect, kFirstLook);
}

void DeformationScene::resetCamera(const SensorDesign& design, double aspect, const Eigen::Vector3d& direction,
                                   std::optional<double> legendShare) {
  // Room above the middle for the arrows and their words.
  Eigen::Matrix3Xd points(3, 9);
  points << boxCorners(design.block_mm), 0.5 * design.block_mm;
  points(2, 8) = design.block_mm.z() + 0.3 * design.block_mm.maxCoeff();
  // Straight views fill the picture to its corners, where text and legend are drawn.
  const double more = direction.normalized().cwiseAbs().maxCoeff() > 1 - 1e-9 ? 0.07 : 0;
  fitCamera(*parts_->renderer, points, direction, aspect,
            {0.03, 0.03 + more + legendShare.value_or(std::min(0.12 / aspect * 1.5, 0.25)), 0.04, 0.08 + more});
}

double DeformationScene::legendRoom_px() const {
  const double scale = parts_->overlay->scale;
  return parts_->overlay->legend ? palp::legendRoom_px(*parts_->overlay->legend, scale) : kLegendRoom_px * scale;
}

void DeformationScene::setTextScale(double scale) {
  parts_->overlay->scale = scale;
  parts_->overlay->Modified();
}

double DeformationScene::deformationScale() const {
  return parts_->deformationScale;
}

std::array<double, 2> DeformationScene::colorRange() const {
  return parts_->colorRange;
}

int DeformationScene::nearestNode(const Eigen::Vector3d& drawn_mm) const {
  return parts_->block.nearestNode(drawn_mm);
}

std::vector<PlacedText> DeformationScene::tips() const {
  const Parts& parts = *parts_;
  std::vector<PlacedText> all = parts.electrodes.lit();
  if (parts.markedNode >= 0)
    all.push_back({parts.block.drawnPlace_mm(parts.markedNode), "the probed point", parts.markColor});
  return all;
}

const std::vector<PlacedForce>& DeformationScene::forces() const {
  return parts_->placed;
}

double DeformationScene::arrowScale_mmPerN() const {
  return parts_->mmPerN;
}

const std::vector<PatchLoad>& DeformationScene::discs() const {
  return parts_->discs;
}

void DeformationScene::moveDisc(std::size_t disc, const PatchLoad& to) {
  if (disc >= parts_->discs.size()) return;
  parts_->discs[disc] = to;
  parts_->block.showDiscs(parts_->discs, parts_->drawnAs);
  moveArrow(parts_->areas + disc, to.centre_mm);
}

const std::vector<Indenter>& DeformationScene::indenters() const {
  return parts_->indenters.indenters();
}

void DeformationScene::moveIndenter(std::size_t indenter, const Indenter& to) {
  if (indenter >= indenters().size()) return;
  parts_->indenters.move(indenter, to);
  moveArrow(parts_->areas + parts_->discs.size() + indenter, to.place_mm);
}

void DeformationScene::showWay(const Eigen::Matrix2Xd& way_mm) {
  parts_->showWay(way_mm);
}

void DeformationScene::moveArrow(std::size_t arrow, const Eigen::Vector2d& top_mm) {
  if (arrow < parts_->placed.size()) parts_->placed[arrow].place_mm = parts_->block.drawnPlace_mm(top_mm);
  parts_->showForces();
  parts_->overlay->Modified();
}

Eigen::Vector3d DeformationScene::restPlace_mm(long long triangle, const Eigen::Vector3d& drawn_mm) const {
  return parts_->block.restPlace_mm(triangle, drawn_mm);
}

void DeformationScene::moveForce(std::size_t arrow, const Eigen::Vector3d& force_N) {
  if (arrow >= parts_->placed.size()) return;
  parts_->placed[arrow].force_N = force_N;
  parts_->showForces();
  parts_->overlay->Modified();
}

void DeformationScene::markNode(int node) {
  parts_->markedNode = node;
  parts_->showMark();
}

} // namespace palp
