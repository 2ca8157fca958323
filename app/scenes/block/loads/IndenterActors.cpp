#include "app/scenes/block/loads/IndenterActors.h"

#include <vtkCellArray.h>
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

constexpr int kArcSteps = 16;
constexpr int kTurnSteps = 48;
constexpr double kTallestShare = 0.3; ///< of the block's longest side
constexpr double kSeenThrough = 0.35;
constexpr Color kSteel{0.58, 0.62, 0.68}; ///< on light and on dark ground

/// Half a section through the axis, from the tip upwards: distance from the axis and height.
std::vector<Eigen::Vector2d> profile(const Indenter& indenter, double tallest_mm) {
  const bool flat = indenter.shape == IndenterShape::Flat;
  const double round = flat ? indenter.rim_mm : indenter.radius_mm, straight = flat ? indenter.radius_mm - round : 0;
  const bool shaft = flat || indenter.shape == IndenterShape::Pin;
  const double height = shaft ? tallest_mm : std::min(tallest_mm, 2 * round);
  const double arc = shaft ? 0.5 * std::numbers::pi : std::numbers::pi;
  const double end = height >= round * (1 - std::cos(arc)) ? arc : std::acos(1 - height / round);
  std::vector<Eigen::Vector2d> points{{0, 0}};
  for (int k = 0; k <= kArcSteps; ++k) {
    const double angle = end * k / kArcSteps;
    points.emplace_back(straight + round * std::sin(angle), round * (1 - std::cos(angle)));
  }
  if (shaft && points.back().y() < height) points.emplace_back(indenter.radius_mm, height);
  return points;
}

/// Rows of points with quadrilaterals between neighbours.
void addSheet(const std::vector<std::vector<Eigen::Vector3d>>& rows, vtkPoints& points, vtkCellArray& faces) {
  const vtkIdType first = points.GetNumberOfPoints();
  const auto across = static_cast<vtkIdType>(rows.front().size());
  for (const std::vector<Eigen::Vector3d>& row : rows)
    for (const Eigen::Vector3d& point : row) points.InsertNextPoint(point.data());
  for (vtkIdType r = 0; r + 1 < static_cast<vtkIdType>(rows.size()); ++r)
    for (vtkIdType c = 0; c + 1 < across; ++c) {
      const vtkIdType corner = first + r * across + c;
      faces.InsertNextCell({corner, corner + 1, corner + across + 1, corner + across});
    }
}

/// The surface of an indenter whose tip is drawn at a place.
void addIndenter(const Indenter& indenter, const Eigen::Vector3d& tip_mm, const Eigen::Vector3d& block_mm,
                 vtkPoints& points, vtkCellArray& faces) {
  std::vector<std::vector<Eigen::Vector3d>> rows;
  const double longest = block_mm.maxCoeff();
  if (indenter.shape == IndenterShape::Plane) {
    const Eigen::Vector2d reach = 0.55 * block_mm.head<2>(), middle = 0.5 * block_mm.head<2>();
    for (const double x : {-1.0, 1.0})
      rows.push_back({{middle.x() + x * reach.x(), middle.y() - reach.y(), tip_mm.z()},
                      {middle.x() + x * reach.x(), middle.y() + reach.y(), tip_mm.z()}});
    return addSheet(rows, points, faces);
  }
  const std::vector<Eigen::Vector2d> half = profile(indenter, kTallestShare * longest);
  const bool lies = indenter.shape == IndenterShape::CylinderX || indenter.shape == IndenterShape::CylinderY;
  if (lies) {
    const int along = indenter.shape == IndenterShape::CylinderX ? 0 : 1, across = 1 - along;
    for (const double side : {-1.0, 1.0}) {
      rows.clear();
      for (const Eigen::Vector2d& point : half) {
        std::vector<Eigen::Vector3d>& row = rows.emplace_back();
        for (const double end : {-0.05, 1.05}) {
          Eigen::Vector3d place = tip_mm + Eigen::Vector3d(0, 0, point.y());
          place[along] = end * block_mm[along];
          place[across] += side * point.x();
          row.push_back(place);
        }
      }
      addSheet(rows, points, faces);
    }
    return;
  }
  for (const Eigen::Vector2d& point : half) {
    std::vector<Eigen::Vector3d>& row = rows.emplace_back();
    for (int k = 0; k <= kTurnSteps; ++k) {
      const double angle = 2 * std::numbers::pi * k / kTurnSteps;
      row.emplace_back(tip_mm + Eigen::Vector3d(point.x() * std::cos(angle), point.x() * std::sin(angle), point.y()));
    }
  }
  addSheet(rows, points, faces);
}

} // namespace

IndenterActors::IndenterActors(vtkRenderer& renderer)
    : data_(vtkSmartPointer<vtkPolyData>::New()), actor_(vtkSmartPointer<vtkActor>::New()) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data_);
  mapper->ScalarVisibilityOff();
  actor_->SetMapper(mapper);
  actor_->GetProperty()->SetOpacity(kSeenThrough);
  actor_->GetProperty()->SetColor(kSteel[0], kSteel[1], kSteel[2]);
  actor_->PickableOff(); // the block behind it is what one clicks on
  actor_->VisibilityOff();
  renderer.AddActor(actor_);
}

void IndenterActors::show(const DeformationState& state, double warp) {
  indenters_ = state.load != nullptr ? state.load->indenters : std::vector<Indenter>{};
  actor_->SetVisibility(indenters_.empty() ? 0 : 1);
  if (indenters_.empty()) return;
  block_mm_ = state.design->block_mm;
  shifts_mm_.assign(indenters_.size(), Eigen::Vector3d::Zero());
  for (std::size_t k = 0; k < std::min(indenters_.size(), state.indenters.size()); ++k)
    shifts_mm_[k] = warp * state.indenters[k].translation_mm;
  draw();
}

void IndenterActors::move(std::size_t indenter, const Indenter& to) {
  indenters_[indenter] = to;
  draw();
}

void IndenterActors::draw() {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> faces;
  for (std::size_t k = 0; k < indenters_.size(); ++k) {
    const Eigen::Vector2d& place = indenters_[k].place_mm;
    addIndenter(indenters_[k], shifts_mm_[k] + Eigen::Vector3d(place.x(), place.y(), block_mm_.z()), block_mm_, *points,
                *faces);
  }
  data_->SetPoints(points);
  data_->SetPolys(faces);
  data_->Modified();
}

} // namespace palp
