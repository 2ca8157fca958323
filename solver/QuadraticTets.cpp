#include "solver/QuadraticTets.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace palp {

namespace {

constexpr std::array<std::array<int, 2>, 6> tetEdges{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};

/// All edges of the mesh, sorted; the place of an edge gives its midpoint's number.
class Edges {
public:
  explicit Edges(const LinearTets& tets) : corners_(tets.points.cols()) {
    keys_.reserve(6 * tets.corners.cols());
    for (Eigen::Index e = 0; e < tets.corners.cols(); ++e)
      for (const auto& [a, b] : tetEdges) keys_.push_back(key(tets.corners(a, e), tets.corners(b, e)));
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

} // namespace

Mesh quadraticTets(const LinearTets& tets) {
  const Edges edges(tets);
  Mesh mesh;
  mesh.shape = ElementShape::Tetrahedron10;
  mesh.nodes_mm = edges.withMidpoints(tets.points);
  mesh.elements.resize(10, tets.corners.cols());
  mesh.elements.topRows<4>() = tets.corners;
  for (Eigen::Index e = 0; e < tets.corners.cols(); ++e)
    for (int k = 0; k < 6; ++k)
      mesh.elements(4 + k, e) = edges.midpoint(tets.corners(tetEdges[k][0], e), tets.corners(tetEdges[k][1], e));
  const auto top = std::count_if(tets.faceMarks.begin(), tets.faceMarks.end(), [](int mark) { return mark >= 0; });
  mesh.topFaces.resize(6, top);
  mesh.topFaceAreas.resize(top);
  for (Eigen::Index f = 0, t = 0; f < tets.faces.cols(); ++f) {
    if (tets.faceMarks[f] < 0) continue;
    mesh.topFaces.col(t).head<3>() = tets.faces.col(f);
    for (int k = 0; k < 3; ++k) mesh.topFaces(3 + k, t) = edges.midpoint(tets.faces(k, f), tets.faces((k + 1) % 3, f));
    mesh.topFaceAreas(t++) = tets.faceMarks[f];
  }
  return mesh;
}

} // namespace palp
