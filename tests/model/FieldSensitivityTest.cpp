#include "model/FieldSensitivity.h"

#include "tests/model/RandomLayout.h"

#include <gtest/gtest.h>

#include <random>

namespace palp {
namespace {

constexpr double kFine = 2;    ///< panels of the quadrature, where formulas are judged
constexpr double kLeft = 5e-6; ///< what these panels leave of a change, relative

FieldLaw lawOfRadius(double radius_mm) {
  FieldLaw law;
  law.resistivity_ohm_mm = 3;
  law.electrodeRadius_mm = radius_mm;
  law.wire_ohm = 0.05;
  return law;
}

SensorMotion still(const FieldSensitivity& field, const SensorDesign& design) {
  return {Eigen::Matrix3Xd::Zero(3, electrodes_mm(design).cols()), Eigen::VectorXd::Zero(field.facePoints_mm().cols())};
}

/// The same sensor in a block that is longer by `step` along an axis, its electrodes displaced.
Eigen::MatrixXd conductancesOf(const SensorDesign& design, const FieldLaw& law, const Eigen::Vector3d& block_mm,
                               const Eigen::Matrix3Xd& electrodes, SphereModel model) {
  return TerminalNetwork(potentialsAtRest_ohm(block_mm, electrodes, law, model), wireCounts(design), law.wire_ohm)
      .conductances();
}

class EachSphereModel : public testing::TestWithParam<SphereModel> {};

TEST_P(EachSphereModel, FollowsElectrodesAsItsDifferencesDo) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const SensorDesign design = randomLayout(seed, 0.5);
    const FieldLaw law = lawOfRadius(0.2);
    const FieldSensitivity field(design, law, GetParam());
    SensorMotion motion = still(field, design);
    std::mt19937 engine(seed);
    for (double& value : motion.electrodes_mm.reshaped()) value = std::uniform_real_distribution<double>(-1, 1)(engine);
    const Eigen::MatrixXd slope = field.conductanceChanges(std::array{motion})[0];
    const double step = 1e-5; // truncation: step^2 over the distance^2 of 0.5 mm; rounding 1e-14 of Y over the step
    const auto at = [&](double s) {
      return conductancesOf(design, law, design.block_mm, electrodes_mm(design) + s * motion.electrodes_mm, GetParam());
    };
    const Eigen::MatrixXd difference = (at(step) - at(-step)) / (2 * step);
    EXPECT_LT((difference - slope).cwiseAbs().maxCoeff(), 3e-8 * slope.cwiseAbs().maxCoeff()) << seed;
  }
}

/// Faces move as the block grows along an axis: at its far end, or at its near end where all else is carried away.
TEST_P(EachSphereModel, FollowsEachFaceAsItsDifferencesDo) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const SensorDesign design = randomLayout(seed, 0.5);
    const FieldLaw law = lawOfRadius(0.2);
    const FieldSensitivity field(design, law, GetParam(), kFine);
    for (int axis = 0; axis < 3; ++axis)
      for (const bool high : {true, false}) {
        if (axis == 2 && !high) continue; // the bottom is fixed
        SensorMotion motion = still(field, design);
        for (Eigen::Index p = 0; p < motion.faces_mm.size(); ++p)
          motion.faces_mm(p) = field.faceNormals()(axis, p) == (high ? 1 : -1) ? 1 : 0;
        const Eigen::MatrixXd slope = field.conductanceChanges(std::array{motion})[0];
        const double step = 1e-4;
        const auto at = [&](double s) {
          Eigen::Matrix3Xd electrodes = electrodes_mm(design);
          if (!high) electrodes.row(axis).array() += s;
          return conductancesOf(design, law, design.block_mm + s * Eigen::Vector3d::Unit(axis), electrodes, GetParam());
        };
        const Eigen::MatrixXd difference = (at(step) - at(-step)) / (2 * step);
        EXPECT_LT((difference - slope).cwiseAbs().maxCoeff(), kLeft * slope.cwiseAbs().maxCoeff())
            << seed << " axis " << axis << (high ? " high" : " low");
      }
  }
}

INSTANTIATE_TEST_SUITE_P(Both, EachSphereModel, testing::Values(SphereModel::Monopoles, SphereModel::Dipoles));

/// With all of its faces (along z the bottom would have to move as well).
TEST(FieldSensitivity, AMotionOfTheWholeBlockChangesNothing) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const SensorDesign design = randomLayout(seed, 0.5);
    const FieldSensitivity field(design, lawOfRadius(0.2), SphereModel::Dipoles, kFine);
    for (int axis = 0; axis < 2; ++axis) {
      SensorMotion motion = still(field, design);
      motion.electrodes_mm.row(axis).setOnes();
      const SensorMotion electrodesAlone = motion;
      motion.faces_mm = field.faceNormals().row(axis);
      const auto changes = field.conductanceChanges(std::array{motion, electrodesAlone});
      EXPECT_LT(changes[0].cwiseAbs().maxCoeff(), kLeft * changes[1].cwiseAbs().maxCoeff()) << seed;
    }
  }
}

/// The same reading the other way round, under every read-out.
TEST(FieldSensitivity, AReadingsGradientGivesWhatAMotionChanges) {
  const SensorDesign design = randomLayout(3, 0.5);
  const FieldSensitivity field(design, lawOfRadius(0.2));
  SensorMotion motion = still(field, design);
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (double& value : motion.electrodes_mm.reshaped()) value = uniform(engine);
  for (double& value : motion.faces_mm) value = uniform(engine);
  const Eigen::MatrixXd change = field.conductanceChanges(std::array{motion})[0];
  for (const auto& [readout, name] : kReadouts.all()) {
    const ReadingGradient gradient = field.readingGradient(readout);
    const Eigen::VectorXd found =
        gradient.electrodes_per_mm * motion.electrodes_mm.reshaped() + gradient.faces_per_mm * motion.faces_mm;
    const Eigen::VectorXd wanted = NetworkReading(field.network(), readout).logChange(change).reshaped();
    EXPECT_LT((found - wanted).norm(), 1e-12 * wanted.norm()) << name;
    EXPECT_EQ(gradient.faces_per_mm, field.readingGradient(readout, 3).faces_per_mm) << name;
  }
}

/// What the usual panels leave of a bulge that is no polynomial, against panels of a third of their width.
TEST(FieldSensitivity, ItsPanelsLeaveATenthOfAThousandth) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const SensorDesign design = randomLayout(seed, 0.5);
    std::vector<Eigen::MatrixXd> changes;
    for (const double fineness : {1.0, 3.0}) {
      const FieldSensitivity field(design, lawOfRadius(0.2), SphereModel::Dipoles, fineness);
      SensorMotion motion = still(field, design);
      const Eigen::Matrix3Xd& at = field.facePoints_mm();
      motion.faces_mm = at.row(2).array() * (-0.3 * ((at.row(0).array() - 3).square() + at.row(1).array())).exp();
      const Eigen::MatrixXd change = field.conductanceChanges(std::array{motion})[0];
      changes.push_back(NetworkReading(field.network(), Readout::VirtualGround).logChange(change));
    }
    EXPECT_LT((changes[0] - changes[1]).norm(), 2e-4 * changes[1].norm()) << seed;
  }
}

/// The paper's block grows: against the derivative by its height, in which the closed form has no quadrature.
TEST(FieldSensitivity, ThePapersTopFaceIsTheDerivativeByTheHeight) {
  const SensorDesign design = paperDesign();
  const FieldLaw law = lawOfRadius(0.2);
  const FieldSensitivity field(design, law);
  SensorMotion motion = still(field, design);
  motion.faces_mm = field.faceNormals().row(2);
  const Eigen::MatrixXd slope = field.conductanceChanges(std::array{motion})[0];
  const auto at = [&](double s) {
    return conductancesOf(design, law, design.block_mm + s * Eigen::Vector3d::UnitZ(), electrodes_mm(design),
                          SphereModel::Dipoles);
  };
  const Eigen::MatrixXd difference = (at(1e-4) - at(-1e-4)) / 2e-4;
  EXPECT_LT((difference - slope).norm(), 3e-5 * slope.norm()); // of the panels; another program's as well
}

} // namespace
} // namespace palp
