#include "tests/solver/TestBlocks.h"

#include "solver/element/RubberStress.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <tuple>
#include <vector>

using namespace palp;
using namespace palp::test;

namespace {

/// Every law with kernels of its own, as stiff as the paper's rubber, far from neo-Hookean, nu = 0.49.
const std::vector<RubberLaw>& curvedLaws() {
  static const std::vector<RubberLaw> laws{MooneyRivlin{}, NeoHooke{0.4}, Yeoh{0.4, -0.05, 0.02}, Gent{0.8, 3},
                                           Ogden{{0.5, 0.25, 0.05}, {1.3, 5, -2}}};
  return laws;
}

Material ofLaw(std::size_t law, double poissonRatio = 0.49) {
  return {curvedLaws()[law], poissonRatio};
}

/// Deformation gradients with distinct, equal and nearly equal stretches.
std::vector<Eigen::Matrix3d> gradients() {
  std::vector<Eigen::Matrix3d> all(1, Eigen::Matrix3d::Identity());
  Eigen::Matrix3d F;
  F << 1.1, 0.2, -0.1, 0.05, 0.9, 0.1, 0.02, -0.03, 1.05;
  all.push_back(F);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  for (const Eigen::Vector3d& stretches :
       {Eigen::Vector3d(1.3, 1.3, 0.6), Eigen::Vector3d(0.8, 1.2, 0.8 + 1e-7), Eigen::Vector3d(1.2, 1.2 + 1e-4, 0.7),
        Eigen::Vector3d(1 + 1e-9, 1, 1 - 1e-9), Eigen::Vector3d(0.6, 1.4, 1.15)})
    all.emplace_back(turn * stretches.asDiagonal() * turn.transpose() *
                     Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX()));
  return all;
}

/// A distorted cube that the gradient deforms alike everywhere, with one pressure.
struct UniformBlock {
  BoundaryValueProblem problem;
  ElementState state;
  UniformBlock(bool tets, const Material& material, const Eigen::Matrix3d& F, double pressure_MPa)
      : problem(tets ? cubeTets(2, 0.15) : cubeHexes(2, 0.15), material,
                [](const Eigen::Vector3d&, int) { return std::optional<double>(); }),
        state(problem.discretisation->atRest()) {
    for (int n = 0; n < problem.mesh.nodeCount(); ++n)
      state.displacements.segment<3>(3 * n) = (F - Eigen::Matrix3d::Identity()) * problem.mesh.nodes_mm.col(n);
    const Discretisation& mesh = *problem.discretisation;
    for (int e = 0; e < lanes * mesh.blocks(); ++e)
      for (int k = mesh.kernels().bubbles; k < mesh.unknowns(); ++k)
        state.unknowns[laneIndex(e, mesh.unknowns(), k)] = pressure_MPa;
  }
  /// Mean P_ij = sum of f_i X_j over the nodes of the unit cube.
  [[nodiscard]] Eigen::Matrix3d meanStress() const {
    ElementTangents tangents;
    ElementForces forces;
    problem.assembler.tangent(state, tangents, forces, 1, {});
    const Eigen::VectorXd f = problem.assembler.sum(forces.raw, 1);
    Eigen::Matrix3d P = Eigen::Matrix3d::Zero();
    for (int n = 0; n < problem.mesh.nodeCount(); ++n)
      P += f.segment<3>(3 * n) * problem.mesh.nodes_mm.col(n).transpose();
    return P;
  }
};

class LawsOfKernels : public testing::TestWithParam<std::tuple<bool, std::size_t>> {
protected:
  bool tets_ = std::get<0>(GetParam());
  std::size_t law_ = std::get<1>(GetParam());
};
INSTANTIATE_TEST_SUITE_P(TetsAndHexes, LawsOfKernels,
                         testing::Combine(testing::Bool(), testing::Range(std::size_t{0}, curvedLaws().size())));

TEST_P(LawsOfKernels, GiveTheStressThatIsWrittenByPrincipalStretches) {
  for (const Eigen::Matrix3d& F : gradients()) {
    const Eigen::Matrix3d expected = firstPiolaStress(ofLaw(law_), F, 0.2);
    const Eigen::Matrix3d P = UniformBlock(tets_, ofLaw(law_), F, 0.2).meanStress();
    EXPECT_LT((P - expected).norm(), 1e-13) << F; // rounding in sums over some hundred elements
  }
}

TEST_P(LawsOfKernels, GiveTheDerivativeOfTheEnergy) {
  constexpr double h = 1e-6; // central differences: h^2 and rounding over h, together about 1e-10
  for (const Eigen::Matrix3d& F : gradients()) {
    const Eigen::Matrix3d P = UniformBlock(tets_, ofLaw(law_), F, 0).meanStress();
    for (int i = 0; i < 9; ++i) {
      Eigen::Matrix3d plus = F, minus = F;
      plus(i) += h;
      minus(i) -= h;
      EXPECT_NEAR(P(i), (isochoricEnergy(ofLaw(law_), plus) - isochoricEnergy(ofLaw(law_), minus)) / (2 * h), 2e-9)
          << F;
    }
  }
}

TEST_P(LawsOfKernels, AreObjective) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -1, 3).normalized()).toRotationMatrix();
  for (const Eigen::Matrix3d& F : gradients()) {
    const Eigen::Matrix3d P = UniformBlock(tets_, ofLaw(law_), F, 0.1).meanStress(),
                          turned = UniformBlock(tets_, ofLaw(law_), turn * F, 0.1).meanStress();
    EXPECT_LT((turned - turn * P).norm(), 1e-13) << F;
  }
}

TEST_P(LawsOfKernels, HaveTheTangentOfTheirForces) {
  for (const Eigen::Matrix3d& F : gradients()) {
    UniformBlock block(tets_, ofLaw(law_), F, 0.1);
    const Assembler& assembler = block.problem.assembler;
    Eigen::VectorXd du(block.state.displacements.size());
    for (Eigen::Index i = 0; i < du.size(); ++i) {
      block.state.displacements(i) += 0.01 * std::sin(7. * double(i)) * (F.isIdentity() ? 0 : 1);
      du(i) = std::cos(5. * double(i));
    }
    ElementTangents tangents;
    ElementForces forces;
    assembler.tangent(block.state, tangents, forces, 1, {});
    ElementForces none = forces;
    std::fill(none.local.begin(), none.local.end(), 0.);
    const LaneVector dx = assembler.recover(tangents, none, du, 1);
    const auto rawForces = [&](double step) {
      ElementState moved = block.state;
      moved.displacements += step * du;
      for (std::size_t i = 0; i < dx.size(); ++i) moved.unknowns[i] += step * dx[i];
      ElementForces f;
      assembler.residual(moved, tangents, f, 1);
      return assembler.sum(f.raw, 1);
    };
    constexpr double h = 1e-6;
    const Eigen::VectorXd difference = (rawForces(h) - rawForces(-h)) / (2 * h),
                          product = assembler.stiffnessTimes(tangents, du);
    EXPECT_LT((difference - product).norm(), 1e-7 * product.norm()) << F;
  }
}

/// Forces, residuals of the elements' own unknowns and the tangent of some 8 elements under one state.
struct KernelOutput {
  std::vector<double> numbers;
  explicit KernelOutput(const LawKernels& kernels, const UniformBlock& block, double scale) {
    const Discretisation& mesh = *block.problem.discretisation;
    const std::size_t d = std::size_t(mesh.elementDofs()), x = std::size_t(mesh.unknowns());
    std::vector<double> u(d * lanes), own(x * lanes), f(d * lanes), local(x * lanes), range(2 * lanes, 1),
        K(d * (d + 1) / 2 * lanes), W(x * d * lanes), inverse(x * (x + 1) / 2 * lanes);
    mesh.gather(0, block.state.displacements, u.data());
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += scale * 0.05 * std::sin(3. * double(i));
    for (std::size_t i = 0; i < own.size(); ++i) own[i] = scale * 0.1 * std::cos(2. * double(i));
    kernels.tangent(rubberConstants(block.problem.material), {mesh.geometry(0), u.data(), own.data()},
                    {f.data(), local.data(), range.data()}, {K.data(), W.data(), inverse.data()});
    for (const auto* part : {&f, &local, &range, &K, &W, &inverse})
      numbers.insert(numbers.end(), part->begin(), part->end());
  }
};

TEST_P(LawsOfKernels, WriteTheSameNumbersOnEveryInstructionSet) {
  const UniformBlock block(tets_, ofLaw(law_), gradients()[1], 0.1);
  const ElementShape shape = block.problem.mesh.shape;
  const auto of = [&](InstructionSet set) {
    return KernelOutput(elementKernels(shape, set)->of(block.problem.assembler.rubber()), block, 1).numbers;
  };
  const std::vector<double> baseline = of(InstructionSet::Baseline);
  for (const InstructionSet set : {InstructionSet::Avx2, InstructionSet::Avx512}) {
    if (!elementKernels(shape, set)) continue; // ElementKernelsTest says which are not tested
    const std::vector<double> wide = of(set);
    double largest = 0, difference = 0;
    for (std::size_t i = 0; i < wide.size(); ++i) {
      largest = std::max(largest, std::abs(baseline[i]));
      difference = std::max(difference, std::abs(wide[i] - baseline[i]));
    }
    EXPECT_LE(difference, 1e-11 * largest);
  }
}

TEST_P(LawsOfKernels, OfEightLoadsAgreeInBothPrecisions) {
  const UniformBlock block(tets_, ofLaw(law_), Eigen::Matrix3d::Identity(), 0);
  const Discretisation& mesh = *block.problem.discretisation;
  const LawKernels& kernels = mesh.kernels().of(block.problem.assembler.rubber());
  const std::size_t d = std::size_t(mesh.elementDofs()), x = std::size_t(mesh.unknowns());
  std::vector<double> geometry(std::size_t(mesh.kernels().geometrySize));
  for (std::size_t i = 0; i < geometry.size(); ++i) geometry[i] = mesh.geometry(0)[i * lanes];
  for (const double load : {1e-7, 1e-3, 1.}) {
    std::vector<double> u(d * lanes), own(x * lanes);
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = load * 0.03 * std::sin(3. * double(i));
    for (std::size_t i = 0; i < own.size(); ++i) own[i] = load * 0.02 * std::cos(2. * double(i));
    const auto forces = [&](auto kernel) {
      std::vector<double> f(d * lanes), local(x * lanes), range(2 * lanes, 1);
      kernel(block.problem.assembler.rubber(), {geometry.data(), u.data(), own.data()},
             {f.data(), local.data(), range.data()});
      return f;
    };
    const std::vector<double> exact = forces(kernels.residualOfLoads), single = forces(kernels.residualOfLoadsInSingle);
    double largest = 0, difference = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      largest = std::max(largest, std::abs(exact[i]));
      difference = std::max(difference, std::abs(exact[i] - single[i]));
    }
    EXPECT_LE(difference, 1e-6 * largest) << load; // a few roundings of 6e-8
  }
}

TEST(GentKernels, ReportWhereTheLawDoesNotAllowTheStretch) {
  const Material gent{Gent{0.8, 0.5}};
  for (const bool tets : {false, true})
    for (const double stretch : {1.3, 1.5}) { // I1 - 3 = 0.228 and 0.583
      const Eigen::Vector3d stretches(stretch, 1 / std::sqrt(stretch), 1 / std::sqrt(stretch));
      const UniformBlock block(tets, gent, stretches.asDiagonal(), 0);
      ElementTangents tangents;
      ElementForces forces;
      block.problem.assembler.tangent(block.state, tangents, forces, 1, {});
      if (stretch < 1.4)
        EXPECT_NEAR(forces.smallestJ, 1, 1e-12);
      else
        EXPECT_EQ(forces.smallestJ, -std::numeric_limits<double>::infinity());
    }
}

TEST(OgdenKernels, WithExponentsTwoAndMinusTwoAreMooneyRivlins) {
  const MooneyRivlin mooney;
  const Material ogden{Ogden{{2 * mooney.c10_MPa, 2 * mooney.c01_MPa}, {2, -2}}};
  for (const Eigen::Matrix3d& F : gradients()) {
    const Eigen::Matrix3d same = UniformBlock(true, Material{mooney}, F, 0.1).meanStress();
    EXPECT_LT((UniformBlock(true, ogden, F, 0.1).meanStress() - same).norm(), 1e-13) << F;
  }
}

} // namespace
