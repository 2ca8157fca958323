#include "model/SampleSet.h"

#include "model/base/Error.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

const SampleOrigin kOrigin{"abc", 7, "each", 10, "tetrahedra", 1e-6, false, 0, 0};

TEST(SampleSet, OriginsThatAreTheSameDoNotDiffer) {
  SampleOrigin shard = kOrigin;
  shard.firstSample = 50;
  EXPECT_EQ(difference(kOrigin, shard), "");
}

TEST(SampleSet, NamesWhatDiffers) {
  const auto differs = [](auto change) {
    SampleOrigin other = kOrigin;
    change(other);
    return difference(kOrigin, other);
  };
  EXPECT_EQ(differs([](SampleOrigin& o) { o.designFingerprint = "abd"; }), "design differs: abc and abd");
  EXPECT_EQ(differs([](SampleOrigin& o) { o.seed = 8; }), "seed differs: 7 and 8");
  EXPECT_EQ(differs([](SampleOrigin& o) { o.areas = "0"; }), "areas differs: each and 0");
  EXPECT_EQ(differs([](SampleOrigin& o) { o.perArea = 11; }), "per_area differs: 10 and 11");
  EXPECT_EQ(differs([](SampleOrigin& o) { o.mesh = "m"; }), "mesh differs: tetrahedra and m");
  EXPECT_EQ(differs([](SampleOrigin& o) { o.solverTolerance = 1e-5; }), "solver tolerance differs: 1e-06 and 1e-05");
  EXPECT_EQ(differs([](SampleOrigin& o) { o.surrogate = true; }), "kind differs: full solves and surrogate");
}

SampleSet setOf(int area, double value) {
  SampleSet set;
  set.area = Eigen::VectorXi::Constant(2, area);
  set.forces_N = Eigen::MatrixXd::Constant(3, 2, value);
  set.displacements_mm = Eigen::MatrixXd::Constant(6, 2, value);
  set.resistances_ohm = Eigen::MatrixXd::Constant(4, 2, value);
  return set;
}

TEST(SampleSet, PlacesAreThoseOfTouchesOrMeasured) {
  SampleSet set = setOf(0, 1);
  EXPECT_FALSE(set.hasPlaces());
  set.places_mm = Eigen::MatrixXd::Identity(2, 2);
  set.times_s = Eigen::RowVector2d(3, 4);
  EXPECT_TRUE(set.hasPlaces() && !set.hasTouches());
  EXPECT_EQ(set.touchedPlaces_mm(), Eigen::Matrix2d::Identity());
  const SampleSet turned = samplesAt(set, {1, 0, 1});
  EXPECT_EQ(turned.times_s, Eigen::RowVector3d(4, 3, 4));
  EXPECT_EQ(turned.places_mm.row(0), Eigen::RowVector3d(0, 1, 0));
  append(set, set);
  EXPECT_EQ(set.times_s, Eigen::RowVector4d(3, 4, 3, 4));
  set.touches = Eigen::MatrixXd::Constant(kTouchRows, 4, 9);
  EXPECT_EQ(set.touchedPlaces_mm(), Eigen::MatrixXd::Constant(2, 4, 9));
}

TEST(SampleSet, AppendsAtTheEnd) {
  SampleSet set;
  append(set, setOf(0, 1));
  append(set, setOf(3, 2));
  EXPECT_EQ(set.size(), 4);
  EXPECT_EQ(set.area, (Eigen::VectorXi(4) << 0, 0, 3, 3).finished());
  EXPECT_EQ(set.forces_N.row(2), Eigen::RowVector4d(1, 1, 2, 2));
  EXPECT_EQ(set.displacements_mm.row(5), Eigen::RowVector4d(1, 1, 2, 2));
  EXPECT_EQ(set.resistances_ohm.row(3), Eigen::RowVector4d(1, 1, 2, 2));
}

TEST(SampleSet, KnowsThatAllAreasAreLoadedTogether) {
  EXPECT_FALSE(setOf(0, 1).together());
  EXPECT_TRUE(setOf(-1, 1).together()); // one area: as many forces as alone
}

TEST(SampleSet, OfOtherColumnsIsNotJoined) {
  SampleSet set = setOf(0, 1), other = setOf(0, 1);
  other.resistances_ohm.resize(5, 2);
  EXPECT_THROW(append(set, other), Error);
  EXPECT_EQ(set.area.size(), 2) << "as it was";
}

} // namespace
} // namespace palp
