#include "nn/rbf/KMeans.h"

#include "nn/NetworkError.h"

#include <gtest/gtest.h>

#include <set>

namespace palp {
namespace {

TEST(KMeans, FindsClustersThatLieApart) {
  Eigen::MatrixXd samples = 0.1 * Eigen::MatrixXd::Random(2, 90);
  for (int i = 0; i < 90; ++i) samples(i % 2, i) += 10 * (i % 3);
  const KMeansResult result = kMeans(samples, 3, 1);
  for (int i = 3; i < 90; i += 6) EXPECT_EQ(result.nearest(i), result.nearest(3));
  EXPECT_LT(result.inertia, 90 * 60); // far below that of one centre
}

TEST(KMeans, RepeatsForEqualSeeds) {
  const Eigen::MatrixXd samples = Eigen::MatrixXd::Random(3, 50);
  EXPECT_EQ(kMeans(samples, 7, 5).centers, kMeans(samples, 7, 5).centers);
}

TEST(KMeans, GivesNoMoreCentresThanThereAreDistinctSamples) {
  const Eigen::MatrixXd samples = Eigen::MatrixXd::Ones(3, 50);
  EXPECT_EQ(kMeans(samples, 7, 1).centers.cols(), 1);
}

TEST(KMeans, RefusesNoCentres) {
  EXPECT_THROW(kMeans(Eigen::MatrixXd::Ones(1, 1), 0, 1), NetworkError);
}

TEST(KMeans, RandomColumnsAreDifferentAndAscend) {
  const Eigen::VectorXi columns = randomColumns(40, 20, 3);
  EXPECT_EQ(std::set<int>(columns.begin(), columns.end()).size(), 20U);
  EXPECT_TRUE(std::is_sorted(columns.begin(), columns.end()));
  EXPECT_EQ(randomColumns(5, 20, 3).size(), 5);
}

} // namespace
} // namespace palp
