#include "solver/PointProbe.h"

#include "model/DesignError.h"
#include "model/base/Text.h"
#include "solver/element/ElementGeometry.h"

#include <Eigen/Dense>

#include <algorithm>
#include <optional>

namespace palp {

namespace {

constexpr double localTolerance = 1e-9; // of local coordinates: points on faces belong to both sides

std::optional<PointProbe::Holder> tetHolder(const Mesh& mesh, int element, const Eigen::Vector3d& p) {
  const TetGeometry geometry = tetGeometry(mesh, element);
  Eigen::Vector4d l = geometry.gradients.transpose() * (p - mesh.nodes_mm.col(mesh.elements(0, element)));
  l(0) += 1;
  if (l.minCoeff() < -localTolerance) return {};
  return PointProbe::Holder{element, tetShapes(l), tetBubble(l), l};
}

std::optional<PointProbe::Holder> hexHolder(const Mesh& mesh, int element, const Eigen::Vector3d& p) {
  Eigen::Vector3d reference = Eigen::Vector3d::Zero();
  for (int iteration = 0; iteration < 20; ++iteration) {
    const HexPointGeometry point = hexGeometry(mesh, element, reference);
    Eigen::Vector3d error = p;
    Eigen::Matrix3d inverseMap = Eigen::Matrix3d::Zero();
    for (int n = 0; n < 8; ++n) {
      error -= point.shapes(n) * mesh.nodes_mm.col(mesh.elements(n, element));
      inverseMap += hexCorner(n) * point.gradients.col(n).transpose();
    }
    const Eigen::Vector3d change = inverseMap * error;
    reference += change;
    if (reference.cwiseAbs().maxCoeff() > 10) return {};
    if (change.norm() < 1e-13) break;
  }
  if (reference.cwiseAbs().maxCoeff() > 1 + localTolerance) return {};
  return PointProbe::Holder{element, hexGeometry(mesh, element, reference).shapes, 0, Eigen::VectorXd::Ones(1)};
}

} // namespace

PointProbe::PointProbe(const Mesh& mesh, const Eigen::Matrix3Xd& points_mm)
    : elements_(mesh.elements), holders_(points_mm.cols()) {
  const bool tets = mesh.shape == ElementShape::Tetrahedron10;
  const int corners = tets ? 4 : 8;
  const double margin = 1e-9 * mesh.nodes_mm.maxCoeff();
  // The points by their x: an element is compared only with those within its own range of x.
  std::vector<Eigen::Index> byX;
  for (Eigen::Index i = 0; i < points_mm.cols(); ++i)
    if (points_mm.col(i).allFinite()) byX.push_back(i);
  std::sort(byX.begin(), byX.end(), [&](Eigen::Index a, Eigen::Index b) { return points_mm(0, a) < points_mm(0, b); });
  for (int e = 0; e < mesh.elementCount(); ++e) {
    Eigen::Vector3d low = mesh.nodes_mm.col(mesh.elements(0, e)), high = low;
    for (int n = 1; n < corners; ++n) {
      low = low.cwiseMin(mesh.nodes_mm.col(mesh.elements(n, e)));
      high = high.cwiseMax(mesh.nodes_mm.col(mesh.elements(n, e)));
    }
    auto next = std::lower_bound(byX.begin(), byX.end(), low.x() - margin,
                                 [&](Eigen::Index i, double x) { return points_mm(0, i) < x; });
    for (; next != byX.end() && points_mm(0, *next) <= high.x() + margin; ++next) {
      const Eigen::Vector3d p = points_mm.col(*next);
      if (((p - low).array() < -margin).any() || ((high - p).array() < -margin).any()) continue;
      if (auto holder = tets ? tetHolder(mesh, e, p) : hexHolder(mesh, e, p))
        holders_[*next].push_back(std::move(*holder));
    }
  }
  for (Eigen::Index i = 0; i < points_mm.cols(); ++i)
    if (holders_[i].empty())
      throw DesignError("mesh: the point (" + text(points_mm(0, i)) + ", " + text(points_mm(1, i)) + ", " +
                        text(points_mm(2, i)) + ") mm lies outside the block");
}

Eigen::Matrix3Xd PointProbe::displacements_mm(const LoadIncrement& state) const {
  Eigen::Matrix3Xd u = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(holders_.size()));
  for (std::size_t i = 0; i < holders_.size(); ++i) {
    const Holder& holder = holders_[i].front();
    for (Eigen::Index n = 0; n < holder.shapes.size(); ++n)
      u.col(i) += holder.shapes(n) * state.displacements_mm.col(elements_(n, holder.element));
    if (holder.bubble != 0) u.col(i) += holder.bubble * state.elementUnknowns.col(holder.element).head<3>();
  }
  return u;
}

Eigen::VectorXd PointProbe::pressures_MPa(const LoadIncrement& state) const {
  Eigen::VectorXd p = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(holders_.size()));
  for (std::size_t i = 0; i < holders_.size(); ++i) {
    for (const Holder& holder : holders_[i])
      p(i) -= state.elementUnknowns.col(holder.element).tail(holder.pressure.size()).dot(holder.pressure);
    p(i) /= double(holders_[i].size());
  }
  return p;
}

} // namespace palp
