#include "solver/contact/ContactSummary.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp {

namespace {

constexpr double centreShare = 0.25; // of the contact radius: over so wide a disc the centre's pressure is averaged

/// Mean square of the distance from the axis, weighted by force, against that of the radius: 2/5 for a sphere's
/// pressure (1 - r^2)^(1/2), 2/3 for a punch's (1 - r^2)^(-1/2).
double meanSquare(IndenterShape shape) {
  return shape == IndenterShape::Flat ? 2. / 3 : 2. / 5;
}

IndenterState stateOf(const Indenter& indenter, int index, const Mesh& mesh, const std::vector<ContactPoint>& points,
                      const ContactState& state, const Eigen::Matrix3Xd& positions_mm) {
  IndenterState result;
  result.translation_mm = state.translations_mm.col(index);
  const Eigen::Vector3d tip = tipAtRest_mm(indenter, mesh) + result.translation_mm;
  const bool alongX = indenter.shape == IndenterShape::CylinderX, alongY = indenter.shape == IndenterShape::CylinderY;
  const auto across = [&](Eigen::Index i) {
    const Eigen::Vector2d r = (positions_mm.col(i) - tip).head<2>();
    return alongX ? std::abs(r.y()) : alongY ? std::abs(r.x()) : r.norm();
  };
  double sliding = 0, force = 0, squares = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto i = static_cast<Eigen::Index>(p);
    if (points[p].indenter != index || state.statuses[p] == ContactStatus::Open) continue;
    result.force_N += state.forces_N.col(i);
    ++result.touchingNodes;
    result.contactArea_mm2 += points[p].area_mm2;
    if (state.statuses[p] == ContactStatus::Slip) sliding += points[p].area_mm2;
    const double share = state.forces_N.col(i).norm();
    force += share;
    squares += share * across(i) * across(i);
  }
  if (!(force > 0)) return result;
  result.slipShare = sliding / result.contactArea_mm2;
  if (indenter.shape == IndenterShape::Plane)
    result.contactRadius_mm = std::sqrt(result.contactArea_mm2 / std::numbers::pi);
  else if (alongX || alongY)
    result.contactRadius_mm = std::sqrt(4 * squares / force); // a strip's half width: p = p0 (1 - y^2)^(1/2)
  else
    result.contactRadius_mm = std::sqrt(squares / force / meanSquare(indenter.shape));
  // The nearest points where so small a disc holds none.
  double nearest = std::numeric_limits<double>::max();
  for (std::size_t p = 0; p < points.size(); ++p)
    if (points[p].indenter == index) nearest = std::min(nearest, across(static_cast<Eigen::Index>(p)));
  const double disc = std::max(centreShare * result.contactRadius_mm, 1.5 * nearest);
  double pressed = 0, area = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto i = static_cast<Eigen::Index>(p);
    if (points[p].indenter != index || across(i) > disc) continue;
    const IndenterDistance near = distance(indenter, positions_mm.col(i) - tip);
    pressed += state.forces_N.col(i).dot(near.normal);
    area += points[p].area_mm2;
  }
  if (area > 0) result.centrePressure_MPa = pressed / area;
  return result;
}

} // namespace

std::vector<IndenterState> indenterStates(const LoadCase& load, const Mesh& mesh,
                                          const std::vector<ContactPoint>& points, const ContactState& state,
                                          const Eigen::Matrix3Xd& positions_mm) {
  std::vector<IndenterState> states;
  for (std::size_t k = 0; k < load.indenters.size(); ++k)
    states.push_back(stateOf(load.indenters[k], static_cast<int>(k), mesh, points, state, positions_mm));
  return states;
}

Eigen::Matrix3Xd contactTractions_MPa(const Mesh& mesh, const std::vector<ContactPoint>& points,
                                      const ContactState& state) {
  Eigen::Matrix3Xd tractions = Eigen::Matrix3Xd::Zero(3, mesh.nodeCount());
  for (std::size_t p = 0; p < points.size(); ++p)
    tractions.col(points[p].node) = state.forces_N.col(static_cast<Eigen::Index>(p)) / points[p].area_mm2;
  if (mesh.shape != ElementShape::Tetrahedron10) return tractions;
  Eigen::VectorXi beside = Eigen::VectorXi::Zero(mesh.nodeCount());
  for (Eigen::Index f = 0; f < mesh.topFaces.cols(); ++f)
    for (int n = 0; n < 3; ++n)
      for (const int edge : {n, (n + 2) % 3}) { // the edges that meet in the corner
        tractions.col(mesh.topFaces(n, f)) += tractions.col(mesh.topFaces(3 + edge, f));
        ++beside(mesh.topFaces(n, f));
      }
  for (int node = 0; node < mesh.nodeCount(); ++node)
    if (beside(node) > 0) tractions.col(node) /= beside(node);
  return tractions;
}

} // namespace palp
