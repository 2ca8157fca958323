#include "app/scenes/block/LiveScene.h"

#include "app/scenes/block/CameraFit.h"
#include "app/scenes/block/ElectrodeActors.h"
#include "app/scenes/block/Overlay.h"
#include "app/scenes/block/Polylines.h"
#include "app/scenes/block/loads/ForceArrows.h"
#include "app/scenes/gl/Blending.h"
#include "model/base/NumberText.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkCubeSource.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp {

namespace {

constexpr Color kStale{0.55, 0.55, 0.55};
constexpr double kLeastEllipse_mm = 0.35;
constexpr int kEllipsePoints = 32;
constexpr double kTruth_mm = 0.8;       // radius of the circle around a true place
constexpr double kCircleLift_mm = 0.03; // above the top face, so that the two do not flicker

Eigen::Vector3d onTop(const SensorDesign& design, double x_mm, double y_mm) {
  return {x_mm, y_mm, design.block_mm.z() + kCircleLift_mm};
}

Eigen::Matrix3Xd corners(const SensorDesign& design, int area) {
  const Rectangle box = design.areaRectangle(area);
  Eigen::Matrix3Xd points(3, 4);
  points << onTop(design, box.low_mm.x(), box.low_mm.y()), onTop(design, box.high_mm.x(), box.low_mm.y()),
      onTop(design, box.high_mm.x(), box.high_mm.y()), onTop(design, box.low_mm.x(), box.high_mm.y());
  return points;
}

/// Where the place lies to three deviations, drawn no smaller than what can be seen; on the face.
Eigen::Matrix3Xd ellipse(const SensorDesign& design, const LiveArrow& arrow) {
  const Eigen::Array2d half_mm = (3 * arrow.deviation_mm.array()).max(kLeastEllipse_mm);
  Eigen::Matrix3Xd points(3, kEllipsePoints);
  for (Eigen::Index k = 0; k < kEllipsePoints; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / kEllipsePoints;
    const Eigen::Array2d at = (arrow.place_mm->array() + half_mm * Eigen::Array2d(std::cos(angle), std::sin(angle)))
                                  .max(0)
                                  .min(design.block_mm.head<2>().array());
    points.col(k) = onTop(design, at.x(), at.y());
  }
  return points;
}

Eigen::Vector3d middle(const SensorDesign& design, int area) {
  const Rectangle box = design.areaRectangle(area);
  const Eigen::Vector2d centre = 0.5 * (box.low_mm + box.high_mm);
  return onTop(design, centre.x(), centre.y());
}

/// "Fz -4.20 N"
std::string measuredWords(const LiveArrow& arrow) {
  std::string all;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!arrow.measured[axis]) continue;
    all += std::string(all.empty() ? "" : ", ") + "F" + "xyz"[axis] + " " +
           withDecimals(arrow.force_N(static_cast<Eigen::Index>(axis)), 2) + " N";
  }
  return all;
}

} // namespace

struct LiveScene::Parts {
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkCubeSource> box;
  vtkNew<vtkActor> block;
  vtkNew<vtkPolyData> touchedData;
  vtkNew<vtkActor> touched; ///< the pressed areas and places, tinted
  Polylines edges{*renderer};
  Polylines borders{*renderer};
  Polylines truth{*renderer};
  ElectrodeActors electrodes{*renderer};
  ForceArrows forces{*renderer};
  vtkNew<vtkContextActor> overlayActor;
  vtkNew<Overlay> overlay;
  SensorDesign design;
  LiveSceneOptions options;
  std::vector<LiveArrow> arrows;
  std::optional<Eigen::Vector2d> truth_mm;
  bool stale = false;

  void showTruth(const Color& color);
  void tintAreas(const Color& color);
  [[nodiscard]] std::vector<PlacedText> wordsOfForces() const;
};

/// Of the arrows; where the network does not give all components, those alone that it gives.
std::vector<PlacedText> LiveScene::Parts::wordsOfForces() const {
  std::vector<PlacedText> words = forces.words();
  std::size_t word = 0;
  for (const LiveArrow& arrow : arrows) {
    if (!(arrow.force_N.norm() > 0) || word == words.size()) continue;
    if (arrow.measured != std::array{true, true, true}) words[word].text = measuredWords(arrow);
    ++word;
  }
  return words;
}

void LiveScene::Parts::tintAreas(const Color& color) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> faces;
  for (const LiveArrow& arrow : arrows) {
    const Eigen::Matrix3Xd rim = arrow.place_mm ? ellipse(design, arrow) : corners(design, arrow.area);
    faces->InsertNextCell(rim.cols());
    for (const auto corner : rim.colwise()) faces->InsertCellPoint(points->InsertNextPoint(corner.data()));
  }
  touchedData->SetPoints(points);
  touchedData->SetPolys(faces);
  touchedData->Modified();
  touched->SetVisibility(arrows.empty() ? 0 : 1);
  touched->GetProperty()->SetColor(color[0], color[1], color[2]);
}

void LiveScene::Parts::showTruth(const Color& color) {
  truth.setVisible(truth_mm.has_value());
  if (!truth_mm) return;
  Eigen::Matrix3Xd points(3, kEllipsePoints + 4);
  std::vector<int> rim;
  for (int k = 0; k < kEllipsePoints; ++k) {
    const double angle = 2 * std::numbers::pi * k / kEllipsePoints;
    points.col(k) =
        onTop(design, truth_mm->x() + kTruth_mm * std::cos(angle), truth_mm->y() + kTruth_mm * std::sin(angle));
    rim.push_back(k);
  }
  rim.push_back(0);
  for (int k = 0; k < 4; ++k) {
    const double angle = 0.5 * std::numbers::pi * k;
    points.col(kEllipsePoints + k) = onTop(design, truth_mm->x() + 1.5 * kTruth_mm * std::cos(angle),
                                           truth_mm->y() + 1.5 * kTruth_mm * std::sin(angle));
  }
  truth.set(points, {rim, {kEllipsePoints, kEllipsePoints + 2}, {kEllipsePoints + 1, kEllipsePoints + 3}});
  truth.setLook(color, 2 * options.scale);
}

LiveScene::LiveScene() : parts_(std::make_unique<Parts>()) {
  Parts& parts = *parts_;
  blendInOrder(*parts.renderer);
  vtkNew<vtkPolyDataMapper> blockMapper;
  blockMapper->SetInputConnection(parts.box->GetOutputPort());
  parts.block->SetMapper(blockMapper);
  parts.block->GetProperty()->SetOpacity(0.09);
  vtkNew<vtkPolyDataMapper> touchedMapper;
  touchedMapper->SetInputData(parts.touchedData);
  parts.touched->SetMapper(touchedMapper);
  parts.touched->GetProperty()->SetOpacity(0.35);
  parts.touched->GetProperty()->LightingOff();
  parts.touched->SetVisibility(0);
  for (vtkActor* actor : {parts.block.Get(), parts.touched.Get()}) {
    actor->PickableOff();
    parts.renderer->AddActor(actor);
  }
  parts.overlayActor->GetScene()->AddItem(parts.overlay);
  parts.overlayActor->GetScene()->SetRenderer(parts.renderer);
  parts.renderer->AddActor(parts.overlayActor);
}

LiveScene::~LiveScene() = default;

vtkRenderer* LiveScene::renderer() const {
  return parts_->renderer;
}

void LiveScene::showSensor(const SensorDesign& design, const LiveSceneOptions& options) {
  Parts& parts = *parts_;
  parts.design = design;
  parts.options = options;
  const Palette& ink = palette(options.theme);
  parts.renderer->SetBackground(ink.ground[0], ink.ground[1], ink.ground[2]);
  const Eigen::Vector3d& size = design.block_mm;
  parts.box->SetBounds(0, size.x(), 0, size.y(), 0, size.z());
  parts.block->GetProperty()->SetColor(ink.text[0], ink.text[1], ink.text[2]);
  parts.edges.set(boxCorners(size), boxEdges());
  parts.edges.setLook(ink.text, 1.2 * options.scale, 0.6);
  Eigen::Matrix3Xd points(3, 4 * design.areas.count());
  std::vector<std::vector<int>> lines;
  for (int area = 0; area < design.areas.count(); ++area) {
    points.middleCols<4>(4 * area) = corners(design, area);
    const int first = 4 * area;
    lines.push_back({first, first + 1, first + 2, first + 3, first});
  }
  parts.borders.set(points, lines);
  parts.borders.setLook(ink.text, 1.6 * options.scale);
  DeformationOptions look;
  look.electrodes = options.electrodes;
  look.theme = options.theme;
  look.scale = options.scale;
  const ElectrodeDisplacements rest = ElectrodeDisplacements::atRest(design);
  parts.electrodes.show(design, rest.upper_mm, rest.lower_mm, look);
  std::erase_if(parts.arrows, [&](const LiveArrow& arrow) { return arrow.area >= design.areas.count(); });
  showForces(parts.arrows, parts.stale, parts.overlay->lines, parts.truth_mm);
}

void LiveScene::showForces(const std::vector<LiveArrow>& arrows, bool stale, const std::vector<std::string>& lines,
                           const std::optional<Eigen::Vector2d>& truth_mm) {
  Parts& parts = *parts_;
  parts.arrows = arrows;
  parts.stale = stale;
  const Palette& ink = palette(parts.options.theme);
  const Color& color = stale ? kStale : ink.force;
  std::vector<PlacedForce> forces;
  for (const LiveArrow& arrow : parts.arrows) {
    PlacedForce& force = forces.emplace_back();
    force.place_mm = arrow.place_mm ? onTop(parts.design, arrow.place_mm->x(), arrow.place_mm->y())
                                    : middle(parts.design, arrow.area);
    force.force_N = arrow.force_N;
  }
  parts.forces.showToScale(forces, parts.options.mm_per_N, color, true);
  parts.tintAreas(color);
  parts.truth_mm = truth_mm;
  parts.showTruth(ink.selection);
  parts.overlay->words.clear();
  for (int area = 0; area < parts.design.areas.count(); ++area)
    parts.overlay->words.push_back({middle(parts.design, area), std::to_string(area), ink.text});
  const std::vector<PlacedText> words = parts.wordsOfForces();
  parts.overlay->words.insert(parts.overlay->words.end(), words.begin(), words.end());
  parts.overlay->lines = lines;
  parts.overlay->theme = parts.options.theme;
  parts.overlay->scale = parts.options.textScale;
  parts.overlay->Modified();
}

std::optional<Eigen::Vector2d> LiveScene::topPlace(double x_px, double y_px) const {
  vtkRenderer& renderer = *parts_->renderer;
  const auto worldAt = [&](double depth) {
    renderer.SetDisplayPoint(x_px, y_px, depth);
    renderer.DisplayToWorld();
    const Eigen::Vector4d point(renderer.GetWorldPoint());
    return Eigen::Vector3d(point.head<3>() / point.w());
  };
  const Eigen::Vector3d near = worldAt(0), along = worldAt(1) - near;
  const double share = (parts_->design.block_mm.z() - near.z()) / along.z();
  if (!std::isfinite(share) || share < 0) return {};
  return Eigen::Vector2d((near + share * along).head<2>());
}

void LiveScene::resetCamera(double aspect, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d& size = parts_->design.block_mm;
  Eigen::Matrix3Xd points(3, 12);
  points << boxCorners(size), boxCorners(size).rightCols<4>();
  points.rightCols<4>().row(2).setConstant(size.z() + 0.4 * size.maxCoeff()); // room for the arrows
  fitCamera(*parts_->renderer, points, direction, aspect, {0.04, 0.04, 0.05, 0.10});
}

} // namespace palp
