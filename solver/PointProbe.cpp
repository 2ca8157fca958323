#include "solver/PointProbe.h"

#include "model/DesignError.h"
#include "model/base/Text.h"
#include "solver/element/ElementGeometry.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

namespace palp {

namespace {

constexpr double localTolerance = 1e-9; // of local coordinates: points on faces belong to both sides

std::optional<PointProbe::Host> tetHolder(const Mesh& mesh, int element, const TetGeometry& geometry,
                                          const Eigen::Vector3d& p) {
  Eigen::Vector4d l = geometry.gradients.transpose() * (p - mesh.nodes_mm.col(mesh.elements(0, element)));
  l(0) += 1;
  if (l.minCoeff() < -localTolerance) return {};
  return PointProbe::Host{element, tetShapes(l), tetBubble(l), l};
}

std::optional<PointProbe::Host> hexHolder(const Mesh& mesh, int element, const Eigen::Vector3d& p) {
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
  return PointProbe::Host{element, hexGeometry(mesh, element, reference).shapes, 0, PointProbe::Host::Weights::Ones(1)};
}

/// Finite points by cells of a grid over x and y, so that an element is compared only with those near it.
class PointGrid {
public:
  explicit PointGrid(const Eigen::Matrix3Xd& points_mm) {
    std::vector<Eigen::Index> finite;
    for (Eigen::Index i = 0; i < points_mm.cols(); ++i)
      if (points_mm.col(i).allFinite()) finite.push_back(i);
    if (finite.empty()) return;
    const auto places = points_mm(Eigen::seqN(0, Eigen::fix<2>), finite);
    low_ = places.rowwise().minCoeff();
    const Eigen::Array2d extent = (places.rowwise().maxCoeff().array() - low_).max(1e-9);
    count_ = std::clamp(static_cast<int>(std::sqrt(double(finite.size()))), 1, mostCells);
    perMm_ = count_ / extent;
    std::vector<std::vector<Eigen::Index>> cells(std::size_t(count_) * std::size_t(count_));
    for (const Eigen::Index i : finite) {
      const Eigen::Array2i cell = cellOf(points_mm.col(i).head<2>());
      cells[std::size_t(cell.x() * count_ + cell.y())].push_back(i);
    }
    for (const auto& cell : cells) {
      start_.push_back(points_.size());
      points_.insert(points_.end(), cell.begin(), cell.end());
    }
    start_.push_back(points_.size());
  }

  /// Those in the cells that a rectangle meets.
  template <class Take> void near(const Eigen::Array2d& low, const Eigen::Array2d& high, const Take& take) const {
    if (points_.empty()) return;
    const Eigen::Array2i from = cellOf(low), to = cellOf(high);
    for (int x = from.x(); x <= to.x(); ++x) {
      const std::size_t row = std::size_t(x) * std::size_t(count_);
      const std::size_t end = start_[row + std::size_t(to.y()) + 1];
      for (std::size_t k = start_[row + std::size_t(from.y())]; k < end; ++k) take(points_[k]);
    }
  }

private:
  static constexpr int mostCells = 256; // along each axis

  /// The nearest, of what lies outside.
  [[nodiscard]] Eigen::Array2i cellOf(const Eigen::Array2d& place) const {
    return ((place - low_) * perMm_).max(0).min(count_ - 1).cast<int>();
  }

  Eigen::Array2d low_ = Eigen::Array2d::Zero(), perMm_ = Eigen::Array2d::Zero();
  int count_ = 0;
  std::vector<std::size_t> start_; ///< of each cell, a column of cells after another
  std::vector<Eigen::Index> points_;
};

} // namespace

PointProbe::PointProbe(const Mesh& mesh, const Eigen::Matrix3Xd& points_mm)
    : elements_(mesh.elements), hosts_(points_mm.cols()) {
  const bool tets = mesh.shape == ElementShape::Tetrahedron10;
  const int corners = tets ? 4 : 8;
  const double margin = 1e-9 * mesh.nodes_mm.maxCoeff();
  const PointGrid grid(points_mm);
  for (int e = 0; e < mesh.elementCount(); ++e) {
    Eigen::Array3d low = mesh.nodes_mm.col(mesh.elements(0, e)), high = low;
    for (int n = 1; n < corners; ++n) {
      low = low.min(mesh.nodes_mm.col(mesh.elements(n, e)).array());
      high = high.max(mesh.nodes_mm.col(mesh.elements(n, e)).array());
    }
    low -= margin;
    high += margin;
    std::optional<TetGeometry> geometry; // found once, where there is a point
    grid.near(low.head<2>(), high.head<2>(), [&](Eigen::Index i) {
      const Eigen::Vector3d p = points_mm.col(i);
      if ((p.array() < low).any() || (p.array() > high).any()) return;
      if (tets && !geometry) geometry = tetGeometry(mesh, e);
      if (auto host = tets ? tetHolder(mesh, e, *geometry, p) : hexHolder(mesh, e, p))
        hosts_[i].push_back(std::move(*host));
    });
  }
  for (Eigen::Index i = 0; i < points_mm.cols(); ++i)
    if (hosts_[i].empty())
      throw DesignError("mesh: the point (" + text(points_mm(0, i)) + ", " + text(points_mm(1, i)) + ", " +
                        text(points_mm(2, i)) + ") mm lies outside the block");
}

Eigen::Matrix3Xd PointProbe::displacements_mm(const LoadIncrement& state) const {
  assert(elements_.size() == 0 || state.displacements_mm.cols() > elements_.maxCoeff());
  Eigen::Matrix3Xd u = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(hosts_.size()));
  for (std::size_t i = 0; i < hosts_.size(); ++i) {
    const Host& host = hosts_[i].front();
    for (Eigen::Index n = 0; n < host.shapes.size(); ++n)
      u.col(i) += host.shapes(n) * state.displacements_mm.col(elements_(n, host.element));
    if (host.bubble != 0) u.col(i) += host.bubble * state.elementUnknowns.col(host.element).head<3>();
  }
  return u;
}

Eigen::VectorXd PointProbe::pressures_MPa(const LoadIncrement& state) const {
  assert(state.elementUnknowns.cols() == elements_.cols() && "unknowns of each element");
  Eigen::VectorXd p = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(hosts_.size()));
  for (std::size_t i = 0; i < hosts_.size(); ++i) {
    for (const Host& host : hosts_[i])
      p(i) -= state.elementUnknowns.col(host.element).tail(host.pressure.size()).dot(host.pressure);
    p(i) /= double(hosts_[i].size());
  }
  return p;
}

} // namespace palp
