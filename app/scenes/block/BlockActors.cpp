#include "app/scenes/block/BlockActors.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <Eigen/Dense>

#include <algorithm>
#include <numbers>
#include <numeric>

namespace palp {

namespace {

constexpr int kBorderSteps = 24;
constexpr int kRimSteps = 48;
constexpr double kLift_mm = 0.03; ///< keeps outlines out of the surface that they lie on
constexpr Color kRestOnLight{0.80, 0.82, 0.85};
constexpr Color kRestOnDark{0.42, 0.45, 0.50};

/// Closed borders as points and lines for Polylines.
struct Outline {
  Eigen::Matrix3Xd points_mm;
  std::vector<std::vector<int>> lines;
};

template <class Chosen>
Outline outline(const std::vector<std::vector<TopPoint>>& borders, const Eigen::Matrix3Xd& places_mm, Chosen chosen) {
  std::vector<Eigen::Vector3d> points;
  Outline result;
  for (std::size_t area = 0; area < borders.size(); ++area) {
    if (!chosen(static_cast<int>(area))) continue;
    std::vector<int> line;
    for (const TopPoint& point : borders[area]) {
      line.push_back(static_cast<int>(points.size()));
      points.emplace_back(point.of(places_mm) + Eigen::Vector3d(0, 0, kLift_mm));
    }
    result.lines.push_back(std::move(line));
  }
  result.points_mm.resize(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) result.points_mm.col(static_cast<Eigen::Index>(k)) = points[k];
  return result;
}

} // namespace

BlockActors::BlockActors(vtkRenderer& renderer)
    : surfaceData_(vtkSmartPointer<vtkPolyData>::New()), surfaceMapper_(vtkSmartPointer<vtkPolyDataMapper>::New()),
      surfaceActor_(vtkSmartPointer<vtkActor>::New()), plane_(vtkSmartPointer<vtkPlane>::New()), cut_(renderer),
      edges_(renderer), ghost_(renderer), borders_(renderer), selected_(renderer), discs_(renderer) {
  surfaceMapper_->SetInputData(surfaceData_);
  surfaceMapper_->InterpolateScalarsBeforeMappingOn();
  surfaceActor_->SetMapper(surfaceMapper_);
  surfaceActor_->GetProperty()->SetAmbient(0.35);
  surfaceActor_->GetProperty()->SetDiffuse(0.7);
  // The far side hidden, one layer of the near side remains: it blends rightly without depth peeling.
  surfaceActor_->GetProperty()->BackfaceCullingOn();
  renderer.AddActor(surfaceActor_);
}

void BlockActors::setMesh(const SensorDesign& design, const Mesh& mesh) {
  surface_ = meshSurface(mesh);
  const TopFace& top = top_.emplace(mesh);
  areaBorders_ = areaBorders(top, design, kBorderSteps);
  areaLabels_.clear();
  for (int area = 0; area < design.areas.count(); ++area) {
    const Rectangle box = design.areaRectangle(area);
    areaLabels_.push_back(top.at(box.low_mm + Eigen::Vector2d(0.5, 0.2).cwiseProduct(box.high_mm - box.low_mm)));
  }
  vtkNew<vtkCellArray> triangles;
  for (const std::array<int, 3>& triangle : surface_.triangles) {
    triangles->InsertNextCell(3);
    for (const int point : triangle) triangles->InsertCellPoint(point);
  }
  surfaceData_->SetPolys(triangles);
  edges_.set(Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(surface_.nodes.size())), surface_.edges);
  cut_.setMesh(mesh);
  ghost_.set(boxCorners(design.block_mm), boxEdges());
}

void BlockActors::show(const Mesh& mesh, const Eigen::Matrix3Xd& drawnDisplacement_mm,
                       const std::vector<double>& values, const ColorScale& colors, const DeformationOptions& options) {
  const Palette& ink = palette(options.theme);
  rest_mm_ = mesh.nodes_mm;
  drawn_mm_ = mesh.nodes_mm + drawnDisplacement_mm;
  const auto count = static_cast<Eigen::Index>(surface_.nodes.size());
  Eigen::Matrix3Xd places_mm(3, count);
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> scalars;
  points->SetNumberOfPoints(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const int node = surface_.nodes[static_cast<std::size_t>(k)];
    places_mm.col(k) = drawn_mm_.col(node);
    points->SetPoint(k, places_mm.col(k).data());
    if (!values.empty()) scalars->InsertNextValue(static_cast<float>(values[static_cast<std::size_t>(node)]));
  }
  surfaceData_->SetPoints(points);
  surfaceData_->GetPointData()->SetScalars(values.empty() ? nullptr : scalars.Get());
  surfaceData_->Modified();
  surfaceMapper_->SetScalarVisibility(values.empty() ? 0 : 1);
  surfaceMapper_->SetLookupTable(lookupTable(colors));
  surfaceMapper_->UseLookupTableScalarRangeOn();
  const Color& rest = options.theme == Theme::Light ? kRestOnLight : kRestOnDark;
  surfaceActor_->GetProperty()->SetColor(rest[0], rest[1], rest[2]);
  surfaceActor_->GetProperty()->SetOpacity(options.electrodes ? (values.empty() ? 0.35 : options.opacity) : 1);

  cutPlane_ = options.cut;
  // Unlit, so that each colour is the legend's; what has no colours is lit as a body.
  surfaceActor_->GetProperty()->SetAmbient(values.empty() ? 0.35 : 1);
  surfaceActor_->GetProperty()->SetDiffuse(values.empty() ? 0.7 : 0);
  surfaceMapper_->RemoveAllClippingPlanes();
  if (options.cut) {
    const Eigen::Vector3d origin = options.cut->at_mm * Eigen::Vector3d::Unit(options.cut->axis);
    plane_->SetOrigin(origin.x(), origin.y(), origin.z());
    plane_->SetNormal(options.cut->normal().data());
    surfaceMapper_->AddClippingPlane(plane_);
    cut_.show(drawn_mm_, values, colors, rest, surfaceActor_->GetProperty()->GetOpacity(), plane_);
  } else {
    cut_.hide();
  }
  for (Polylines* lines : {&edges_, &borders_, &selected_, &discs_}) lines->clip(options.cut ? plane_.Get() : nullptr);

  edges_.move(places_mm);
  edges_.setLook({0.05, 0.06, 0.08}, options.scale, options.theme == Theme::Light ? 0.20 : 0.35);
  edges_.setVisible(options.meshEdges);
  ghost_.setLook(ink.text, 1.4 * options.scale, 0.55);
  ghost_.setVisible(options.undeformedGhost);
  const Outline all = outline(areaBorders_, drawn_mm_, [](int) { return true; });
  borders_.set(all.points_mm, all.lines);
  borders_.setLook(ink.text, 1.6 * options.scale);
  borders_.setVisible(options.areaOutlines);
  const Outline chosen = outline(areaBorders_, drawn_mm_, [&](int area) {
    return std::count(options.selectedAreas.begin(), options.selectedAreas.end(), area) > 0;
  });
  selected_.set(chosen.points_mm, chosen.lines);
  selected_.setLook(ink.force, 3.5 * options.scale);
}

void BlockActors::showDiscs(const std::vector<PatchLoad>& discs, const DeformationOptions& options) {
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(discs.size()) * (kRimSteps + 1));
  std::vector<std::vector<int>> rims;
  for (const PatchLoad& disc : discs) {
    std::vector<int>& rim = rims.emplace_back(kRimSteps + 1);
    std::iota(rim.begin(), rim.end(), static_cast<int>(rims.size() - 1) * (kRimSteps + 1));
    for (int k = 0; k <= kRimSteps; ++k) {
      const double angle = 2 * std::numbers::pi * k / kRimSteps;
      const Eigen::Vector2d place = disc.centre_mm + disc.radius_mm * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      points.col(rim[static_cast<std::size_t>(k)]) = drawnPlace_mm(place) + Eigen::Vector3d(0, 0, kLift_mm);
    }
  }
  discs_.set(points, rims);
  discs_.setLook(palette(options.theme).force, 3.5 * options.scale);
  discs_.setVisible(!discs.empty());
}

Eigen::Vector3d BlockActors::drawnPlace_mm(const Eigen::Vector2d& top_mm) const {
  return top_->at(top_mm).of(drawn_mm_);
}

Eigen::Vector3d BlockActors::restPlace_mm(vtkIdType triangle, const Eigen::Vector3d& drawn_mm) const {
  const std::array<int, 3>& points = surface_.triangles[static_cast<std::size_t>(triangle)];
  Eigen::Matrix3d now, rest;
  for (std::size_t k = 0; k < 3; ++k) {
    const int node = surface_.nodes[static_cast<std::size_t>(points[k])];
    now.col(static_cast<Eigen::Index>(k)) = drawn_mm_.col(node);
    rest.col(static_cast<Eigen::Index>(k)) = rest_mm_.col(node);
  }
  // The same shares of the triangle's sides.
  Eigen::Matrix<double, 3, 2> sides;
  sides << now.col(1) - now.col(0), now.col(2) - now.col(0);
  const Eigen::Vector2d shares = sides.colPivHouseholderQr().solve(drawn_mm - now.col(0));
  return rest.col(0) + shares.x() * (rest.col(1) - rest.col(0)) + shares.y() * (rest.col(2) - rest.col(0));
}

std::vector<BlockActors::AreaLabel> BlockActors::areaLabels() const {
  std::vector<AreaLabel> labels;
  for (std::size_t area = 0; area < areaLabels_.size(); ++area) {
    const Eigen::Vector3d place = areaLabels_[area].of(drawn_mm_);
    if (!cutPlane_ || cutPlane_->keeps(place)) labels.push_back({static_cast<int>(area), place});
  }
  return labels;
}

int BlockActors::nearestNode(const Eigen::Vector3d& drawn_mm) const {
  if (surface_.nodes.empty()) return -1;
  return *std::min_element(surface_.nodes.begin(), surface_.nodes.end(), [&](int a, int b) {
    return (drawn_mm_.col(a) - drawn_mm).squaredNorm() < (drawn_mm_.col(b) - drawn_mm).squaredNorm();
  });
}

Eigen::Vector3d BlockActors::drawnPlace_mm(int node) const {
  return drawn_mm_.col(node);
}

} // namespace palp
