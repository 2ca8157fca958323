#include "nn/inversion/KernelInversion.h"

#include "model/base/Cancelled.h"
#include "nn/NetworkError.h"
#include "nn/linear/RandomNumbers.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace palp {
namespace {

/// A bump over a row of 24 measurements around 100 each: its place along them, its height, its width.
struct Bumps {
  Eigen::MatrixXd parameters, measurements;
  explicit Bumps(int count, std::uint64_t seed, double noise = 0) : parameters(4, count), measurements(24, count) {
    RandomNumbers random(seed);
    for (int i = 0; i < count; ++i) {
      const double place = 4 + 16 * random.uniform(), height = 1 + 4 * random.uniform(), width = 3 + random.uniform();
      parameters.col(i) << height, 0, place, width; // the second never varies
      for (int m = 0; m < 24; ++m) measurements(m, i) = 100 + height * std::exp(-std::pow((m - place) / width, 2));
      for (int m = 0; m < 24 && noise > 0; ++m) measurements(m, i) *= 1 + noise * random.normal();
    }
  }
};

const Eigen::VectorXi kGroups = (Eigen::VectorXi(4) << 1, 1, 0, 2).finished();

TEST(KernelInversion, FindsThePlaceTheHeightAndTheWidthOfABump) {
  const Bumps train(300, 1), fresh(100, 2, 1e-4);
  const KernelForwardFit fit = fitKernelForwardModel(train.measurements, train.parameters, kGroups, {1e-4, 1});
  const KernelInversion inversion(fit.model);
  int within = 0;
  for (Eigen::Index i = 0; i < 100; ++i) {
    const KernelEstimate found = inversion.estimate(fresh.measurements.col(i));
    const Eigen::VectorXd off = (found.parameters - fresh.parameters.col(i)).cwiseAbs();
    // Noise of 0.01 on bumps 1 to 5 high, 6 measurements wide: about 0.01 / sqrt(6) in the height at best.
    EXPECT_LT(off(0), 0.1);
    EXPECT_EQ(off(1), 0);
    EXPECT_EQ(found.standardDeviation(1), 0);
    EXPECT_LT(off(2), 0.1);
    for (const int k : {0, 2}) within += off(k) <= found.standardDeviation(k);
  }
  // 200 numbers of which 0.68 are expected: 0.033 each way is one standard error.
  EXPECT_GT(within, 110);
  EXPECT_LT(within, 170);
}

TEST(KernelInversion, SlopesSayOfTheCausesWhatTheBumpsDo) {
  const Bumps train(300, 1), fresh(50, 2);
  const KernelForwardFit fit = fitKernelForwardModel(train.measurements, train.parameters, kGroups, {1e-4, 1});
  const std::vector<int> varied{0, 2, 3};
  for (Eigen::Index i = 0; i < 50; ++i) {
    const double height = fresh.parameters(0, i), place = fresh.parameters(2, i), width = fresh.parameters(3, i);
    Eigen::MatrixXd truth(24, 3);
    for (int m = 0; m < 24; ++m) {
      const double off = (m - place) / width, bump = std::exp(-off * off);
      truth.row(m) << bump, 2 * height * bump * off / width, 2 * height * bump * off * off / width;
    }
    truth.array().colwise() /= 1e-4 * fresh.measurements.col(i).array(); // in deviations of the noise
    const Eigen::MatrixXd slopes = fit.model.slopes(fresh.parameters.col(i));
    EXPECT_EQ(slopes.col(1).norm(), 0) << "never varied";
    const Eigen::Matrix3d expected = (truth.transpose() * truth).inverse();
    const Eigen::Matrix3d found =
        (slopes(Eigen::all, varied).transpose() * slopes(Eigen::all, varied)).eval().inverse();
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(found(k, k), expected(k, k), 0.1 * expected(k, k)) << i << ' ' << k;
  }
}

TEST(KernelInversion, HoldsOutEveryFifthSample) {
  const Bumps train(103, 1);
  const KernelForwardFit fit = fitKernelForwardModel(train.measurements, train.parameters, kGroups, {1e-4, 1});
  ASSERT_EQ(fit.heldOut.size(), 20U);
  EXPECT_EQ(fit.heldOut[1], 9);
  EXPECT_EQ(fit.heldOutResiduals.cols(), 20);
  EXPECT_EQ(fit.model.initialGuesses.cols(), 103); // all are kept to begin at
}

TEST(KernelInversion, WhatNoBumpExplainsLeavesAResidual) {
  const Bumps train(300, 1);
  const KernelForwardFit fit = fitKernelForwardModel(train.measurements, train.parameters, kGroups, {1e-4, 1});
  const KernelInversion inversion(fit.model);
  EXPECT_LT(inversion.estimate(train.measurements.col(7)).chiSquare, 3);
  Eigen::VectorXd two(24); // bumps, side by side
  for (int m = 0; m < 24; ++m)
    two(m) = 100 + 4 * std::exp(-std::pow((m - 6) / 3.5, 2)) + 4 * std::exp(-std::pow((m - 18) / 3.5, 2));
  EXPECT_GT(inversion.estimate(two).chiSquare, 100);
}

TEST(KernelInversion, WhateverIsMeasuredHasAnAnswerThatDoesNotExplainIt) {
  const Bumps train(300, 1);
  const KernelForwardFit fit = fitKernelForwardModel(train.measurements, train.parameters, kGroups, {1e-4, 1});
  const KernelInversion inversion(fit.model);
  for (const double wild : {1e12, -1e150, 1e300, 1.7e308}) {
    Eigen::VectorXd measured = train.measurements.col(7);
    measured(11) = wild;
    const KernelEstimate found = inversion.estimate(measured);
    EXPECT_TRUE(found.parameters.allFinite()) << wild;
    EXPECT_FALSE(found.chiSquare < 100) << wild;
  }
}

TEST(KernelInversion, WhatIsKnownBeforehandNeedNotBeLearned) {
  const Bumps few(60, 1), fresh(100, 2, 1e-4);
  KernelForwardOptions options{1e-4, 1};
  const auto worst = [&](const KernelForwardFit& fit) {
    const KernelInversion inversion(fit.model);
    double most = 0;
    for (Eigen::Index i = 0; i < 100; ++i)
      most = std::max(most,
                      std::abs(inversion.estimate(fresh.measurements.col(i)).parameters(2) - fresh.parameters(2, i)));
    return most;
  };
  const double alone = worst(fitKernelForwardModel(few.measurements, few.parameters, kGroups, options));
  options.priorMean = [](const Eigen::MatrixXd& parameters) { // the bumps, 10 % too high
    Eigen::MatrixXd all(24, parameters.cols());
    for (Eigen::Index i = 0; i < parameters.cols(); ++i)
      for (int m = 0; m < 24; ++m)
        all(m, i) = 100 + 1.1 * parameters(0, i) * std::exp(-std::pow((m - parameters(2, i)) / parameters(3, i), 2));
    return all;
  };
  EXPECT_LT(worst(fitKernelForwardModel(few.measurements, few.parameters, kGroups, options)), 0.5 * alone);
}

/// Bumps with a smaller one at one side and its opposite at the other, as lateral forces make them: reflected, the
/// measurements come in the other order and that parameter is the opposite.
struct LeaningBumps {
  Eigen::MatrixXd parameters, measurements;
  LeaningBumps(int count, std::uint64_t seed, double noise = 0) : parameters(4, count), measurements(24, count) {
    RandomNumbers random(seed);
    for (int i = 0; i < count; ++i) {
      parameters.col(i) << 1 + 4 * random.uniform(), 2 * random.uniform() - 1, 4 + 15 * random.uniform(),
          3 + random.uniform();
      for (int m = 0; m < 24; ++m) {
        const double along = (m - parameters(2, i)) / parameters(3, i);
        const double aside = std::exp(-std::pow(along - 1.5, 2)) - std::exp(-std::pow(along + 1.5, 2));
        measurements(m, i) = 100 + parameters(0, i) * std::exp(-along * along) + parameters(1, i) * aside;
      }
      for (int m = 0; m < 24 && noise > 0; ++m) measurements(m, i) *= 1 + noise * random.normal();
    }
  }
  static KernelMirror mirror() {
    KernelMirror mirror;
    for (Eigen::Index m = 0; m < 24; ++m) mirror.measurement.push_back(23 - m);
    mirror.about = {{1, 0.}, {2, 11.5}};
    return mirror;
  }
};

TEST(KernelInversion, AMirrorTeachesTheImageOfEachSampleAsWell) {
  const LeaningBumps few(80, 1), fresh(100, 2, 1e-5);
  KernelForwardOptions options{1e-5, 1};
  const auto off = [&](const KernelInversion& inversion, Eigen::Index parameter) {
    std::vector<double> sizes;
    for (Eigen::Index i = 0; i < 100; ++i)
      sizes.push_back(std::abs(inversion.estimate(fresh.measurements.col(i)).parameters(parameter) -
                               fresh.parameters(parameter, i)));
    std::nth_element(sizes.begin(), sizes.begin() + 50, sizes.end());
    return sizes[50];
  };
  const KernelForwardFit plain = fitKernelForwardModel(few.measurements, few.parameters, kGroups, options);
  options.mirrors = {LeaningBumps::mirror()};
  const KernelForwardFit fit = fitKernelForwardModel(few.measurements, few.parameters, kGroups, options);
  const KernelInversion alone(plain.model), mirrored(fit.model);
  for (const Eigen::Index parameter : {1, 2})
    EXPECT_LT(off(mirrored, parameter), 0.7 * off(alone, parameter)) << parameter;
  // And what is found of an image is the image of what is found.
  for (Eigen::Index i = 0; i < 20; ++i) {
    const KernelEstimate one = mirrored.estimate(fresh.measurements.col(i)),
                         image = mirrored.estimate(fresh.measurements.col(i).reverse());
    EXPECT_NEAR(image.parameters(2), 23 - one.parameters(2), 0.2 * one.standardDeviation(2)) << i;
    EXPECT_NEAR(image.parameters(1), -one.parameters(1), 0.2 * one.standardDeviation(1)) << i;
  }
}

TEST(KernelInversion, AMirrorThatTheSamplesDoNotHaveIsNotUsed) {
  LeaningBumps train(150, 1), fresh(100, 2, 1e-5);
  for (LeaningBumps* bumps : {&train, &fresh}) // on one side they are higher
    for (Eigen::Index m = 0; m < 24; ++m)
      bumps->measurements.row(m) =
          (100 + (1 + 0.02 * static_cast<double>(m)) * (bumps->measurements.row(m).array() - 100)).matrix();
  KernelForwardOptions options{1e-5, 1};
  const auto off = [&](const KernelForwardFit& fit) {
    const KernelInversion inversion(fit.model);
    std::vector<double> sizes;
    for (Eigen::Index i = 0; i < 100; ++i)
      sizes.push_back(std::abs(inversion.estimate(fresh.measurements.col(i)).parameters(2) - fresh.parameters(2, i)));
    std::nth_element(sizes.begin(), sizes.begin() + 50, sizes.end());
    return sizes[50];
  };
  const double alone = off(fitKernelForwardModel(train.measurements, train.parameters, kGroups, options));
  options.mirrors = {LeaningBumps::mirror()};
  EXPECT_LT(off(fitKernelForwardModel(train.measurements, train.parameters, kGroups, options)), 1.2 * alone);
}

/// Two places of which most of what is measured repeats itself every 8, so that what is nearest often lies a period
/// off.
struct Stripes {
  Eigen::MatrixXd parameters, measurements;
  Stripes(int count, std::uint64_t seed, double noise = 0) : parameters(3, count), measurements(8, count) {
    RandomNumbers random(seed);
    for (int i = 0; i < count; ++i) {
      parameters.col(i) << 1 + 4 * random.uniform(), 2 + 20 * random.uniform(), 2 + 20 * random.uniform();
      for (int k = 0; k < 2; ++k) {
        const double fast = std::numbers::pi * parameters(1 + k, i) / 4,
                     slow = std::numbers::pi * parameters(1 + k, i) / 24;
        measurements.col(i).segment<4>(4 * k) << std::cos(fast), std::sin(fast), 0.1 * std::cos(slow),
            0.1 * std::sin(slow);
      }
      measurements.col(i) = (100 + parameters(0, i) * measurements.col(i).array()).matrix().eval();
      for (int m = 0; m < 8 && noise > 0; ++m) measurements(m, i) *= 1 + noise * random.normal();
    }
  }
};

TEST(KernelInversion, LooksElsewhereWhereWhatIsNearestDoesNotExplain) {
  const Stripes train(300, 1), fresh(400, 2, 1e-4);
  const Eigen::VectorXi groups = (Eigen::VectorXi(3) << 1, 0, 0).finished();
  const KernelForwardFit fit = fitKernelForwardModel(train.measurements, train.parameters, groups, {1e-4, 1});
  const KernelInversion inversion(fit.model);
  int off = 0;
  for (Eigen::Index i = 0; i < 400; ++i)
    off += (inversion.estimate(fresh.measurements.col(i)).parameters - fresh.parameters.col(i)).tail<2>().norm() > 0.5;
  EXPECT_LT(off, 110); // 103; from as many starts side by side 147
}

TEST(KernelInversion, RefusesMirrorsThatTheSamplesCannotHave) {
  const LeaningBumps some(50, 1);
  KernelForwardOptions options{1e-4, 1};
  options.mirrors = {LeaningBumps::mirror()};
  std::swap(options.mirrors[0].measurement[3], options.mirrors[0].measurement[4]); // twice is not where it began
  EXPECT_THROW(fitKernelForwardModel(some.measurements, some.parameters, kGroups, options), NetworkError);
  options.mirrors[0].measurement.pop_back();
  EXPECT_THROW(fitKernelForwardModel(some.measurements, some.parameters, kGroups, options), NetworkError);
  options.mirrors = {LeaningBumps::mirror()};
  options.mirrors[0].about.emplace_back(4, 0.);
  EXPECT_THROW(fitKernelForwardModel(some.measurements, some.parameters, kGroups, options), NetworkError);
  options.mirrors = {LeaningBumps::mirror()};
  Eigen::MatrixXd leaning = some.parameters; // all by as much, to one side
  leaning.row(1).setConstant(0.5);
  EXPECT_THROW(fitKernelForwardModel(some.measurements, leaning, kGroups, options), NetworkError);
}

TEST(KernelInversion, RefusesWhatNothingCanBeFittedTo) {
  const Bumps few(4, 1), some(50, 1);
  EXPECT_THROW(fitKernelForwardModel(few.measurements, few.parameters, kGroups, {}), NetworkError);
  EXPECT_THROW(fitKernelForwardModel(some.measurements, few.parameters, kGroups, {}), NetworkError);
  Eigen::MatrixXd still = some.parameters;
  still.row(2).setConstant(3);
  EXPECT_THROW(fitKernelForwardModel(some.measurements, still, kGroups, {}), NetworkError);
  EXPECT_THROW(fitKernelForwardModel(Eigen::MatrixXd::Ones(24, 50), some.parameters, kGroups, {}), NetworkError);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(fitKernelForwardModel(some.measurements, some.parameters, kGroups, {}, stop.get_token()), Cancelled);
}

} // namespace
} // namespace palp
