#include "tests/solver/TestBlocks.h"

#include "solver/CalculixDeck.h"
#include "solver/SensorMesh.h"
#include "solver/element/MooneyRivlin.h"
#include "solver/linear/NestedDissection.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace palp;
using namespace palp::test;

namespace palp::baseline {
extern const ElementKernels tetKernels;
extern const ElementKernels hexKernels;
} // namespace palp::baseline

namespace {

TEST(MooneyRivlin, StressIsTheDerivativeOfTheEnergy) {
  const Material material;
  Eigen::Matrix3d F;
  F << 1.1, 0.2, -0.1, 0.05, 0.9, 0.1, 0.02, -0.03, 1.05;
  const Eigen::Matrix3d P = firstPiolaStress(material, F, 0);
  for (int i = 0; i < 9; ++i) {
    Eigen::Matrix3d plus = F, minus = F;
    plus(i) += 1e-6;
    minus(i) -= 1e-6;
    // Central differences: their error is h^2 and rounding over h, together about 1e-10.
    EXPECT_NEAR(P(i), (isochoricEnergy(material, plus) - isochoricEnergy(material, minus)) / 2e-6, 1e-9);
  }
}

/// A deformed state of a distorted cube, with its unknowns.
struct Deformed {
  BoundaryValueProblem problem;
  ElementState state;
  explicit Deformed(Mesh mesh)
      : problem(std::move(mesh), rubberOf(0.49), [](const Eigen::Vector3d&, int) { return std::optional<double>(); }),
        state(problem.discretisation->atRest()) {
    for (Eigen::Index i = 0; i < state.displacements.size(); ++i)
      state.displacements(i) = 0.02 * std::sin(7. * double(i));
    for (std::size_t i = 0; i < state.unknowns.size(); ++i) state.unknowns[i] = 0.01 * std::cos(3. * double(i));
  }
};

class Kernels : public testing::TestWithParam<bool> {
protected:
  Deformed deformed_{GetParam() ? cubeTets(2, 0.15) : cubeHexes(2, 0.15)};
};
INSTANTIATE_TEST_SUITE_P(TetsAndHexes, Kernels, testing::Bool());

TEST_P(Kernels, TangentIsTheDerivativeOfTheForcesWithTheLocalUnknownsEliminated) {
  const Assembler& assembler = deformed_.problem.assembler;
  ElementTangents tangents;
  ElementForces forces;
  assembler.tangent(deformed_.state, tangents, forces, 1, {});
  Eigen::VectorXd du(deformed_.state.displacements.size());
  for (Eigen::Index i = 0; i < du.size(); ++i) du(i) = std::cos(5. * double(i));
  ElementForces none = forces;
  std::fill(none.local.begin(), none.local.end(), 0.);
  const LaneVector dx = assembler.recover(tangents, none, du, 1);
  constexpr double h = 1e-6;
  const auto rawForces = [&](double step) {
    ElementState moved = deformed_.state;
    moved.displacements += step * du;
    for (std::size_t i = 0; i < dx.size(); ++i) moved.unknowns[i] += step * dx[i];
    ElementForces f;
    assembler.residual(moved, tangents, f, 1);
    return assembler.sum(f.raw, 1);
  };
  const Eigen::VectorXd difference = (rawForces(h) - rawForces(-h)) / (2 * h);
  const Eigen::VectorXd product = assembler.stiffnessTimes(tangents, du);
  EXPECT_LT((difference - product).norm(), 1e-7 * product.norm());
}

TEST_P(Kernels, OfTheBaselineAgreeWithTheWidest) {
  const Discretisation& mesh = *deformed_.problem.discretisation;
  const ElementKernels& baseline = GetParam() ? baseline::tetKernels : baseline::hexKernels;
  std::vector<double> u(mesh.elementDofs() * lanes), f(u.size()), g(u.size()), r(mesh.unknowns() * lanes), s(r.size());
  std::vector<double> range(2 * lanes, 1), other(2 * lanes, 1);
  mesh.gather(0, deformed_.state.displacements, u.data());
  const RubberConstants rubber = rubberConstants(rubberOf(0.49));
  const ElementInput in{mesh.geometry(0), u.data(), deformed_.state.unknowns.data()};
  mesh.kernels().residual(rubber, in, {f.data(), r.data(), range.data()});
  baseline.residual(rubber, in, {g.data(), s.data(), other.data()});
  for (std::size_t i = 0; i < f.size(); ++i) EXPECT_NEAR(f[i], g[i], 1e-13); // forces of order 0.1: rounding
  for (std::size_t i = 0; i < r.size(); ++i) EXPECT_NEAR(r[i], s[i], 1e-13);
}

TEST(NestedDissection, OrdersEveryGroupOnceWithLittleFill) {
  const BoundaryValueProblem p(cubeTets(8, 0.1), rubberOf(0.49),
                               [](const Eigen::Vector3d&, int) { return std::optional<double>(); });
  const SparsePattern& pattern = *p.assembler.pattern();
  std::vector<int> order = nestedDissection(pattern);
  const SupernodeTree tree = supernodeTree(pattern);
  double numbers = 0;
  for (int s = 0; s < tree.count(); ++s) numbers += double(tree.width(s)) * tree.height(s);
  // A band matrix of this grid, in the order of its planes, has (2 n + 1)^2 unknowns across for each of its own.
  EXPECT_LT(numbers, 0.6 * pattern.size() * 17 * 17 * 3);
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(order[i], static_cast<int>(i));
}

TEST(Convergence, HasTheElementsOrder) {
  // Small displacements u = grad phi with phi harmonic need no body force and no pressure; amplitude 1e-6 keeps the
  // nonlinear terms far below the mesh's error.
  constexpr double k = 3;
  const auto exact = [](const Eigen::Vector3d& x) {
    const double e = 1e-6 * std::exp(k * x.x() / std::sqrt(2.)), a = k * x.y(), b = k * x.z() / std::sqrt(2.);
    return Eigen::Vector3d(e * std::cos(a) * std::cosh(b) / std::sqrt(2.), -e * std::sin(a) * std::cosh(b),
                           e * std::cos(a) * std::sinh(b) / std::sqrt(2.));
  };
  std::vector<double> errors;
  for (const int n : {4, 8}) {
    const BoundaryValueProblem p(cubeTets(n, 0), rubberOf(0.499), [&](const Eigen::Vector3d& x, int d) {
      const bool boundary = x.minCoeff() < 1e-9 || x.maxCoeff() > 1 - 1e-9;
      return boundary ? std::optional(exact(x)(d)) : std::nullopt;
    });
    const NewtonResult result = p.solve(1e-9);
    ASSERT_TRUE(result.converged) << result.stopReason;
    double square = 0;
    for (int i = 0; i < p.mesh.nodeCount(); ++i)
      square += (result.increments.back().state.displacements.segment<3>(3 * i) - exact(p.mesh.nodes_mm.col(i)))
                    .squaredNorm();
    errors.push_back(std::sqrt(square / p.mesh.nodeCount()));
  }
  EXPECT_GT(std::log2(errors[0] / errors[1]), 2.7); // quadratic elements: third order in the displacements
}

TEST(CalculixDeck, HoldsTheMeshTheMaterialAndTheWholeLoad) {
  const SensorDesign design = paperDesign();
  const Mesh mesh = sensorMesh(design, {.meshSize_mm = {}, .mapped = std::array{3, 2, 1}});
  const std::string deck = calculixDeck(design, mesh, {{{0, {0, 0, -6}}}, {}});
  for (const char* part :
       {"*ELEMENT, TYPE=C3D8", "*HYPERELASTIC, MOONEY-RIVLIN", "BOTTOM, 1, 3", "*CLOAD\n", ", 3, -1.5\n"})
    EXPECT_NE(deck.find(part), std::string::npos) << part;
}

} // namespace
