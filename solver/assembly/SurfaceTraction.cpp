#include "solver/assembly/SurfaceTraction.h"

#include "model/DesignError.h"

#include <Eigen/Dense>

#include <cmath>
#include <map>
#include <numbers>

namespace palp {

namespace {

using Polygon = std::vector<Eigen::Vector2d>;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The part of a convex polygon to the left of the line from a to b (Sutherland and Hodgman).
Polygon clip(const Polygon& polygon, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  Polygon inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& p = polygon[i];
    const Eigen::Vector2d& q = polygon[(i + 1) % polygon.size()];
    const double sp = cross(b - a, p - a), sq = cross(b - a, q - a);
    if (sp >= 0) inside.push_back(p);
    if ((sp > 0 && sq < 0) || (sp < 0 && sq > 0)) inside.push_back(p + sp / (sp - sq) * (q - p));
  }
  return inside;
}

Polygon clip(Polygon polygon, const Eigen::Matrix2Xd& region) {
  for (Eigen::Index i = 0; i < region.cols() && polygon.size() > 2; ++i)
    polygon = clip(polygon, region.col(i), region.col((i + 1) % region.cols()));
  return polygon.size() > 2 ? polygon : Polygon{};
}

/// Corners of a face, counter-clockwise seen from above.
struct Face {
  std::vector<int> nodes;
  Polygon corners;
};
Face face(const Mesh& mesh, Eigen::Index f) {
  Face face;
  const Eigen::Index corners = mesh.shape == ElementShape::Tetrahedron10 ? 3 : 4;
  for (Eigen::Index n = 0; n < mesh.topFaces.rows(); ++n) face.nodes.push_back(mesh.topFaces(n, f));
  for (Eigen::Index n = 0; n < corners; ++n) face.corners.emplace_back(mesh.nodes_mm.col(face.nodes[n]).head<2>());
  if (cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]) < 0) {
    std::swap(face.corners[1], face.corners.back());
    std::swap(face.nodes[1], face.nodes[corners - 1]);
    if (corners == 3) std::swap(face.nodes[3], face.nodes[5]);
  }
  return face;
}

Eigen::VectorXd triangleShapes(const Face& face, const Eigen::Vector2d& p) {
  const Polygon& c = face.corners;
  const double area = cross(c[1] - c[0], c[2] - c[0]);
  const double l[3] = {cross(c[1] - p, c[2] - p) / area, cross(c[2] - p, c[0] - p) / area,
                       cross(c[0] - p, c[1] - p) / area};
  Eigen::VectorXd N(6);
  for (int i = 0; i < 3; ++i) {
    N(i) = l[i] * (2 * l[i] - 1);
    N(3 + i) = 4 * l[i] * l[(i + 1) % 3];
  }
  return N;
}

/// Bilinear shape functions of a convex quadrilateral at a point, whose reference coordinates Newton's method finds.
Eigen::VectorXd quadrilateralShapes(const Face& face, const Eigen::Vector2d& p) {
  static constexpr double sx[4] = {-1, 1, 1, -1}, sy[4] = {-1, -1, 1, 1};
  Eigen::Vector2d reference = Eigen::Vector2d::Zero();
  Eigen::VectorXd N(4);
  for (int iteration = 0; iteration < 20; ++iteration) {
    Eigen::Vector2d error = -p;
    Eigen::Matrix2d map = Eigen::Matrix2d::Zero();
    for (int n = 0; n < 4; ++n) {
      const double x = 1 + sx[n] * reference.x(), y = 1 + sy[n] * reference.y();
      N(n) = x * y / 4;
      error += N(n) * face.corners[n];
      map += face.corners[n] * Eigen::RowVector2d(sx[n] * y, sy[n] * x) / 4;
    }
    const Eigen::Vector2d change = map.inverse() * error;
    if (change.norm() < 1e-13) break;
    reference -= change;
  }
  return N;
}

/// Integral of the face's shape functions over a triangle inside it, exact to degree 2.
Eigen::VectorXd integral(const Face& face, bool triangle, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                         const Eigen::Vector2d& c) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(face.nodes.size()));
  for (const Eigen::Vector2d& p :
       {Eigen::Vector2d((a + b) / 2), Eigen::Vector2d((b + c) / 2), Eigen::Vector2d((c + a) / 2)})
    sum += triangle ? triangleShapes(face, p) : quadrilateralShapes(face, p);
  return sum * cross(b - a, c - a) / 6;
}

} // namespace

Eigen::Matrix2Xd regionOf(const Rectangle& area) {
  Eigen::Matrix2Xd corners(2, 4);
  corners << area.low_mm.x(), area.high_mm.x(), area.high_mm.x(), area.low_mm.x(), area.low_mm.y(), area.low_mm.y(),
      area.high_mm.y(), area.high_mm.y();
  return corners;
}

Eigen::Matrix2Xd regionOf(const PatchLoad& patch) {
  constexpr int sides = 256;
  constexpr double angle = 2 * std::numbers::pi / sides;
  const double radius = patch.radius_mm * std::sqrt(angle / std::sin(angle));
  Eigen::Matrix2Xd corners(2, sides);
  for (int i = 0; i < sides; ++i)
    corners.col(i) = patch.centre_mm + radius * Eigen::Vector2d(std::cos(i * angle), std::sin(i * angle));
  return corners;
}

TractionShares tractionShares(const Mesh& mesh, const Eigen::Matrix2Xd& convexRegion) {
  const bool triangles = mesh.shape == ElementShape::Tetrahedron10;
  std::map<int, double> weights;
  double total = 0;
  for (Eigen::Index f = 0; f < mesh.topFaces.cols(); ++f) {
    const Face part = face(mesh, f);
    const Polygon inside = clip(part.corners, convexRegion);
    for (std::size_t i = 2; i < inside.size(); ++i) {
      const Eigen::VectorXd shapes = integral(part, triangles, inside[0], inside[i - 1], inside[i]);
      for (std::size_t n = 0; n < part.nodes.size(); ++n)
        weights[part.nodes[n]] += shapes(static_cast<Eigen::Index>(n));
      total += shapes.sum();
    }
  }
  TractionShares shares;
  for (const auto& [node, weight] : weights) shares.push_back({node, weight / total});
  return shares;
}

Eigen::VectorXd nodalForces(const Mesh& mesh, const SensorDesign& design, const LoadCase& load) {
  if (const auto why = whyInvalid(load, design)) throw DesignError(*why);
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(3 * Eigen::Index(mesh.nodeCount()));
  const auto add = [&](const Eigen::Matrix2Xd& region, const Eigen::Vector3d& force_N) {
    for (const NodeShare& s : tractionShares(mesh, region)) forces.segment<3>(3 * s.node) += s.share * force_N;
  };
  for (const AreaLoad& area : load.areas) add(regionOf(design.areaRectangle(area.area)), area.force_N);
  for (const PatchLoad& patch : load.patches) add(regionOf(patch), patch.force_N);
  return forces;
}

} // namespace palp
