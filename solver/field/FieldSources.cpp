#include "solver/field/FieldSources.h"

#include "solver/element/ElementGeometry.h"

#include <Eigen/Dense>

namespace palp {

FieldSources::FieldSources(const FieldMesh& mesh, const Eigen::Vector3d& block_mm,
                           const Eigen::Matrix3Xd& electrodes_mm, double cutoff_mm)
    : elements_(mesh.tets().elements), mirrors_(static_cast<std::size_t>(electrodes_mm.cols())) {
  std::vector<Eigen::Vector3d> projections, normals;
  for (Eigen::Index p = 0; p < electrodes_mm.cols(); ++p)
    for (int axis = 0; axis < 3; ++axis)
      for (const bool high : {false, true}) {
        Eigen::Vector3d projection = electrodes_mm.col(p);
        projection(axis) = high ? block_mm(axis) : 0;
        if (std::abs(projection(axis) - electrodes_mm(axis, p)) > cutoff_mm) continue;
        mirrors_[static_cast<std::size_t>(p)].alongAxis[static_cast<std::size_t>(axis)].push_back(
            static_cast<int>(projections.size()));
        projections.push_back(projection);
        normals.emplace_back((high ? 1 : -1) * Eigen::Vector3d::Unit(axis));
      }
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(projections.size()));
  normals_.resize(3, points.cols());
  for (std::size_t f = 0; f < projections.size(); ++f) {
    points.col(static_cast<Eigen::Index>(f)) = projections[f];
    normals_.col(static_cast<Eigen::Index>(f)) = normals[f];
  }
  const PointProbe probe(mesh.tets(), points);
  for (const auto& hosts : probe.hosts()) {
    projectionShapes_.emplace_back(hosts.front().shapes);
    projectionElements_.emplace_back();
    projectionGradients_.emplace_back();
    for (const PointProbe::Host& host : hosts) {
      projectionElements_.back().push_back(host.element);
      projectionGradients_.back().push_back(tetShapeGradients(tetGeometry(mesh.tets(), host.element), host.pressure));
    }
  }
}

std::vector<Eigen::Matrix3Xd> FieldSources::at(const Eigen::Matrix3Xd& nodes_mm,
                                               const Eigen::Matrix3Xd& electrodes_mm) const {
  Eigen::Matrix3Xd projections(3, normals_.cols()), normals(3, normals_.cols());
  for (Eigen::Index f = 0; f < normals_.cols(); ++f) {
    const auto i = static_cast<std::size_t>(f);
    projections.col(f) = nodes_mm(Eigen::all, elements_.col(projectionElements_[i].front())) * projectionShapes_[i];
    // The face's normal follows the mean deformation gradient F of the elements around its projection, as F^-T N.
    Eigen::Matrix3d F = Eigen::Matrix3d::Zero();
    for (std::size_t k = 0; k < projectionElements_[i].size(); ++k)
      F += nodes_mm(Eigen::all, elements_.col(projectionElements_[i][k])) * projectionGradients_[i][k].transpose();
    normals.col(f) = (F.inverse().transpose() * normals_.col(f)).normalized();
  }
  const auto mirrored = [&](const Eigen::Vector3d& x, int f) -> Eigen::Vector3d {
    return x - 2 * normals.col(f).dot(x - projections.col(f)) * normals.col(f);
  };
  std::vector<Eigen::Matrix3Xd> sources;
  for (std::size_t p = 0; p < mirrors_.size(); ++p) {
    std::vector<Eigen::Vector3d> all{electrodes_mm.col(static_cast<Eigen::Index>(p))};
    for (const std::vector<int>& planes : mirrors_[p].alongAxis) {
      const std::size_t before = all.size();
      for (const int plane : planes)
        for (std::size_t k = 0; k < before; ++k) all.push_back(mirrored(all[k], plane));
    }
    Eigen::Matrix3Xd& columns = sources.emplace_back(3, static_cast<Eigen::Index>(all.size()));
    for (std::size_t k = 0; k < all.size(); ++k) columns.col(static_cast<Eigen::Index>(k)) = all[k];
  }
  return sources;
}

} // namespace palp
