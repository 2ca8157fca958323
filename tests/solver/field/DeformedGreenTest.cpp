#include "solver/field/DeformedGreen.h"

#include "model/DesignError.h"
#include "model/FieldAtRest.h"
#include "model/FieldSensitivity.h"
#include "solver/SensorMesh.h"
#include "tests/model/RandomLayout.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <random>

namespace palp {
namespace {

constexpr std::array kAll{Readout::Floating, Readout::VirtualGround, Readout::RowsGrounded, Readout::OthersAtHalf};

/// A small random block of a few wires, its mesh and the field on it.
struct Block {
  explicit Block(unsigned seed, bool hexahedra = false) : design(randomLayout(seed, 0.8)) {
    MeshOptions options;
    if (hexahedra) options.mapped = std::array<int, 3>{12, 12, 8};
    mesh = sensorMesh(design, options);
    electrodes = electrodes_mm(design);
    green.emplace(mesh, design.block_mm, electrodes);
  }

  [[nodiscard]] FieldState moved(const Eigen::Matrix3d& F, const Eigen::Vector3d& by = Eigen::Vector3d::Zero()) const {
    return {(F * green->mesh().tets().nodes_mm).colwise() + by, (F * electrodes).colwise() + by};
  }
  [[nodiscard]] BoxGreen at(const FieldState& state, int threads = 2) const { return *green->at(state, threads, {}); }
  [[nodiscard]] Eigen::MatrixXd resistances(const BoxGreen& g, Readout readout, const FieldLaw& law) const {
    return NetworkReading({potentials_ohm(g, law), wireCounts(design), law.wire_ohm}, readout).resistances_ohm();
  }

  SensorDesign design;
  Mesh mesh;
  Eigen::Matrix3Xd electrodes;
  std::optional<DeformedGreen> green;
};

double largestDifference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a.cwiseQuotient(b).array() - 1).abs().maxCoeff();
}

/// Displacements of a smooth bending of the block, bottom fixed.
Eigen::Matrix3Xd bending(const Block& block, const Eigen::Matrix3Xd& x) {
  Eigen::Matrix3Xd u(3, x.cols());
  for (Eigen::Index i = 0; i < x.cols(); ++i)
    u.col(i) = x(2, i) / block.design.block_mm.z() *
               Eigen::Vector3d(std::sin(x(1, i)), std::cos(0.7 * x(0, i)), -std::sin(0.5 * x(0, i) + x(1, i)));
  return u;
}

FieldState bent(const Block& block, double amount) {
  const Eigen::Matrix3Xd& nodes = block.green->mesh().tets().nodes_mm;
  return {nodes + amount * bending(block, nodes), block.electrodes + amount * bending(block, block.electrodes)};
}

class DeformedGreenOf : public testing::TestWithParam<unsigned> {};

TEST_P(DeformedGreenOf, ABlockAtRestIsTheClosedForm) {
  const Block block(GetParam());
  const BoxGreen found = block.at(block.moved(Eigen::Matrix3d::Identity()));
  const BoxGreen exact = boxGreen(block.design.block_mm, block.electrodes);
  const FieldLaw law{.resistivity_ohm_mm = 2000, .electrodeRadius_mm = 0.1};
  for (const Readout readout : kAll) // 2e-3 is asked for
    EXPECT_LT(largestDifference(block.resistances(found, readout, law), block.resistances(exact, readout, law)), 5e-4)
        << kReadouts.name(readout);
}

TEST_P(DeformedGreenOf, AnEvenStretchIsTheClosedFormOfTheStretchedBox) {
  const Block block(GetParam());
  const Eigen::Vector3d stretch(1.08, 0.95, 0.97);
  const BoxGreen found = block.at(block.moved(stretch.asDiagonal()));
  const BoxGreen exact = boxGreen(block.design.block_mm.cwiseProduct(stretch), stretch.asDiagonal() * block.electrodes);
  const FieldLaw law{.resistivity_ohm_mm = 2000, .electrodeRadius_mm = 0.1};
  for (const Readout readout : kAll)
    EXPECT_LT(largestDifference(block.resistances(found, readout, law), block.resistances(exact, readout, law)), 5e-4)
        << kReadouts.name(readout);
}

TEST_P(DeformedGreenOf, ARigidMotionChangesNothing) {
  const Block block(GetParam());
  const FieldState state = bent(block, 0.05);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const Eigen::Vector3d by(3, -40, 7);
  const BoxGreen before = block.at(state);
  const BoxGreen after = block.at({(R * state.nodes_mm).colwise() + by, (R * state.electrodes_mm).colwise() + by});
  for (const Readout readout : kAll) // what rounding leaves
    EXPECT_LT(largestDifference(block.resistances(after, readout, {}), block.resistances(before, readout, {})), 1e-9)
        << kReadouts.name(readout);
}

TEST_P(DeformedGreenOf, ALargerBlockWithLargerSpheresHasSmallerResistances) {
  const Block block(GetParam());
  const FieldState state = bent(block, 0.05);
  const double s = 3;
  const BoxGreen small = block.at(state), large = block.at({s * state.nodes_mm, s * state.electrodes_mm});
  const FieldLaw law{.electrodeRadius_mm = 0.15}, scaled{.electrodeRadius_mm = s * 0.15};
  for (const Readout readout : kAll)
    EXPECT_LT(largestDifference(s * block.resistances(large, readout, scaled), block.resistances(small, readout, law)),
              1e-9);
}

TEST_P(DeformedGreenOf, NetworksAreReciprocalAndTheirRowsSumToNothing) {
  const Block block(GetParam());
  const BoxGreen green = block.at(bent(block, 0.1));
  const TerminalNetwork network(potentials_ohm(green, {}), wireCounts(block.design), 0);
  const Eigen::MatrixXd& y = network.conductances();
  const double scale = y.diagonal().maxCoeff();
  EXPECT_LT((y - y.transpose()).cwiseAbs().maxCoeff(), 1e-12 * scale);
  EXPECT_LT(y.rowwise().sum().cwiseAbs().maxCoeff(), 1e-10 * scale);
  for (Eigen::Index i = 0; i < y.rows(); ++i)
    for (Eigen::Index j = 0; j < y.cols(); ++j)
      if (i != j) {
        EXPECT_LT(y(i, j), 0) << i << ' ' << j;
      }
}

TEST_P(DeformedGreenOf, LargerSpheresNeverRaiseResistances) {
  const Block block(GetParam());
  const BoxGreen green = block.at(bent(block, 0.1));
  const Eigen::MatrixXd thin = block.resistances(green, Readout::Floating, {.electrodeRadius_mm = 0.1});
  const Eigen::MatrixXd thick = block.resistances(green, Readout::Floating, {.electrodeRadius_mm = 0.12});
  EXPECT_LT((thick - thin).maxCoeff(), 0);
}

TEST_P(DeformedGreenOf, HexahedraGiveWhatTetrahedraDo) {
  const Block tets(GetParam()), hexes(GetParam(), true);
  const Eigen::Matrix3d F = (Eigen::Matrix3d() << 1.02, 0, 0.1, 0, 0.97, -0.05, 0, 0, 1.01).finished();
  const BoxGreen a = tets.at(tets.moved(F)), b = hexes.at(hexes.moved(F));
  for (const Readout readout : kAll)
    EXPECT_LT(largestDifference(tets.resistances(a, readout, {.electrodeRadius_mm = 0.1}),
                                hexes.resistances(b, readout, {.electrodeRadius_mm = 0.1})),
              1e-3)
        << kReadouts.name(readout);
}

TEST_P(DeformedGreenOf, TheSameBytesComeFromAnyNumberOfThreads) {
  const Block block(GetParam());
  const FieldState state = bent(block, 0.1);
  const BoxGreen one = block.at(state, 1), three = block.at(state, 3);
  EXPECT_EQ(one.value, three.value);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(one.slope[i], three.slope[i]);
}

/// Independent of any mesh: the surface integral of model/FieldSensitivity.h.
TEST_P(DeformedGreenOf, ASmallBendingChangesResistancesAsHadamardsTermSays) {
  const Block block(GetParam());
  constexpr double small = 2e-3;
  const BoxGreen plus = block.at(bent(block, small)), minus = block.at(bent(block, -small));
  const FieldLaw law{.electrodeRadius_mm = 0.1};
  const FieldSensitivity field(block.design, law, SphereModel::Dipoles, 2);
  SensorMotion motion{bending(block, block.electrodes), {}};
  motion.faces_mm = field.faceNormals().cwiseProduct(bending(block, field.facePoints_mm())).colwise().sum();
  const Eigen::MatrixXd change = field.conductanceChanges(std::span(&motion, 1)).front();
  for (const Readout readout : kAll) {
    const Eigen::MatrixXd found =
        (block.resistances(plus, readout, law).array().log() - block.resistances(minus, readout, law).array().log()) /
        (2 * small);
    const Eigen::MatrixXd exact = NetworkReading(field.network(), readout).logChange(change);
    EXPECT_LT((found - exact).norm(), 0.01 * exact.norm()) << kReadouts.name(readout);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, DeformedGreenOf, testing::Values(1U, 7U, 23U));

TEST(DeformedGreen, NamesAnElectrodeThatNoElementHolds) {
  const Block block(3);
  FieldState state = block.moved(Eigen::Matrix3d::Identity());
  state.conductivity.pressures_MPa = Eigen::VectorXd::Zero(block.green->mesh().nodes());
  state.radius_mm = 0.1;
  EXPECT_NEAR(block.green->conductivities(state).maxCoeff(), 1, 1e-9);
  state.nodes_mm.setZero(); // elements without a size: no coordinates in them are numbers
  EXPECT_THROW((void)block.green->conductivities(state), DesignError);
}

TEST(DeformedGreen, StopsWhereItIsAsked) {
  const Block block(3);
  std::stop_source source;
  source.request_stop();
  EXPECT_FALSE(block.green->at(block.moved(Eigen::Matrix3d::Identity()), 1, source.get_token()));
}

} // namespace
} // namespace palp
