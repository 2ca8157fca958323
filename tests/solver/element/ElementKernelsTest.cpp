#include "tests/solver/TestBlocks.h"

#include "solver/element/RubberStress.h"
#include "solver/linear/NestedDissection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <tuple>

namespace palp {
/// In the names of the tests.
static void PrintTo(InstructionSet set, std::ostream* out) {
  constexpr std::array words{"baseline", "AVX2", "AVX-512"};
  *out << words.at(static_cast<std::size_t>(set));
}
} // namespace palp

using namespace palp;
using namespace palp::test;

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

/// All that the kernels write for the state, block by block.
struct Written {
  std::vector<double> forces, local, range, stiffness, elimination, inverse, condensed, recovered;
  [[nodiscard]] std::array<std::pair<const char*, const std::vector<double>*>, 8> parts() const {
    return {{{"forces", &forces},
             {"local", &local},
             {"range", &range},
             {"stiffness", &stiffness},
             {"elimination", &elimination},
             {"inverse", &inverse},
             {"condensed", &condensed},
             {"recovered", &recovered}}};
  }
  void append(const Written& more) {
    const auto add = [](std::vector<double>& to, const std::vector<double>& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    add(forces, more.forces);
    add(local, more.local);
    add(range, more.range);
    add(stiffness, more.stiffness);
    add(elimination, more.elimination);
    add(inverse, more.inverse);
    add(condensed, more.condensed);
    add(recovered, more.recovered);
  }
};

Written emptyBlock(const Discretisation& mesh) {
  const std::size_t d = mesh.elementDofs(), x = mesh.unknowns();
  Written out;
  out.forces.resize(d * lanes);
  out.local.resize(x * lanes);
  out.range.assign(2 * lanes, 1);
  out.stiffness.resize(d * (d + 1) / 2 * lanes);
  out.elimination.resize(x * d * lanes);
  out.inverse.resize(x * (x + 1) / 2 * lanes);
  out.recovered.resize(x * lanes);
  return out;
}

/// 8 elements a call: residual, tangent, condensation and recovery of all blocks.
Written ofElements(const ElementKernels& kernels, const Deformed& deformed) {
  const Discretisation& mesh = *deformed.problem.discretisation;
  const RubberConstants rubber = rubberConstants(rubberOf(0.49));
  Written all;
  for (int b = 0; b < mesh.blocks(); ++b) {
    Written out = emptyBlock(mesh);
    std::vector<double> u(out.forces.size());
    mesh.gather(b, deformed.state.displacements, u.data());
    const ElementInput in{mesh.geometry(b), u.data(),
                          deformed.state.unknowns.data() + std::size_t(b) * mesh.unknowns() * lanes};
    kernels.of(rubber).residual(rubber, in, {out.forces.data(), out.local.data(), out.range.data()});
    out.condensed = out.forces;
    // The tangent's kernel writes the same forces again.
    kernels.of(rubber).tangent(rubber, in, {out.forces.data(), out.local.data(), out.range.data()},
                               {out.stiffness.data(), out.elimination.data(), out.inverse.data()});
    for (std::size_t i = 0; i < out.forces.size(); ++i) EXPECT_NEAR(out.condensed[i], out.forces[i], 1e-13);
    kernels.condense(out.elimination.data(), out.local.data(), out.condensed.data());
    kernels.recover(out.elimination.data(), out.inverse.data(), out.local.data(), u.data(), out.recovered.data());
    all.append(out);
  }
  return all;
}

/// One element and 8 loads a call: for each element the 8 lanes' states of its block, all on its own geometry.
Written ofLoads(const ElementKernels& kernels, const Deformed& deformed) {
  const Discretisation& mesh = *deformed.problem.discretisation;
  const RubberConstants rubber = rubberConstants(rubberOf(0.49));
  const Written tangents = ofElements(*elementKernels(deformed.problem.mesh.shape, InstructionSet::Baseline), deformed);
  const auto lane = [](const std::vector<double>& values, std::size_t size, int element) {
    std::vector<double> one(size);
    for (std::size_t i = 0; i < size; ++i) one[i] = values[(element / lanes * size + i) * lanes + element % lanes];
    return one;
  };
  Written all;
  for (int e = 0; e < mesh.elements(); ++e) {
    Written out = emptyBlock(mesh);
    const std::size_t items = kernels.geometrySize, x = mesh.unknowns(), d = mesh.elementDofs();
    std::vector<double> u(d * lanes), geometry(items);
    mesh.gather(e / lanes, deformed.state.displacements, u.data());
    for (double& v : u) v *= 0.2; // small: these are other elements' displacements
    for (std::size_t i = 0; i < items; ++i) geometry[i] = mesh.geometry(e / lanes)[i * lanes + e % lanes];
    const std::vector<double> elimination = lane(tangents.elimination, x * d, e),
                              inverse = lane(tangents.inverse, x * (x + 1) / 2, e);
    const ElementInput in{geometry.data(), u.data(),
                          deformed.state.unknowns.data() + std::size_t(e / lanes) * x * lanes};
    kernels.of(rubber).residualOfLoads(rubber, in, {out.forces.data(), out.local.data(), out.range.data()});
    out.condensed = out.forces;
    kernels.condenseLoads(elimination.data(), out.local.data(), out.condensed.data());
    kernels.recoverLoads(elimination.data(), inverse.data(), out.local.data(), u.data(), out.recovered.data());
    all.append(out);
  }
  return all;
}

void expectSame(const Written& ours, const Written& theirs) {
  const auto ourParts = ours.parts(), theirParts = theirs.parts();
  for (std::size_t p = 0; p < ourParts.size(); ++p) {
    const auto& [name, a] = ourParts[p];
    const std::vector<double>& b = *theirParts[p].second;
    ASSERT_EQ(a->size(), b.size()) << name;
    double largest = 0, difference = 0;
    for (std::size_t i = 0; i < b.size(); ++i) {
      ASSERT_TRUE(std::isfinite((*a)[i])) << name << " " << i;
      largest = std::max(largest, std::abs(b[i]));
      difference = std::max(difference, std::abs((*a)[i] - b[i]));
    }
    EXPECT_LE(difference, 1e-11 * largest) << name; // rounding, in sums of a few hundred terms
  }
}

/// Every instruction set against the baseline's, on every block and lane, the filled ones of the last block as well.
class InstructionSets : public testing::TestWithParam<std::tuple<bool, InstructionSet>> {};
INSTANTIATE_TEST_SUITE_P(TetsAndHexes, InstructionSets,
                         testing::Combine(testing::Bool(),
                                          testing::Values(InstructionSet::Avx2, InstructionSet::Avx512)));

TEST_P(InstructionSets, WriteTheSameNumbersAsTheBaseline) {
  const auto [tets, set] = GetParam();
  Mesh mesh = tets ? cubeTets(2, 0.15) : cubeHexes(3, 0.15);
  mesh.elements.conservativeResize(Eigen::NoChange, mesh.elementCount() - 2); // the last block is not full
  const ElementKernels* kernels = elementKernels(mesh.shape, set);
  const ElementKernels& baseline = *elementKernels(mesh.shape, InstructionSet::Baseline);
  if (!kernels)
    GTEST_SKIP() << "NOT TESTED: this processor has no " << (set == InstructionSet::Avx2 ? "AVX2" : "AVX-512");
  const Deformed deformed(mesh);
  ASSERT_GT(deformed.problem.discretisation->blocks(), 2);
  ASSERT_NE(deformed.problem.discretisation->elements() % lanes, 0);
  expectSame(ofElements(*kernels, deformed), ofElements(baseline, deformed));
  expectSame(ofLoads(*kernels, deformed), ofLoads(baseline, deformed));
}

TEST_P(Kernels, OfOneElementAndEightLoadsAgreeWithThoseOfEightElements) {
  // On elements that are all alike both kinds see the same eight problems.
  Mesh mesh = deformed_.problem.mesh;
  for (Eigen::Index e = 1; e < mesh.elements.cols(); ++e) mesh.elements.col(e) = mesh.elements.col(0);
  Deformed alike(mesh);
  for (std::size_t i = 0; i < alike.state.unknowns.size(); ++i)
    alike.state.unknowns[i] = 0.01 * std::cos(3. * double(i / lanes % alike.problem.discretisation->unknowns()));
  const Discretisation& discretisation = *alike.problem.discretisation;
  const ElementKernels& kernels = discretisation.kernels();
  const RubberConstants rubber = rubberConstants(rubberOf(0.49));
  Written eight = emptyBlock(discretisation), one = eight;
  std::vector<double> u(eight.forces.size()), geometry(kernels.geometrySize);
  discretisation.gather(0, alike.state.displacements, u.data());
  for (std::size_t i = 0; i < geometry.size(); ++i) geometry[i] = discretisation.geometry(0)[i * lanes];
  kernels.of(rubber).residual(rubber, {discretisation.geometry(0), u.data(), alike.state.unknowns.data()},
                              {eight.forces.data(), eight.local.data(), eight.range.data()});
  kernels.of(rubber).residualOfLoads(rubber, {geometry.data(), u.data(), alike.state.unknowns.data()},
                                     {one.forces.data(), one.local.data(), one.range.data()});
  for (std::size_t i = 0; i < one.forces.size(); ++i) EXPECT_NEAR(one.forces[i], eight.forces[i], 1e-13) << i;
  for (std::size_t i = 0; i < one.local.size(); ++i) EXPECT_NEAR(one.local[i], eight.local[i], 1e-13) << i;
  for (std::size_t i = 0; i < one.range.size(); ++i) EXPECT_NEAR(one.range[i], eight.range[i], 1e-13) << i;
}

/// The smallest load leaves as many digits as a large one, as nothing cancels.
TEST_P(Kernels, InSinglePrecisionAreExactToItUnderAnyLoad) {
  const Discretisation& mesh = *deformed_.problem.discretisation;
  const ElementKernels& kernels = mesh.kernels();
  const RubberConstants rubber = rubberConstants(rubberOf(0.49));
  for (const double load : {1e-8, 1e-3, 1.})
    for (int e = 0; e < mesh.elements(); ++e) {
      Written exact = emptyBlock(mesh), single = exact;
      std::vector<double> u(exact.forces.size()), x(exact.local.size()), geometry(kernels.geometrySize);
      mesh.gather(e / lanes, deformed_.state.displacements, u.data());
      for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = load * deformed_.state.unknowns[std::size_t(e / lanes) * x.size() + i];
      for (double& v : u) v *= load;
      for (std::size_t i = 0; i < geometry.size(); ++i) geometry[i] = mesh.geometry(e / lanes)[i * lanes + e % lanes];
      const ElementInput in{geometry.data(), u.data(), x.data()};
      kernels.of(rubber).residualOfLoads(rubber, in, {exact.forces.data(), exact.local.data(), exact.range.data()});
      kernels.of(rubber).residualOfLoadsInSingle(rubber, in,
                                                 {single.forces.data(), single.local.data(), single.range.data()});
      const auto differ = [](const std::vector<double>& a, const std::vector<double>& b) {
        double largest = 0, difference = 0;
        for (std::size_t i = 0; i < b.size(); ++i) {
          largest = std::max(largest, std::abs(b[i]));
          difference = std::max(difference, std::abs(a[i] - b[i]));
        }
        return difference / largest;
      };
      // A few roundings of 6e-8 in the largest of an element's terms.
      EXPECT_LE(differ(single.forces, exact.forces), 1e-6) << load << " element " << e;
      EXPECT_LE(differ(single.local, exact.local), 1e-6) << load << " element " << e;
      EXPECT_LE(differ(single.range, exact.range), 1e-6) << load << " element " << e;
    }
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

} // namespace
