#include "solver/field/FieldFunctions.h"

#include "model/base/Parallel.h"
#include "solver/element/ElementGeometry.h"
#include "solver/field/TetRule.h"

#include <Eigen/Dense>

#include <cmath>
#include <utility>

namespace palp {

namespace {

using AtNodes = Eigen::Matrix<double, 10, 1>;

AtNodes inverseRoots(const FieldConductivity& conductivity, const AtNodes& pressures) {
  return pressures.unaryExpr([&](double p) { return std::exp(-conductivity.halfLogConductivity(p)); });
}

/// Whether 1/m is other than quadratic. Smaller functions add no more than what they make better where k is even, which
/// the mesh at rest has without them: 1e-5 of ln R by virtual ground, however weak the law is.
bool isRoughInside(const FieldConductivity& conductivity, const AtNodes& pressures) {
  constexpr double least = 1e-3;
  if (!(pressures.array() > 0).any()) return false;
  const AtNodes roots = inverseRoots(conductivity, pressures);
  for (const Eigen::Vector4d& point : tetRule().barycentric) {
    const AtNodes shapes = tetShapes(point);
    const double root = std::exp(-conductivity.halfLogConductivity(shapes.dot(pressures)));
    if (std::abs(shapes.dot(roots) - root) > least * root) return true;
  }
  return false;
}

} // namespace

FieldFunctions::FieldFunctions(const FieldMesh& mesh, FieldConductivity conductivity, int threads)
    : mesh_(&mesh), conductivity_(std::move(conductivity)) {
  if (!conductivity_.heterogeneous()) return;
  const Eigen::MatrixXi& elements = mesh.tets().elements;
  std::vector<char> roughInside(std::size_t(mesh.elements()));
  inParallel(roughInside.size(), threads, [&](std::size_t e) {
    const AtNodes pressures = conductivity_.pressures_MPa(elements.col(Eigen::Index(e)));
    roughInside[e] = isRoughInside(conductivity_, pressures) ? 1 : 0;
  });
  rough_.resize(std::size_t(mesh.corners()));
  for (int e = 0; e < mesh.elements(); ++e)
    for (int corner = 0; corner < 4 && roughInside[std::size_t(e)] != 0; ++corner)
      rough_[std::size_t(elements(corner, e))] = true;
}

int FieldFunctions::count(int element) const {
  for (int corner = 0; corner < 4; ++corner)
    if (isRough(mesh_->tets().elements(corner, element))) return most;
  return 10;
}

int FieldFunctions::row(const FieldMesh& mesh, int function, int element) {
  const Eigen::MatrixXi& nodes = mesh.tets().elements;
  return function < 10 ? nodes(function, element) : mesh.nodes() + nodes(function - 10, element);
}

FieldFunctions::Point FieldFunctions::at(int element, const Eigen::Vector4d& barycentric) const {
  Point point;
  const AtNodes shapes = tetShapes(barycentric);
  const Eigen::Matrix<double, 10, 3> gradients = tetLocalGradients(barycentric);
  point.values.head<10>() = shapes;
  point.gradients.topRows<10>() = gradients;
  if (count(element) == 10) return point;
  const AtNodes pressures = conductivity_.pressures_MPa(mesh_->tets().elements.col(element));
  const AtNodes roots = inverseRoots(conductivity_, pressures);
  const double pressure = shapes.dot(pressures), root = std::exp(-conductivity_.halfLogConductivity(pressure));
  const double remainder = shapes.dot(roots) - root;
  const Eigen::RowVector3d slope =
      roots.transpose() * gradients +
      root * conductivity_.halfLogConductivitySlope(pressure) * (pressures.transpose() * gradients);
  for (int corner = 0; corner < 4; ++corner) {
    if (!isRough(mesh_->tets().elements(corner, element))) continue;
    point.values(10 + corner) = barycentric(corner) * remainder;
    Eigen::RowVector3d own = Eigen::RowVector3d::Constant(corner == 0 ? -1 : 0);
    if (corner > 0) own(corner - 1) = 1;
    point.gradients.row(10 + corner) = remainder * own + barycentric(corner) * slope;
  }
  return point;
}

} // namespace palp
