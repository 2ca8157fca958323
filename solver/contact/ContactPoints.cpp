#include "solver/contact/ContactPoints.h"

#include "solver/contact/ContactEstimate.h"

#include <Eigen/Dense>

#include <map>

namespace palp {

namespace {

constexpr int placesOnTheWay = 16; // of an indenter that goes sideways

double areaOfFace(const Mesh& mesh, Eigen::Index f, int a, int b, int c) {
  const auto at = [&](int n) { return Eigen::Vector3d(mesh.nodes_mm.col(mesh.topFaces(n, f))); };
  return (at(b) - at(a)).cross(at(c) - at(a)).norm() / 2;
}

} // namespace

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

std::vector<ContactPoint> touchablePoints(const Mesh& mesh, const SensorDesign& design, const LoadCase& load,
                                          double margin) {
  std::vector<ContactPoint> touchable;
  for (ContactPoint point : contactPoints(mesh)) {
    double deepest = 0;
    for (std::size_t i = 0; i < load.indenters.size(); ++i) {
      const Indenter& indenter = load.indenters[i];
      const Motion* motion = indenter.motion();
      const Eigen::Vector2d shift = motion ? motion->shift_mm : Eigen::Vector2d::Zero();
      const double depth = margin * contactEstimate(indenter, design).depth_mm;
      const int places = shift.isZero(0) ? 0 : placesOnTheWay;
      for (int k = 0; k <= places; ++k) {
        const Eigen::Vector2d sideways = shift * (places > 0 ? double(k) / places : 0);
        const Eigen::Vector3d tip = tipAtRest_mm(indenter, mesh) + Eigen::Vector3d(sideways.x(), sideways.y(), -depth);
        const double gap = distance(indenter, mesh.nodes_mm.col(point.node) - tip).gap_mm;
        if (gap >= deepest) continue;
        deepest = gap;
        point.indenter = static_cast<int>(i);
      }
    }
    if (deepest < 0) touchable.push_back(point);
  }
  return touchable;
}

} // namespace palp
