#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace palp {

/// K-means clustering with k-means++ start (Arthur and Vassilvitskii 2007); repeats for equal seeds.
struct KMeansResult {
  Eigen::MatrixXd centers; ///< one column a centre
  Eigen::VectorXi nearest; ///< centre of each sample
  double inertia = 0;      ///< sum of squared distances to the nearest centre
  int iterations = 0;
};
/// At most one centre a distinct sample; throws NetworkError for count < 1.
KMeansResult kMeans(const Eigen::Ref<const Eigen::MatrixXd>& samples, int count, std::uint64_t seed,
                    int maxIterations = 100);

/// `count` different columns of 0..samples-1, in ascending order; repeats for equal seeds.
Eigen::VectorXi randomColumns(Eigen::Index samples, int count, std::uint64_t seed);

} // namespace palp
