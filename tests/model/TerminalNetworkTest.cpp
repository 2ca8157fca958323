#include "model/TerminalNetwork.h"

#include "model/DesignError.h"
#include "model/FieldAtRest.h"
#include "tests/model/RandomLayout.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <limits>

namespace palp {
namespace {

constexpr double kApart_mm = 0.5;

FieldLaw lawOfWires(double wire_ohm) {
  FieldLaw law;
  law.resistivity_ohm_mm = 1;
  law.electrodeRadius_mm = 0.15;
  law.wire_ohm = wire_ohm;
  return law;
}

/// Every read-out by its own definition: all wires' potentials or currents are given, a linear system gives the rest.
Eigen::MatrixXd solvedCircuit(const TerminalNetwork& network, Readout readout) {
  const Eigen::MatrixXd& y = network.conductances();
  const int rows = network.counts().rowWires, columns = network.counts().columnWires, n = network.counts().wires();
  Eigen::MatrixXd resistances(rows, columns);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      Eigen::MatrixXd a = Eigen::MatrixXd::Identity(n, n); // potentials are given
      Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
      b(r) = 1; // volts; the column-wire is at 0
      for (int w = 0; w < n; ++w) {
        if (w == r || w == rows + c) continue;
        const bool floats = readout == Readout::Floating || (readout == Readout::RowsGrounded && w >= rows);
        if (floats) a.row(w) = y.row(w); // no current
        if (readout == Readout::OthersAtHalf) b(w) = 0.5;
      }
      const Eigen::VectorXd v = a.partialPivLu().solve(b);
      resistances(r, c) = -1 / (y.row(rows + c) * v); // the current out of the column-wire
    }
  return resistances;
}

class EachReadout : public testing::TestWithParam<Readout> {};

TEST_P(EachReadout, IsTheCircuitThatItNames) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const TerminalNetwork network = networkAtRest(randomLayout(seed, kApart_mm), lawOfWires(0.3));
    const Eigen::MatrixXd r = NetworkReading(network, GetParam()).resistances_ohm();
    EXPECT_LT((r.cwiseQuotient(solvedCircuit(network, GetParam())).array() - 1).abs().maxCoeff(), 1e-11) << seed;
  }
}

TEST_P(EachReadout, FollowsTheNetworkAsItsDifferencesDo) {
  for (unsigned seed = 1; seed <= 6; ++seed)
    for (const double wire_ohm : {0.0, 0.4}) {
      const SensorDesign design = randomLayout(seed, kApart_mm);
      const FieldLaw law = lawOfWires(wire_ohm);
      const Eigen::MatrixXd p = potentialsAtRest_ohm(design.block_mm, electrodes_mm(design), law);
      std::srand(seed);
      Eigen::MatrixXd dp = Eigen::MatrixXd::Random(p.rows(), p.cols());
      dp = (0.1 * (dp + dp.transpose())).eval();
      const TerminalNetwork network(p, wireCounts(design), wire_ohm);
      const Eigen::MatrixXd qDpQ = network.currents().transpose() * dp * network.currents();
      const Eigen::MatrixXd slope = NetworkReading(network, GetParam()).logChange(network.change(qDpQ));
      const double step = 1e-5; // truncation 1e-10, rounding 1e-16 of ln R over it
      const auto at = [&](double s) -> Eigen::MatrixXd {
        return NetworkReading(TerminalNetwork(p + s * dp, wireCounts(design), wire_ohm), GetParam())
            .resistances_ohm()
            .array()
            .log();
      };
      EXPECT_LT(((at(step) - at(-step)) / (2 * step) - slope).cwiseAbs().maxCoeff(), 1e-8 * slope.cwiseAbs().maxCoeff())
          << seed;
    }
}

/// A conductivity that is the same everywhere is a common factor, but not where the wires resist as well.
TEST_P(EachReadout, IsProportionalToTheResistivity) {
  const SensorDesign design = randomLayout(3, kApart_mm);
  FieldLaw law = lawOfWires(0);
  law.contact_ohm_mm2 = 0.2;
  const Eigen::MatrixXd one = NetworkReading(networkAtRest(design, law), GetParam()).resistances_ohm();
  law.resistivity_ohm_mm *= 2000;
  law.contact_ohm_mm2 *= 2000;
  const Eigen::MatrixXd many = NetworkReading(networkAtRest(design, law), GetParam()).resistances_ohm();
  EXPECT_LT((many.cwiseQuotient(2000 * one).array() - 1).abs().maxCoeff(), 1e-12);
}

/// x -> s x, a -> s a: R -> R / s.
TEST_P(EachReadout, FallsWithTheSizeOfTheSensor) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const SensorDesign design = randomLayout(seed, kApart_mm);
    const auto at = [&](double s) {
      FieldLaw law = lawOfWires(0);
      law.electrodeRadius_mm *= s;
      const TerminalNetwork network(potentialsAtRest_ohm(s * design.block_mm, s * electrodes_mm(design), law),
                                    wireCounts(design), 0);
      return NetworkReading(network, GetParam()).resistances_ohm();
    };
    EXPECT_LT((7 * at(7).cwiseQuotient(at(1)).array() - 1).abs().maxCoeff(), 1e-11) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(All, EachReadout,
                         testing::Values(Readout::Floating, Readout::VirtualGround, Readout::RowsGrounded,
                                         Readout::OthersAtHalf),
                         [](const auto& each) {
                           std::string name = kReadouts.name(each.param);
                           std::erase(name, '_');
                           return name;
                         });

/// Kirchhoff: what flows in flows out, whatever the potentials; and current falls from high to low.
TEST(TerminalNetwork, IsANetworkOfPositiveConductances) {
  for (unsigned seed = 1; seed <= 40; ++seed)
    for (const double wire_ohm : {0.0, 0.5}) {
      const Eigen::MatrixXd y = networkAtRest(randomLayout(seed, kApart_mm), lawOfWires(wire_ohm)).conductances();
      EXPECT_EQ(y, y.transpose());
      EXPECT_LT(y.rowwise().sum().cwiseAbs().maxCoeff(), 1e-12 * y.maxCoeff()) << seed;
      for (Eigen::Index r = 0; r < y.rows(); ++r)
        for (Eigen::Index c = 0; c < y.cols(); ++c) EXPECT_TRUE(r == c || y(r, c) < 0) << seed;
    }
}

/// Rayleigh: better conduction anywhere never raises a resistance between two wires while the others float.
TEST(TerminalNetwork, FloatingResistancesFallWithEveryConductivity) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const SensorDesign design = randomLayout(seed, kApart_mm);
    const Eigen::MatrixXd p = potentialsAtRest_ohm(design.block_mm, electrodes_mm(design), lawOfWires(0));
    const Eigen::MatrixXd before = NetworkReading({p, wireCounts(design), 0}, Readout::Floating).resistances_ohm();
    Eigen::MatrixXd worse = p; // a contact that resists more at one electrode
    worse(seed % p.rows(), seed % p.rows()) += 0.05;
    const Eigen::MatrixXd after = NetworkReading({worse, wireCounts(design), 0}, Readout::Floating).resistances_ohm();
    EXPECT_GT((after - before).minCoeff(), -1e-13) << seed;
    EXPECT_GT((after - before).maxCoeff(), 0) << seed;
    const Eigen::MatrixXd wires = NetworkReading({p, wireCounts(design), 0.1}, Readout::Floating).resistances_ohm();
    EXPECT_LT((wires - before - Eigen::MatrixXd::Constant(before.rows(), before.cols(), 0.2)).cwiseAbs().maxCoeff(),
              1e-12)
        << seed; // the two wires are in series with it, the others carry no current
  }
}

/// A constant in the potentials says nothing: only differences drive currents.
TEST(TerminalNetwork, DoesNotFeelAConstantPotential) {
  const SensorDesign design = randomLayout(5, kApart_mm);
  const Eigen::MatrixXd p = potentialsAtRest_ohm(design.block_mm, electrodes_mm(design), lawOfWires(0));
  const Eigen::MatrixXd shifted = (p.array() + 3.7).matrix();
  EXPECT_LT((TerminalNetwork(p, wireCounts(design), 0).conductances() -
             TerminalNetwork(shifted, wireCounts(design), 0).conductances())
                .cwiseAbs()
                .maxCoeff(),
            1e-12);
}

TEST(TerminalNetwork, RefusesPotentialsThatAreNotPositive) {
  const WireCounts counts{2, 2, 2, 2};
  Eigen::MatrixXd p = Eigen::MatrixXd::Identity(8, 8);
  EXPECT_NO_THROW(TerminalNetwork(p, counts, 0));
  EXPECT_NO_THROW(TerminalNetwork(p - Eigen::MatrixXd::Constant(8, 8, 5), counts, 0)) << "a constant says nothing";
  p(3, 3) = -2; // its inverse is finite, and so are the conductances
  EXPECT_THROW(TerminalNetwork(p, counts, 0), DesignError);
  p(3, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(TerminalNetwork(p, counts, 0), DesignError);
}

} // namespace
} // namespace palp
