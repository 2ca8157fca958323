#include "nn/measured/MeasuredFeatures.h"

#include "nn/Basis.h"
#include "nn/NetworkError.h"
#include "nn/linear/Lapack.h"
#include "nn/linear/RandomNumbers.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace palp {

namespace {

constexpr double kInputFloor = 0.1; ///< an input varying less than this share of the largest is not raised to 1
constexpr double kFewest = 1e-11;   ///< eigenvalues of the Gaussians' matrix that count, of the largest
constexpr double kDecades = 1.5;    ///< readings that vary by more are also tried as ln R and 1/R
constexpr std::size_t kTimes = 3;
constexpr Eigen::Index kManyRuns = 50; ///< are thinned run by run, fewer row by row

} // namespace

FeatureScaler inputScaler(const Eigen::MatrixXd& inputs, Eigen::Index readings) {
  FeatureScaler scaler;
  scaler.scaling = Scaling::ZScore;
  scaler.offset = inputs.rowwise().mean();
  const Eigen::MatrixXd centred = inputs.colwise() - scaler.offset;
  const Eigen::VectorXd deviation = centred.array().square().rowwise().mean().sqrt();
  const double floor = kInputFloor * deviation.head(readings).maxCoeff();
  scaler.factor = Eigen::VectorXd::Zero(inputs.rows());
  for (Eigen::Index i = 0; i < inputs.rows(); ++i)
    if (deviation(i) > 1e-12 * inputs.row(i).cwiseAbs().maxCoeff())
      scaler.factor(i) = 1 / std::hypot(deviation(i), floor);
  const double length = std::sqrt((scaler.factor.asDiagonal() * centred).colwise().squaredNorm().mean());
  if (!(length > 0)) throw NetworkError("the readings do not vary");
  scaler.factor /= length;
  return scaler;
}

Eigen::MatrixXd Features::at(const Eigen::MatrixXd& scaled) const {
  if (spread == 0) return scaled.transpose();
  Eigen::MatrixXd gaussians = squaredDistances(scaled, centers);
  basisInPlace(gaussians, gaussianRate(spread, SpreadConvention::Radbas));
  Eigen::MatrixXd all(scaled.cols(), basis.cols() + scaled.rows());
  all.leftCols(basis.cols()) = lapack::product(gaussians, false, basis, false);
  all.rightCols(scaled.rows()) = kTail * scaled.transpose();
  return all;
}

Features featuresOf(const Eigen::MatrixXd& scaled, double spread, int most, std::uint64_t seed) {
  Features features;
  features.spread = spread;
  if (spread == 0) return features;
  std::vector<Eigen::Index> chosen(static_cast<std::size_t>(scaled.cols()));
  std::iota(chosen.begin(), chosen.end(), Eigen::Index{0});
  RandomNumbers random(seed);
  for (std::size_t i = chosen.size(); i > 1; --i) std::swap(chosen[i - 1], chosen[random.below(i)]);
  chosen.resize(std::min(chosen.size(), static_cast<std::size_t>(most)));
  std::sort(chosen.begin(), chosen.end());
  features.centers = scaled(Eigen::all, chosen);
  Eigen::MatrixXd kernel = squaredDistances(features.centers, features.centers);
  basisInPlace(kernel, gaussianRate(spread, SpreadConvention::Radbas));
  const lapack::SymmetricEigen eigen = lapack::symmetricEigen(kernel);
  Eigen::Index first = 0;
  while (eigen.values(first) <= kFewest * eigen.values(eigen.values.size() - 1)) ++first;
  const Eigen::Index count = eigen.values.size() - first;
  features.basis = eigen.vectors.rightCols(count) * eigen.values.tail(count).cwiseSqrt().cwiseInverse().asDiagonal();
  return features;
}

std::vector<Eigen::Index> thinnedRows(const MeasuredRows& rows, Eigen::Index most) {
  const Eigen::Index step = std::max<Eigen::Index>(1, (rows.size() + most - 1) / most);
  const bool byRun = rows.runCount() > kManyRuns;
  std::vector<Eigen::Index> chosen;
  Eigen::Index run = -1, within = 0;
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    if (i == 0 || rows.runs(i) != rows.runs(i - 1)) {
      ++run;
      within = 0;
    }
    if ((byRun ? run : within) % step == 0) chosen.push_back(i);
    ++within;
  }
  return chosen;
}

MeasuredRows rowsAt(const MeasuredRows& rows, const std::vector<Eigen::Index>& chosen) {
  MeasuredRows part{rows.readings(chosen, Eigen::all), rows.targets(chosen, Eigen::all), {}, rows.runs(chosen)};
  if (rows.times_s.size() > 0) part.times_s = rows.times_s(chosen);
  return part;
}

double percentile(Eigen::VectorXd values, double share) {
  std::sort(values.begin(), values.end());
  const double at = share * static_cast<double>(values.size() - 1);
  const auto low = static_cast<Eigen::Index>(at);
  const Eigen::Index high = std::min<Eigen::Index>(low + 1, values.size() - 1);
  return values(low) + (at - static_cast<double>(low)) * (values(high) - values(low));
}

std::vector<ReadingTransform> transformsFor(const Eigen::MatrixXd& readings) {
  std::vector<ReadingTransform> all{ReadingTransform::None};
  if (!(readings.minCoeff() > 0)) return all;
  for (const auto column : readings.colwise())
    if (percentile(column, 0.995) > kDecades * percentile(column, 0.005)) {
      all.insert(all.end(), {ReadingTransform::Logarithm, ReadingTransform::Inverse});
      break;
    }
  return all;
}

std::vector<std::vector<double>> memoriesFor(const MeasuredRows& rows) {
  std::vector<double> gaps;
  double recorded_s = 0;
  for (Eigen::Index i = 1; i < rows.size(); ++i)
    if (rows.runs(i) == rows.runs(i - 1)) {
      gaps.push_back(rows.times_s(i) - rows.times_s(i - 1));
      recorded_s += gaps.back();
    }
  std::vector<std::vector<double>> sets{{}};
  if (gaps.empty() || !(recorded_s > 0)) return sets;
  std::sort(gaps.begin(), gaps.end());
  const double spacing_s =
      gaps[gaps.size() / 2] > 0 ? gaps[gaps.size() / 2] : recorded_s / static_cast<double>(gaps.size());
  std::vector<double> all;
  for (double time_s = spacing_s; time_s <= recorded_s / 16; time_s *= 4) all.push_back(time_s);
  if (all.empty()) all.push_back(spacing_s);
  for (std::size_t i = 0; i + kTimes <= all.size(); ++i)
    sets.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(i),
                      all.begin() + static_cast<std::ptrdiff_t>(i) + kTimes);
  return sets;
}

} // namespace palp
