#include "solver/contact/ContactPoints.h"

#include "solver/contact/ContactEstimate.h"
#include "solver/contact/ContactSteps.h"

#include <Eigen/Dense>

#include <algorithm>
#include <map>

namespace palp {

namespace {

constexpr int placesOnTheWay = 16; // of a tangential motion

double areaOfFace(const Mesh& mesh, Eigen::Index f, int a, int b, int c) {
  const auto at = [&](int n) { return Eigen::Vector3d(mesh.nodes_mm.col(mesh.topFaces(n, f))); };
  return (at(b) - at(a)).cross(at(c) - at(a)).norm() / 2;
}

/// Depth [mm] in the undeformed body at which an indenter's candidate points are found. A ball or cylinder pressed
/// deeper than its radius has its full width there, because it has passed through it.
double depthOfSearch(const Indenter& indenter, double expected_mm, double margin) {
  const double deep_mm = margin * expected_mm, radius_mm = indenter.radius_mm;
  if (!isRound(indenter)) return deep_mm;
  return std::min(deep_mm, expected_mm > radius_mm ? radius_mm : std::max(radius_mm, touchableMargin * expected_mm));
}

} // namespace

bool isRound(const Indenter& indenter) {
  return indenter.shape != IndenterShape::Flat && indenter.shape != IndenterShape::Plane;
}

std::vector<ContactPoint> contactPoints(const Mesh& mesh) {
  std::map<int, double> areas;
  for (Eigen::Index f = 0; f < mesh.topFaces.cols(); ++f) {
    const bool triangle = mesh.shape == ElementShape::Tetrahedron10;
    const double area = areaOfFace(mesh, f, 0, 1, 2) + (triangle ? 0 : areaOfFace(mesh, f, 0, 2, 3));
    for (int n = triangle ? 3 : 0; n < (triangle ? 6 : 4); ++n) areas[mesh.topFaces(n, f)] += area / (triangle ? 3 : 4);
  }
  std::vector<ContactPoint> points;
  for (const auto& [node, area] : areas) points.push_back({node, area});
  return points;
}

Eigen::Vector3d tipAtRest_mm(const Indenter& indenter, const Mesh& mesh) {
  return {indenter.place_mm.x(), indenter.place_mm.y(), mesh.nodes_mm.row(2).maxCoeff()};
}

Eigen::Matrix3Xd tipsAtRest_mm(const std::vector<Indenter>& indenters, const Mesh& mesh) {
  Eigen::Matrix3Xd tips_mm(3, static_cast<Eigen::Index>(indenters.size()));
  for (std::size_t k = 0; k < indenters.size(); ++k)
    tips_mm.col(static_cast<Eigen::Index>(k)) = tipAtRest_mm(indenters[k], mesh);
  return tips_mm;
}

std::vector<ContactPoint> touchablePoints(const Mesh& mesh, const SensorDesign& design,
                                          const std::vector<LoadCase>& path, double margin) {
  struct Tip {
    const Indenter* indenter;
    int number;
    Eigen::Vector3d place_mm;
  };
  std::vector<Tip> tips;
  const std::vector<Indenter>& indenters = path.front().indenters;
  for (std::size_t i = 0; i < indenters.size(); ++i) {
    Eigen::Vector2d from = Eigen::Vector2d::Zero();
    for (const LoadCase& load : path) {
      const Indenter& indenter = load.indenters[i];
      const Eigen::Vector2d to = indenter.motion() ? indenter.motion()->shift_mm : Eigen::Vector2d::Zero();
      const double depth = depthOfSearch(indenter, contactEstimate(indenter, design).depth_mm, margin);
      const int places = to == from ? 0 : placesOnTheWay;
      for (int k = 0; k <= places; ++k) {
        const Eigen::Vector2d shift_mm = from + (to - from) * (places > 0 ? double(k) / places : 0);
        tips.push_back({&indenter, static_cast<int>(i),
                        tipAtRest_mm(indenter, mesh) + Eigen::Vector3d(shift_mm.x(), shift_mm.y(), -depth)});
      }
      from = to;
    }
  }
  std::vector<ContactPoint> touchable;
  for (ContactPoint point : contactPoints(mesh)) {
    double deepest = 0;
    for (const Tip& tip : tips) {
      const double gap = distance(*tip.indenter, mesh.nodes_mm.col(point.node) - tip.place_mm).gap_mm;
      if (gap >= deepest) continue;
      deepest = gap;
      point.indenter = tip.number;
    }
    if (deepest < 0) touchable.push_back(point);
  }
  return touchable;
}

} // namespace palp
