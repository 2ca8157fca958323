#include "nn/measured/MeasuredFit.h"

#include "nn/NetworkError.h"
#include "nn/measured/GroupRidge.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace palp {

namespace {

constexpr double kNoise = 5e-3;

Eigen::MatrixXd normalMatrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(engine); });
}

/// A rig of 12 resistances, exponential in three forces, with noise; each load held for `copies` rows.
MeasuredRows rig(Eigen::Index loads, Eigen::Index copies, unsigned seed) {
  const Eigen::MatrixXd linear = 0.02 * normalMatrix(3, 12, 7), square = 0.02 * normalMatrix(3, 12, 8);
  const Eigen::MatrixXd forces = normalMatrix(loads, 3, seed).cwiseMax(-2).cwiseMin(2);
  const Eigen::MatrixXd readings = 500 * (forces * linear + forces.cwiseAbs2() * square).array().exp().matrix();
  MeasuredRows rows{Eigen::MatrixXd(loads * copies, 12),
                    Eigen::MatrixXd(loads * copies, 3),
                    {},
                    Eigen::VectorXi::Zero(loads * copies)};
  for (Eigen::Index i = 0; i < loads * copies; ++i) {
    rows.readings.row(i) = readings.row(i / copies);
    rows.targets.row(i) = forces.row(i / copies);
  }
  const Eigen::RowVectorXd spread =
      (readings.rowwise() - readings.colwise().mean()).colwise().norm() / std::sqrt(static_cast<double>(loads));
  rows.readings += kNoise * normalMatrix(loads * copies, 12, seed + 1) * spread.asDiagonal();
  return rows;
}

MeasuredRows mixed(const MeasuredRows& rows) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(rows.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  return {rows.readings(order, Eigen::all), rows.targets(order, Eigen::all), {}, rows.runs};
}

/// A slow sensor: its reading follows the force at once and by a low pass of 2 s; 20 rows per second.
MeasuredRows slowSensor(Eigen::Index count, unsigned seed) {
  MeasuredRows rows{Eigen::MatrixXd(count, 1), Eigen::MatrixXd(count, 1), Eigen::VectorXd(count),
                    Eigen::VectorXi::Zero(count)};
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> level(0, 5);
  double force = 0, target = level(engine), state = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    if (i % 40 == 0) target = level(engine);
    force += std::clamp(target - force, -0.3, 0.3);
    state += (force - state) * (1 - std::exp(-0.05 / 2));
    rows.times_s(i) = 0.05 * static_cast<double>(i);
    rows.targets(i, 0) = force;
    rows.readings(i, 0) = 1 + 0.5 * force + state;
  }
  rows.readings += 0.01 * normalMatrix(count, 1, seed + 1);
  return rows;
}

/// rms error on other rows, as a share of the training forces' deviations.
double metBy(const MeasuredFit& fit, const MeasuredRows& trained, const MeasuredRows& later) {
  const Eigen::MatrixXd inputs =
      fit.stage.apply(later.readings.transpose(), later.times_s.transpose(), later.runs.cast<double>().transpose());
  Eigen::MatrixXd predicted = fit.network.predict(inputs);
  double sum = 0;
  for (Eigen::Index j = 0; j < later.targets.cols(); ++j) {
    const auto column = trained.targets.col(j);
    const double variance = (column.array() - column.mean()).square().mean();
    const double low = column.minCoeff(), high = column.maxCoeff(), beyond = 0.1 * (high - low);
    predicted.row(j) = predicted.row(j).cwiseMax(low - beyond).cwiseMin(high + beyond).eval();
    sum += (predicted.row(j).transpose() - later.targets.col(j)).squaredNorm() / static_cast<double>(later.size()) /
           variance;
  }
  return std::sqrt(sum / static_cast<double>(later.targets.cols()));
}

TEST(GroupRidge, ErrorsOfGroupsLeftOutAreThoseOfFitsWithoutThem) {
  const Eigen::MatrixXd a = normalMatrix(60, 7, 1), y = normalMatrix(60, 2, 2);
  const GroupRidge all(a, y);
  Fold fold;
  for (Eigen::Index i = 10; i < 25; ++i) fold.leftOut.push_back(i);
  fold.judged.assign(fold.leftOut.begin() + 3, fold.leftOut.end() - 2);
  for (const double lambda : {1e-8, 1e-2}) {
    const Eigen::MatrixXd errors = all.errors({fold}, {lambda}, {}).front();
    // The same normal equations of the 45 other rows, with the penalty of all 60.
    Eigen::MatrixXd ones(60, 8);
    ones << a, Eigen::VectorXd::Ones(60);
    Eigen::MatrixXd rest(45, 8), restY(45, 2);
    rest << ones.topRows(10), ones.bottomRows(35);
    restY << y.topRows(10), y.bottomRows(35);
    Eigen::MatrixXd normal = rest.transpose() * rest;
    normal.diagonal().head(7).array() += lambda * a.squaredNorm();
    normal(7, 7) += 60e-9;
    const Eigen::MatrixXd x = normal.fullPivLu().solve(rest.transpose() * restY);
    for (const Eigen::Index i : fold.judged)
      EXPECT_LT((errors.row(i) - (y.row(i) - ones.row(i) * x)).norm(), 1e-9) << lambda;
    EXPECT_EQ(errors.row(10).norm(), 0) << "left out, not judged";
    EXPECT_LT((all.singleRowErrors(lambda).row(0) - all.errors({{{0}, {0}}}, {lambda}, {}).front().row(0)).norm(),
              1e-9);
  }
}

TEST(MemoryStates, FollowLinearSignalsExactlyAtAnySpacing) {
  const std::vector<double> times_s{0.3, 2};
  const auto signal = [](double t) { return t < 1 ? 3 * t : 3 - (t - 1); }; // kink at a sample
  MemoryStates states(times_s);
  Eigen::VectorXd differences;
  for (const double t : {0.0, 0.1, 0.4, 1.0, 1.05, 2.7})
    differences = states.next(t, Eigen::VectorXd::Constant(1, signal(t)));
  for (std::size_t k = 0; k < times_s.size(); ++k) {
    double state = 0;
    constexpr double step = 1e-5;
    for (double t = 0; t < 2.7 - step / 2; t += step)
      state += step / times_s[k] * (signal(t + step / 2) - state) / (1 + step / (2 * times_s[k]));
    EXPECT_NEAR(differences(static_cast<Eigen::Index>(k)), signal(2.7) - state, 2e-5) << times_s[k];
  }
  states.reset();
  EXPECT_EQ(states.next(5, Eigen::VectorXd::Constant(1, 9.0)).norm(), 0);
}

TEST(RowDependence, RepeatedRowsAreFoundInAnyOrder) {
  const MeasuredRows rows = rig(60, 25, 11);
  EXPECT_EQ(nearlyEqualRows(rows.readings, rows.targets).maxCoeff() + 1, 60);
  const MeasuredRows other = mixed(rows);
  EXPECT_EQ(nearlyEqualRows(other.readings, other.targets).maxCoeff() + 1, 60);
  EXPECT_EQ(findDependence(other, {}, {}).order, RowOrder::Independent);
  EXPECT_LT(findDependence(other, {}, {}).leaders, 0.1);
  EXPECT_EQ(findDependence(slowSensor(2000, 1), {}, {}).order, RowOrder::Time);
  EXPECT_EQ(findDependence(slowSensor(2000, 1), RowOrder::Independent, {}).order, RowOrder::Independent);
}

TEST(MeasuredFit, TheErrorOfHeldAndRepeatedReadingsIsThatOfOtherLoads) {
  const MeasuredRows later = rig(500, 1, 12);
  for (const MeasuredRows& rows : {rig(60, 25, 11), mixed(rig(60, 25, 11)), rig(400, 1, 13)}) {
    const MeasuredFit fit = fitMeasured(rows, {});
    const double met = metBy(fit, rows, later);
    EXPECT_LT(met, 1.5 * fit.validation.score) << fit.validation.dependence.correlation;
    EXPECT_GT(met, fit.validation.score / 2);
  }
}

TEST(MeasuredFit, AMemoryIsTakenWhereTheSensorHasOneAndThereIsAClock) {
  const MeasuredRows rows = slowSensor(3000, 1);
  const MeasuredFit fit = fitMeasured(rows, {});
  EXPECT_TRUE(fit.stage.hasMemory());
  MeasuredOptions without;
  without.memory_s = std::vector<double>{};
  const MeasuredFit plain = fitMeasured(rows, without);
  EXPECT_FALSE(plain.stage.hasMemory());
  const MeasuredRows later = slowSensor(1000, 21);
  const double met = metBy(fit, rows, later);
  EXPECT_LT(met, metBy(plain, rows, later));
  EXPECT_LT(met, 1.8 * fit.validation.score);
  MeasuredRows timeless = rows;
  timeless.times_s.resize(0);
  EXPECT_FALSE(fitMeasured(timeless, {}).stage.hasMemory());
  MeasuredOptions byRow;
  byRow.rowsAreClock = true;
  const MeasuredFit ofRows = fitMeasured(timeless, byRow);
  EXPECT_TRUE(ofRows.stage.hasMemory() && ofRows.stage.rowsAreClock);
  EXPECT_LT(metBy(ofRows, rows, later), 1.05 * met) << "its rows are equally spaced";
}

TEST(InputStage, ItsSlopeIsThatOfAQuickChange) {
  for (const ReadingTransform transform :
       {ReadingTransform::None, ReadingTransform::Logarithm, ReadingTransform::Inverse})
    for (const bool ofALine : {false, true}) {
      InputStage stage;
      stage.transform = transform;
      stage.times_s = {1, 4};
      if (ofALine) {
        stage.weights = normalMatrix(2, 3, 1);
        stage.constant = Eigen::Vector2d(1, 2);
      }
      const Eigen::Vector3d at(2, 3, 5);
      const Eigen::MatrixXd slope = stage.slope(at);
      constexpr double step = 1e-5, quick_s = 1e-7;
      for (Eigen::Index i = 0; i < 3; ++i) {
        Eigen::MatrixXd readings = at.replicate(1, 2);
        readings(i, 1) += step;
        const Eigen::MatrixXd inputs = stage.apply(readings, Eigen::RowVector2d(0, quick_s), {});
        EXPECT_LT(((inputs.col(1) - inputs.col(0)) / step - slope.col(i)).norm(), 1e-4) << i;
      }
    }
}

TEST(MeasuredFit, AReadingOverDecadesIsTakenAsItsInverse) {
  MeasuredRows rows{Eigen::MatrixXd(400, 1), Eigen::MatrixXd(400, 1), {}, Eigen::VectorXi::Zero(400)};
  const Eigen::MatrixXd noise = normalMatrix(400, 1, 4);
  for (Eigen::Index i = 0; i < 400; ++i) {
    rows.targets(i, 0) = 0.01 + 5.0 * static_cast<double>((i * 37) % 400) / 400;
    rows.readings(i, 0) = (100 / rows.targets(i, 0)) * (1 + 0.01 * noise(i, 0)) + 20;
  }
  const MeasuredFit fit = fitMeasured(rows, {});
  EXPECT_NE(fit.stage.transform, ReadingTransform::None);
  EXPECT_LT(fit.validation.score, 0.1);
}

TEST(MeasuredFit, DeviationsHoldForTwoThirdsOfLaterErrors) {
  const MeasuredRows rows = rig(600, 1, 31), later = rig(600, 1, 41);
  const MeasuredFit fit = fitMeasured(rows, {});
  const Eigen::MatrixXd predicted = fit.network.predict(fit.stage.held(later.readings.transpose()));
  const Eigen::MatrixXd within =
      ((predicted.transpose() - later.targets).cwiseAbs().transpose().array() <= fit.deviation.at(predicted).array())
          .cast<double>();
  EXPECT_GT(within.mean(), 0.58);
  EXPECT_LT(within.mean(), 0.78);
}

TEST(MeasuredFit, TheSameSeedGivesTheSameBytesAndBadRowsARefusal) {
  const MeasuredRows rows = rig(200, 1, 5);
  const MeasuredFit a = fitMeasured(rows, {}), b = fitMeasured(rows, {});
  EXPECT_EQ(a.network.weights, b.network.weights);
  EXPECT_EQ(a.network.tail, b.network.tail);
  MeasuredRows bad = rows;
  bad.readings(3, 3) = std::nan("");
  EXPECT_THROW(static_cast<void>(fitMeasured(bad, {})), NetworkError);
  MeasuredRows constant = rows;
  constant.readings.setConstant(4);
  EXPECT_THROW(static_cast<void>(fitMeasured(constant, {})), NetworkError);
}

} // namespace

} // namespace palp
