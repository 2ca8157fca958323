#include "model/FieldAtRest.h"

#include "tests/model/RandomLayout.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace palp {
namespace {

constexpr double kPi = std::numbers::pi;

FieldLaw lawWith(double radius_mm) {
  FieldLaw law;
  law.resistivity_ohm_mm = 1;
  law.electrodeRadius_mm = radius_mm;
  return law;
}

double betweenTwo(const Eigen::Vector3d& block, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const FieldLaw& law,
                  SphereModel model) {
  Eigen::Matrix3Xd points(3, 2);
  points << a, b;
  const Eigen::MatrixXd p = potentialsAtRest_ohm(block, points, law, model);
  return p(0, 0) + p(1, 1) - 2 * p(0, 1);
}

/// Between two spheres of radius a at a distance d in infinite rubber, by bispherical coordinates.
double exactBetweenSpheres(double a, double d) {
  const double mu = std::acosh(d / (2 * a));
  double sum = 0;
  for (int n = 1; n < 300 && n * mu < 300; ++n) sum += 1 / std::sinh((2 * n - 1) * mu) + 1 / std::sinh(2 * n * mu);
  return 2 / (4 * kPi * a * std::sinh(mu) * sum);
}

struct Spheres {
  double radius_mm, monopoles, exact;
};
class TwoSpheres : public testing::TestWithParam<Spheres> {};

TEST_P(TwoSpheres, FarFromWallsAreThoseOfInfiniteRubber) {
  const auto [a, monopoles, exact] = GetParam();
  EXPECT_NEAR(exactBetweenSpheres(a, 1), exact, 1e-8);
  const Eigen::Vector3d block = Eigen::Vector3d::Constant(2e3);
  const Eigen::Vector3d first(1000, 1000, 999.5), second(1000, 1000, 1000.5);
  const double mono = betweenTwo(block, first, second, lawWith(a), SphereModel::Monopoles);
  EXPECT_NEAR(mono, monopoles, 1e-8); // walls at 1000 mm: the dipole of the pair is felt by 1e-9
  // Each dipole takes a^3 / (2 pi d^4) off; what is left is of the next order.
  const double dipoles = betweenTwo(block, first, second, lawWith(a), SphereModel::Dipoles);
  EXPECT_NEAR(dipoles, monopoles - a * a * a / (2 * kPi), 1e-8);
  EXPECT_LT(std::abs(dipoles - exact), 0.36 * std::abs(mono - exact));
}

INSTANTIATE_TEST_SUITE_P(Radii, TwoSpheres,
                         testing::Values(Spheres{0.1, 1.43239449, 1.43223340}, Spheres{0.2, 0.63661977, 0.63527000},
                                         Spheres{0.3, 0.37136153, 0.36630567}));

/// A wall is a mirror. Exactly: two equal spheres at one potential, by successive images in each other; half of what
/// they lead away is the sphere's own.
double exactAtWall(double a, double h) {
  double charge = 1, total = 0, place = 0; // an image's charge and its distance from the centre of its sphere
  for (int n = 0; n < 200; ++n) {
    total += charge;
    const double apart = 2 * h - place;
    charge *= -a / apart;
    place = a * a / apart;
  }
  return 1 / (4 * kPi * a * total);
}

TEST(FieldAtRest, ASphereNearAWallComesNearToTheExactOne) {
  const Eigen::Vector3d block = Eigen::Vector3d::Constant(2e3);
  EXPECT_NEAR(exactAtWall(0.2, 0.5), 0.47681302, 5e-9);
  for (const double a : {0.1, 0.15, 0.2}) {
    Eigen::Matrix3Xd points(3, 1);
    points << 1000, 1000, 0.5;
    const double exact = exactAtWall(a, 0.5), monopole = 1 / (4 * kPi * a) + 1 / (4 * kPi);
    const auto p = [&](SphereModel model) { return potentialsAtRest_ohm(block, points, lawWith(a), model)(0, 0); };
    const double far = p(SphereModel::Monopoles) - monopole; // what the box's other walls add
    EXPECT_LT(std::abs(far), 3e-4);                          // of the size of 1 / (4 pi 1000)
    // What is left out is of the next order.
    EXPECT_NEAR(p(SphereModel::Dipoles) - far, exact, 0.25 * std::pow(a / 0.5, 2) * (monopole - exact)) << a;
  }
}

/// Leading order of another program: R / rho of an upper and a lower electrode in the paper's box.
TEST(FieldAtRest, TwoElectrodesInThePapersBoxHaveTheirResistance) {
  const Eigen::Vector3d block(30, 30, 5), upper(13.5, 13.5, 4);
  const double known[][4] = {{13.5, 1.581176, 0.626247, 0.307937},
                             {15.5, 1.593752, 0.638822, 0.320512},
                             {18.5, 1.629371, 0.674441, 0.356131},
                             {23.5, 1.679459, 0.724529, 0.406219},
                             {29.5, 1.813501, 0.858571, 0.540261}};
  const double radii[] = {0.1, 0.25, 0.5};
  for (const auto& row : known)
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(betweenTwo(block, upper, {row[0], 15, 1}, lawWith(radii[i]), SphereModel::Monopoles), row[i + 1],
                  6e-7); // its last digit
}

Eigen::MatrixXd paperResistances(double radius_mm, Readout readout, SphereModel model) {
  return NetworkReading(networkAtRest(paperDesign(), lawWith(radius_mm), model), readout).resistances_ohm();
}

TEST(FieldAtRest, ThePapersDesignHasTheResistancesOfAnIndependentProgram) {
  struct Known {
    SphereModel model;
    double a00, a415, b00, b415, c415;
  };
  for (const Known& known : {Known{SphereModel::Monopoles, 0.23892262, 0.18598945, 3.81997171, 3.37504980, 1.34620275},
                             Known{SphereModel::Dipoles, 0.23795663, 0.18532290, 3.81637402, 3.37106704, 1.34020730}}) {
    const double digits = 6e-9; // as many as are known
    const Eigen::MatrixXd a = paperResistances(0.2, Readout::Floating, known.model);
    EXPECT_NEAR(a(0, 0), known.a00, digits);
    EXPECT_NEAR(a(4, 15), known.a415, digits);
    const Eigen::MatrixXd b = paperResistances(0.2, Readout::VirtualGround, known.model);
    EXPECT_NEAR(b(0, 0), known.b00, digits);
    EXPECT_NEAR(b(4, 15), known.b415, digits);
    EXPECT_NEAR(paperResistances(0.2, Readout::RowsGrounded, known.model)(4, 15), known.c415, digits);
  }
}

/// Another program's mean and spread over the columns of row-wire 4, all other wires floating.
TEST(FieldAtRest, ThePapersRowHasTheKnownMeanAndSpread) {
  for (const auto& [radius, mean, ratio] : {std::tuple{0.1, 0.36708, 1.1108}, {0.25, 0.15462, 1.2249}}) {
    const Eigen::VectorXd r = paperResistances(radius, Readout::Floating, SphereModel::Monopoles).row(4);
    EXPECT_NEAR(r.mean(), mean, 6e-6);
    EXPECT_NEAR(r.maxCoeff() / r.minCoeff(), ratio, 6e-5);
  }
}

TEST(FieldAtRest, ContactAddsToEachElectrode) {
  const SensorDesign design = randomLayout(2, 0.5);
  FieldLaw law = lawWith(0.2);
  const Eigen::MatrixXd without = potentialsAtRest_ohm(design.block_mm, electrodes_mm(design), law);
  law.contact_ohm_mm2 = 0.3;
  const Eigen::MatrixXd with = potentialsAtRest_ohm(design.block_mm, electrodes_mm(design), law);
  const double each = 0.3 / (4 * kPi * 0.04);
  EXPECT_LT((with - without - each * Eigen::MatrixXd::Identity(with.rows(), with.cols())).cwiseAbs().maxCoeff(), 1e-13);
}

} // namespace
} // namespace palp
