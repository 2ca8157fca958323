#include "solver/mesh/QuadraticTets.h"

#include "model/base/Cancelled.h"
#include "solver/element/ElementKernels.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace palp {

namespace {

/// All edges of the mesh, sorted; the place of an edge gives its midpoint's number.
class Edges {
public:
  Edges(const Eigen::Matrix4Xi& tets, Eigen::Index corners) : corners_(corners) {
    keys_.reserve(6 * tets.cols());
    for (Eigen::Index e = 0; e < tets.cols(); ++e)
      for (const auto& [a, b] : tetEdges) keys_.push_back(key(tets(a, e), tets(b, e)));
    std::sort(keys_.begin(), keys_.end());
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
  }
  [[nodiscard]] int midpoint(int a, int b) const {
    return static_cast<int>(corners_ + (std::lower_bound(keys_.begin(), keys_.end(), key(a, b)) - keys_.begin()));
  }
  [[nodiscard]] Eigen::Matrix3Xd withMidpoints(const Eigen::Matrix3Xd& points) const {
    Eigen::Matrix3Xd all(3, corners_ + static_cast<Eigen::Index>(keys_.size()));
    all.leftCols(corners_) = points;
    for (std::size_t i = 0; i < keys_.size(); ++i)
      all.col(corners_ + static_cast<Eigen::Index>(i)) =
          (points.col(keys_[i] / corners_) + points.col(keys_[i] % corners_)) / 2;
    return all;
  }

private:
  [[nodiscard]] std::int64_t key(std::int64_t a, std::int64_t b) const {
    return std::min(a, b) * corners_ + std::max(a, b);
  }
  std::int64_t corners_;
  std::vector<std::int64_t> keys_;
};

/// The same elements, all with positive volume.
Eigen::Matrix4Xi turnedPositive(const Eigen::Matrix3Xd& points, Eigen::Matrix4Xi tets) {
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    Eigen::Matrix3d edges;
    for (int i = 0; i < 3; ++i) edges.col(i) = points.col(tets(i + 1, e)) - points.col(tets(0, e));
    if (edges.determinant() < 0) std::swap(tets(2, e), tets(3, e));
  }
  return tets;
}

} // namespace

Mesh quadraticTets(const Eigen::Matrix3Xd& points_mm, const LinearTets& tets, const std::stop_token& stop) {
  const Eigen::Matrix4Xi corners = turnedPositive(points_mm, tets.corners);
  throwIfStopped(stop);
  const Edges edges(corners, points_mm.cols());
  throwIfStopped(stop);
  Mesh mesh;
  mesh.shape = ElementShape::Tetrahedron10;
  mesh.nodes_mm = edges.withMidpoints(points_mm);
  mesh.elements.resize(10, corners.cols());
  mesh.elements.topRows<4>() = corners;
  for (Eigen::Index e = 0; e < corners.cols(); ++e)
    for (int k = 0; k < 6; ++k)
      mesh.elements(4 + k, e) = edges.midpoint(corners(tetEdges[k][0], e), corners(tetEdges[k][1], e));
  const double top = points_mm.row(2).maxCoeff();
  std::vector<Eigen::Index> topFaces;
  for (Eigen::Index f = 0; f < tets.hull.cols(); ++f)
    if (points_mm(2, tets.hull(0, f)) == top && points_mm(2, tets.hull(1, f)) == top &&
        points_mm(2, tets.hull(2, f)) == top)
      topFaces.push_back(f);
  mesh.topFaces.resize(6, static_cast<Eigen::Index>(topFaces.size()));
  for (std::size_t t = 0; t < topFaces.size(); ++t) {
    const auto column = static_cast<Eigen::Index>(t);
    for (int n = 0; n < 3; ++n) {
      const int a = tets.hull(n, topFaces[t]), b = tets.hull((n + 1) % 3, topFaces[t]);
      mesh.topFaces(n, column) = a;
      mesh.topFaces(3 + n, column) = edges.midpoint(a, b);
    }
  }
  return mesh;
}

} // namespace palp
