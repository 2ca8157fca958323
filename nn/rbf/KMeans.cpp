#include "nn/rbf/KMeans.h"

#include "model/base/GotExpected.h"
#include "nn/Basis.h"
#include "nn/NetworkError.h"
#include "nn/linear/RandomNumbers.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

namespace palp {
namespace {

void requireCount(int count) {
  if (count < 1) throw NetworkError("centers: " + gotExpected(std::to_string(count), "1 or more"));
}

/// k-means++: each next centre is a sample, drawn with a probability that grows with its squared distance to those
/// chosen. Stops early where every sample is a centre already.
Eigen::MatrixXd firstCenters(const Eigen::MatrixXd& samples, int count, RandomNumbers& random) {
  std::vector<Eigen::Index> chosen{static_cast<Eigen::Index>(random.below(static_cast<std::uint64_t>(samples.cols())))};
  Eigen::VectorXd distance = squaredDistances(samples, samples.col(chosen[0]));
  while (static_cast<int>(chosen.size()) < count && distance.maxCoeff() > 0) {
    double rest = random.uniform() * distance.sum();
    Eigen::Index next = 0;
    while (next + 1 < samples.cols() && (rest -= distance(next)) >= 0) ++next;
    if (!(distance(next) > 0)) distance.maxCoeff(&next);
    chosen.push_back(next);
    distance = distance.cwiseMin(squaredDistances(samples, samples.col(next)).col(0));
  }
  return samples(Eigen::all, chosen);
}

/// Nearest centre of each sample; returns the sum of squared distances.
double assign(const Eigen::MatrixXd& samples, const Eigen::MatrixXd& centers, Eigen::VectorXi& nearest) {
  const Eigen::MatrixXd distance = squaredDistances(centers, samples);
  double inertia = 0;
  for (Eigen::Index i = 0; i < samples.cols(); ++i) {
    Eigen::Index best = 0;
    inertia += distance.col(i).minCoeff(&best);
    nearest(i) = static_cast<int>(best);
  }
  return inertia;
}

/// Means of the clusters; a cluster that lost all its samples stays where it is.
void moveToMeans(const Eigen::MatrixXd& samples, const Eigen::VectorXi& nearest, Eigen::MatrixXd& centers) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(centers.rows(), centers.cols());
  Eigen::VectorXi members = Eigen::VectorXi::Zero(centers.cols());
  for (Eigen::Index i = 0; i < samples.cols(); ++i) {
    sum.col(nearest(i)) += samples.col(i);
    ++members(nearest(i));
  }
  for (Eigen::Index c = 0; c < centers.cols(); ++c)
    if (members(c) > 0) centers.col(c) = sum.col(c) / members(c);
}

} // namespace

KMeansResult kMeans(const Eigen::Ref<const Eigen::MatrixXd>& samples, int count, std::uint64_t seed,
                    int maxIterations) {
  requireCount(count);
  if (samples.cols() == 0) throw NetworkError("samples: " + gotExpected("0", "1 or more to cluster"));
  RandomNumbers random(seed);
  const Eigen::MatrixXd data = samples;
  KMeansResult result;
  result.centers = firstCenters(data, std::min(count, static_cast<int>(data.cols())), random);
  result.nearest = Eigen::VectorXi::Constant(data.cols(), -1);
  for (; result.iterations < maxIterations; ++result.iterations) {
    const Eigen::VectorXi before = result.nearest;
    result.inertia = assign(data, result.centers, result.nearest);
    if (result.nearest == before) break;
    moveToMeans(data, result.nearest, result.centers);
  }
  return result;
}

Eigen::VectorXi randomColumns(Eigen::Index samples, int count, std::uint64_t seed) {
  requireCount(count);
  RandomNumbers random(seed);
  std::vector<int> order(static_cast<std::size_t>(samples));
  std::iota(order.begin(), order.end(), 0);
  const std::size_t taken = std::min(order.size(), static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < taken; ++i) std::swap(order[i], order[i + random.below(order.size() - i)]);
  std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(taken));
  return Eigen::Map<Eigen::VectorXi>(order.data(), static_cast<Eigen::Index>(taken));
}

} // namespace palp
