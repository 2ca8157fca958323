#include "solver/field/HeterogeneousConductivity.h"

#include "model/FieldAtRest.h"
#include "solver/SensorMesh.h"
#include "solver/field/DeformedGreen.h"
#include "tests/model/RandomLayout.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <chrono>
#include <stop_token>
#include <thread>

namespace palp {
namespace {

constexpr std::array kEachReadout{Readout::Floating, Readout::VirtualGround, Readout::RowsGrounded,
                                  Readout::OthersAtHalf};

/// A small random block at rest whose conductivity is ours to choose.
struct HeterogeneousBlock {
  explicit HeterogeneousBlock(unsigned seed, double meshSize = 1)
      : HeterogeneousBlock(randomLayout(seed, 0.8), meshSize) {}
  HeterogeneousBlock(SensorDesign of, double meshSize) : design(std::move(of)) {
    mesh = sensorMesh(design, {.meshSize_mm = meshSize * standardMeshSize_mm(design), .mapped = {}});
    electrodes = electrodes_mm(design);
    green.emplace(mesh, design.block_mm, electrodes);
  }
  /// With k = 1 at least, and above that what it is at each node.
  [[nodiscard]] FieldState with(const std::function<double(const Eigen::Vector3d&)>& conductivity) const {
    const Eigen::Matrix3Xd& nodes = green->mesh().tets().nodes_mm;
    FieldState state{nodes,
                     electrodes,
                     {Eigen::VectorXd(nodes.cols()), {.p0_MPa = 1, .exponent = 1}},
                     law.electrodeRadius_mm}; // k = 1 + p
    for (Eigen::Index n = 0; n < nodes.cols(); ++n)
      state.conductivity.pressures_MPa(n) = conductivity(nodes.col(n)) - 1;
    return state;
  }
  [[nodiscard]] Eigen::MatrixXd potentials(const FieldState& state, int threads = 2) const {
    const Eigen::VectorXd conductivities =
        state.conductivity.heterogeneous() ? green->conductivities(state) : Eigen::VectorXd();
    return potentials_ohm(*green->at(state, threads, {}), law, SphereModel::Dipoles, conductivities);
  }
  [[nodiscard]] Eigen::MatrixXd resistances(const FieldState& state, Readout readout) const {
    return NetworkReading({potentials(state), wireCounts(design), 0}, readout).resistances_ohm();
  }

  SensorDesign design;
  FieldLaw law{.electrodeRadius_mm = 0.1};
  Mesh mesh;
  Eigen::Matrix3Xd electrodes;
  std::optional<DeformedGreen> green;
};

/// What a current of zero sum sees of P.
Eigen::MatrixXd seen(const Eigen::MatrixXd& p) {
  Eigen::MatrixXd rows = p.rowwise() - p.colwise().mean();
  rows.colwise() -= rows.rowwise().mean().eval();
  return rows;
}

class HeterogeneousConductivityOf : public testing::TestWithParam<unsigned> {};

TEST_P(HeterogeneousConductivityOf, AnEvenOneScalesExactly) {
  const HeterogeneousBlock block(GetParam());
  const FieldState plain{block.green->mesh().tets().nodes_mm, block.electrodes, {}};
  const FieldState better = block.with([](const Eigen::Vector3d&) { return 1.7; });
  for (const Readout readout : kEachReadout)
    EXPECT_LT((block.resistances(better, readout) * 1.7 - block.resistances(plain, readout)).norm(),
              1e-9 * block.resistances(plain, readout).norm())
        << kReadouts.name(readout);
}

/// k = 1 + e z changes P by - e integral z grad G_p . grad G_q, which Green's identity takes to the faces:
///   - e (z_p + z_q) G_pq / 2 - e (integral over the bottom - that over the top of G_p G_q) / 2,
/// and P_pp, its singular part with it, alike. Here of G in closed form.
Eigen::MatrixXd changeBySlope(const Eigen::Vector3d& block_mm, const Eigen::Matrix3Xd& electrodes,
                              const FieldLaw& law) {
  constexpr int cells = 48; // by the midpoint rule, 1e-4 of what it is where electrodes are a fifth of the height away
  constexpr double inside = 0.01; // G is even in the distance from a face
  const Eigen::Index n = electrodes.cols();
  Eigen::MatrixXd change = potentialsAtRest_ohm(block_mm, electrodes, law, SphereModel::Monopoles);
  for (Eigen::Index p = 0; p < n; ++p)
    for (Eigen::Index q = 0; q < n; ++q) change(p, q) *= -(electrodes(2, p) + electrodes(2, q)) / 2;
  for (const bool top : {false, true}) {
    Eigen::MatrixXd onFace(n, cells * cells);
    for (int i = 0; i < cells; ++i) {
      Eigen::Matrix3Xd points(3, n + cells);
      points.leftCols(n) = electrodes;
      for (int j = 0; j < cells; ++j)
        points.col(n + j) << (i + 0.5) / cells * block_mm.x(), (j + 0.5) / cells * block_mm.y(),
            top ? block_mm.z() - inside : inside;
      onFace.middleCols(Eigen::Index(i) * cells, cells) = boxGreen(block_mm, points).value.topRightCorner(n, cells);
    }
    change += (top ? 1 : -1) * law.resistivity_ohm_mm * block_mm.x() * block_mm.y() / (2. * cells * cells) * onFace *
              onFace.transpose();
  }
  return change;
}

TEST_P(HeterogeneousConductivityOf, AWeakSlopeIsFirstOrderTheory) {
  const HeterogeneousBlock block(GetParam());
  constexpr double small = 1e-3;
  const auto along = [&](double e) {
    const FieldState state = block.with([&](const Eigen::Vector3d& x) { return 2 * (1 + e * x.z()); });
    return Eigen::MatrixXd(2 * potentials_ohm(*block.green->at(state, 2, {}), block.law, SphereModel::Monopoles,
                                              block.green->conductivities(state)));
  };
  const Eigen::MatrixXd found = seen((along(small) - along(-small)) / (2 * small));
  const Eigen::MatrixXd exact = seen(changeBySlope(block.design.block_mm, block.electrodes, block.law));
  const Eigen::MatrixXd error = found - exact;
  EXPECT_LT(error.norm(), 1e-3 * exact.norm());
  Eigen::MatrixXd between = exact, errorBetween = error; // what is not at the electrodes themselves
  between.diagonal().setZero();
  errorBetween.diagonal().setZero();
  EXPECT_LT(errorBetween.norm(), 1e-2 * between.norm());
}

TEST_P(HeterogeneousConductivityOf, AStrongOneIsThatOfAFinerMesh) {
  const HeterogeneousBlock coarse(GetParam()), fine(GetParam(), 0.6);
  const auto bump = [](const Eigen::Vector3d& x) { // up to 3 times, as wide as the block is high
    return std::pow(3., std::exp(-(x - Eigen::Vector3d(2, 2, 2)).squaredNorm() / 4));
  };
  const FieldState plain{coarse.green->mesh().tets().nodes_mm, coarse.electrodes, {}};
  for (const Readout readout : kEachReadout) {
    const Eigen::ArrayXXd rest = coarse.resistances(plain, readout).array().log();
    const Eigen::ArrayXXd a = coarse.resistances(coarse.with(bump), readout).array().log() - rest;
    const Eigen::ArrayXXd b = fine.resistances(fine.with(bump), readout).array().log() - rest;
    EXPECT_GT(b.matrix().norm(), 0);
    EXPECT_LT((a - b).matrix().norm(), 0.02 * b.matrix().norm()) << kReadouts.name(readout);
  }
}

TEST_P(HeterogeneousConductivityOf, BetterRubberAnywhereNeverRaisesTheFloatingResistance) {
  const HeterogeneousBlock block(GetParam());
  const FieldState plain{block.green->mesh().tets().nodes_mm, block.electrodes, {}};
  const FieldState better =
      block.with([](const Eigen::Vector3d& x) { return 1 + std::max(0., std::sin(x.x() + x.y())); });
  EXPECT_LT((block.resistances(better, Readout::Floating) - block.resistances(plain, Readout::Floating)).maxCoeff(), 0);
}

TEST_P(HeterogeneousConductivityOf, IsTheSameOnAnyNumberOfThreads) {
  const HeterogeneousBlock block(GetParam());
  const FieldState state = block.with([](const Eigen::Vector3d& x) { return 1 + std::max(0., x.z() - 1); });
  EXPECT_EQ(block.potentials(state, 1), block.potentials(state, 3));
}

INSTANTIATE_TEST_SUITE_P(Seeds, HeterogeneousConductivityOf, testing::Values(1U, 7U, 23U));

/// d ln R of each read-out by this conductivity.
std::vector<Eigen::MatrixXd> changesBy(const HeterogeneousBlock& block,
                                       const std::function<double(const Eigen::Vector3d&)>& conductivity) {
  const FieldState plain{block.green->mesh().tets().nodes_mm, block.electrodes, {}};
  const WireCounts counts = wireCounts(block.design);
  const TerminalNetwork rest(block.potentials(plain), counts, 0),
      heterogeneous(block.potentials(block.with(conductivity)), counts, 0);
  std::vector<Eigen::MatrixXd> changes;
  for (const Readout readout : kEachReadout)
    changes.push_back(NetworkReading(heterogeneous, readout).resistances_ohm().array().log() -
                      NetworkReading(rest, readout).resistances_ohm().array().log());
  return changes;
}

/// Between its parts too, of which the later ones need what the earlier ones leave.
TEST(HeterogeneousConductivity, StopsAtAnyTime) {
  const HeterogeneousBlock block(1);
  const FieldState state = block.with([](const Eigen::Vector3d& x) { return 1 + std::max(0., x.z() - 1); });
  const auto begin = std::chrono::steady_clock::now();
  const Eigen::MatrixXd whole = block.potentials(state, 1);
  const auto takes = std::chrono::steady_clock::now() - begin;
  constexpr int times = 24;
  int stopped = 0;
  for (int i = 0; i < times; ++i) {
    std::stop_source source;
    const std::jthread asks([&] {
      std::this_thread::sleep_for(i * takes / times);
      source.request_stop();
    });
    const auto found = block.green->at(state, 1, source.get_token());
    stopped += found ? 0 : 1;
  }
  EXPECT_GT(stopped, 0);
  EXPECT_EQ(block.potentials(state, 1), whole);
}

/// Where the pressure changes its sign within elements. Cut off at the nodes instead it is 2 to 3 times as far.
TEST(HeterogeneousConductivity, AKinkBetweenNodesIsThatOfAFinerMesh) {
  const auto wave = [](const Eigen::Vector3d& x) { return 1 + 0.3 * std::sin(x.x() + 0.7 * x.y() - x.z()); };
  const auto coarse = changesBy(HeterogeneousBlock(1), wave), fine = changesBy(HeterogeneousBlock(1, 0.6), wave);
  for (std::size_t i = 0; i < kEachReadout.size(); ++i)
    EXPECT_LT((coarse[i] - fine[i]).norm(), 0.05 * fine[i].norm()) << kReadouts.name(kEachReadout[i]);
}

/// A steep law: ten times as well a tenth of a wave's length beside the kink. Quadratic functions alone leave PERCENT %
/// of d ln R.
TEST(HeterogeneousConductivity, ASteepLawIsThatOfAFinerMesh) {
  const auto wave = [](const Eigen::Vector3d& x) { return 1 + 15 * std::sin(x.x() + 0.7 * x.y() - x.z()); };
  const auto coarse = changesBy(HeterogeneousBlock(1), wave), fine = changesBy(HeterogeneousBlock(1, 0.6), wave);
  for (std::size_t i = 0; i < kEachReadout.size(); ++i)
    EXPECT_LT((coarse[i] - fine[i]).norm(), 0.03 * fine[i].norm()) << kReadouts.name(kEachReadout[i]);
}

/// A row-wire that others screen from all lower electrodes: its current is a small difference, and a rule that steps
/// over the kink leaves 2.3 % of its d ln R.
TEST(HeterogeneousConductivity, AKinkAtAScreenedRowIsThatOfAFinerMesh) {
  SensorDesign design;
  design.block_mm = {6, 16, 4};
  design.upper = {{2, 5, 8, 11, 14}, {{1.5, 3, 4.5}}, {{2.4}}};
  design.lower = {{1.5, 3, 4.5}, {{2, 5}}, {{1.4}}};
  const auto wave = [](const Eigen::Vector3d& x) {
    return 1 + 0.1 * std::sin(1.5 * x.x() + 0.2) * std::cos(0.8 * x.y() - 0.5) * (0.5 + x.z() / 4);
  };
  const auto coarse = changesBy({design, 1}, wave), fine = changesBy({design, 0.6}, wave);
  for (std::size_t i = 0; i < kEachReadout.size(); ++i)
    EXPECT_LT((coarse[i] - fine[i]).row(4).norm(), 0.015 * fine[i].row(4).norm()) << kReadouts.name(kEachReadout[i]);
}

} // namespace
} // namespace palp
