#pragma once

#include "solver/mesh/QuadraticTets.h"
#include "solver/statics/NewtonSolver.h"

#include <functional>
#include <random>

namespace palp::test {

/// Points of a grid n x n x n in the unit cube; those inside are moved at random by up to `distortion` cells.
inline Eigen::Matrix3Xd cubePoints(int n, double distortion) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> move(-distortion / n, distortion / n);
  Eigen::Matrix3Xd points(3, (n + 1) * (n + 1) * (n + 1));
  for (int k = 0, p = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i, ++p) {
        points.col(p) = Eigen::Vector3d(i, j, k) / n;
        if (i % n && j % n && k % n)
          for (int d = 0; d < 3; ++d) points(d, p) += move(random);
      }
  return points;
}

inline Mesh cubeTets(int n, double distortion) {
  const Eigen::Matrix3Xd grid = cubePoints(n, 0) * n;
  Eigen::VectorXd weights(grid.cols());
  for (Eigen::Index i = 0; i < grid.cols(); ++i) {
    const int odd = std::lround(grid(0, i)) % 2 + std::lround(grid(1, i)) % 2 + std::lround(grid(2, i)) % 2;
    weights(i) = 0.05 * odd * odd;
  }
  return quadraticTets(cubePoints(n, distortion), weightedDelaunay(grid.array().round(), weights));
}

inline Mesh cubeHexes(int n, double distortion) {
  Mesh mesh;
  mesh.shape = ElementShape::Hexahedron8;
  mesh.nodes_mm = cubePoints(n, distortion);
  mesh.elements.resize(8, n * n * n);
  const auto at = [n](int i, int j, int k) { return (k * (n + 1) + j) * (n + 1) + i; };
  for (int k = 0, e = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i, ++e)
        mesh.elements.col(e) << at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k), at(i, j, k + 1),
            at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1);
  return mesh;
}

/// A cylinder of tetrahedra: the square's concentric squares become circles.
inline Mesh cylinderTets(int n, double radius, double height) {
  Mesh mesh = cubeTets(n, 0);
  const int corners = mesh.elements.topRows<4>().maxCoeff() + 1;
  for (int i = 0; i < corners; ++i) {
    const Eigen::Vector2d square = 2 * mesh.nodes_mm.col(i).head<2>().array() - 1;
    const double r = square.cwiseAbs().maxCoeff();
    if (r > 0)
      mesh.nodes_mm.col(i).head<2>() = radius * r * square.normalized();
    else
      mesh.nodes_mm.col(i).head<2>().setZero();
    mesh.nodes_mm(2, i) *= height;
  }
  for (int e = 0; e < mesh.elementCount(); ++e)
    for (int k = 0; k < 6; ++k)
      mesh.nodes_mm.col(mesh.elements(4 + k, e)) =
          (mesh.nodes_mm.col(mesh.elements(tetEdges[k][0], e)) + mesh.nodes_mm.col(mesh.elements(tetEdges[k][1], e))) /
          2;
  return mesh;
}

/// What a node's component is prescribed to; empty: free.
using Prescription = std::function<std::optional<double>(const Eigen::Vector3d& x, int component)>;

/// A boundary value problem with prescribed displacements and nodal forces.
struct BoundaryValueProblem {
  Mesh mesh;
  Material material;
  std::shared_ptr<const Discretisation> discretisation;
  Assembler assembler;
  Loading loading;

  BoundaryValueProblem(Mesh m, const Material& rubber, const Prescription& prescribe)
      : mesh(std::move(m)), material(rubber), discretisation(discretise(mesh, prescribe)),
        assembler(discretisation, rubberConstants(rubber)) {
    loading.forces.setZero(3 * mesh.nodeCount());
    loading.prescribed.setZero(3 * mesh.nodeCount());
    for (int i = 0; i < 3 * mesh.nodeCount(); ++i)
      if (const auto value = prescribe(mesh.nodes_mm.col(i / 3), i % 3)) loading.prescribed(i) = *value;
  }

  static std::shared_ptr<const Discretisation> discretise(const Mesh& mesh, const Prescription& prescribe) {
    FixedComponents fixed(3 * std::size_t(mesh.nodeCount()));
    for (int i = 0; i < 3 * mesh.nodeCount(); ++i) fixed[i] = prescribe(mesh.nodes_mm.col(i / 3), i % 3).has_value();
    return std::make_shared<const Discretisation>(mesh, fixed);
  }

  NewtonResult solve(double tolerance = 1e-15) const {
    NewtonOptions options;
    options.relativeTolerance = tolerance;
    SparseCholesky cholesky(std::make_shared<const CholeskyPlan>(assembler.pattern()));
    return NewtonSolver(assembler, cholesky, options, {}).solve(loading);
  }

  /// Sum of the internal forces' component over the nodes where the condition holds.
  double reaction(const NewtonResult& result, int component,
                  const std::function<bool(const Eigen::Vector3d&)>& where) const {
    double sum = 0;
    for (int n = 0; n < mesh.nodeCount(); ++n)
      if (where(mesh.nodes_mm.col(n))) sum += result.internalForces(3 * n + component);
    return sum;
  }
};

inline Material rubberOf(double poissonRatio) {
  Material material;
  material.poissonRatio = poissonRatio;
  return material;
}

} // namespace palp::test
