#include "app/study/live/simulated/MovingTouch.h"

#include "app/study/touch/SampleGenerator.h"
#include "app/study/touch/Touch.h"
#include "model/base/Error.h"
#include "tests/app/study/live/LiveFixture.h"
#include "tests/io/Refusal.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

/// Touches of one sphere on a coarse mesh.
const SampleSet& solvedTouches() {
  static const SampleSet samples = [] {
    SampleRequest request;
    request.perArea = 420;
    request.touches = touchesOf(paperDesign());
    request.touches->smallest_mm = request.touches->largest_mm = 8;
    request.relativeTolerance = 1e-5;
    request.mesh.mapped = {15, 15, 1};
    SampleGenerator generator(paperDesign(), request);
    SampleSet all = generator.emptySet();
    generator.generate({0, generator.total()}, [&](const SampleSet& block) { append(all, block); });
    return all;
  }();
  return samples;
}

SampleSet firstOf(Eigen::Index count) {
  std::vector<Eigen::Index> chosen;
  for (Eigen::Index k = 0; k < count; ++k) chosen.push_back(k);
  return samplesAt(solvedTouches(), chosen);
}

SimulatedTouch::Truth truthOf(const SampleSet& samples, Eigen::Index k) {
  SimulatedTouch::Truth truth;
  truth.place_mm = samples.touchedPlaces_mm().col(k);
  truth.force_N = samples.forces_N.col(k);
  return truth;
}

TEST(MovingTouch, GoesThroughTheSolvedTouchesAndNearThoseThatItDoesNotKnow) {
  const SampleSet& all = solvedTouches();
  constexpr Eigen::Index kKnown = 400;
  const Eigen::MatrixXd rest = resistancesAtRest_ohm(paperDesign());
  SampleSet known = firstOf(kKnown), still = firstOf(1);
  still.forces_N.setZero();
  still.resistances_ohm.col(0) = rest.reshaped<Eigen::RowMajor>();
  append(known, still);
  const MovingTouch touch(known);
  double through = 0, off = 0, whole = 0;
  for (Eigen::Index k = 0; k < all.size(); ++k) {
    const Eigen::MatrixXd found = touch.resistances_ohm(truthOf(all, k));
    const Eigen::MatrixXd solved = all.resistances_ohm.col(k).reshaped<Eigen::RowMajor>(all.rowWires, all.columnWires);
    if (k < kKnown) {
      through = std::max(through, (found.array() / solved.array() - 1).abs().maxCoeff());
      continue;
    }
    off += (found.array() / solved.array()).log().matrix().squaredNorm();
    whole += (solved.array() / rest.array()).log().matrix().squaredNorm();
  }
  EXPECT_LT(through, 1e-9);
  EXPECT_LT(std::sqrt(off / whole), 0.35) << "of a change, 1.2 mm from touch to touch on a mesh of 2 mm";
  const Eigen::MatrixXd atRest = touch.resistances_ohm({});
  EXPECT_LT((atRest.array() / rest.array()).log().abs().maxCoeff(), 1e-9);
}

TEST(MovingTouch, WandersRestsAndIsHeldAndTellsWhereItIs) {
  MovingTouch touch(firstOf(30));
  EXPECT_EQ(touch.truth(0.5).force_N, Eigen::Vector3d::Zero()) << "time to tare";
  EXPECT_LT(touch.truth(2).force_N.z(), -2);
  EXPECT_GT((*touch.truth(2).place_mm - *touch.truth(5).place_mm).norm(), 2);
  for (double t = 0; t < 40; t += 0.37) {
    EXPECT_TRUE((touch.truth(t).place_mm->array() >= 3).all() && (touch.truth(t).place_mm->array() <= 27).all()) << t;
  }
  const auto hand = std::make_shared<TouchHand>();
  touch.follow(hand);
  touch.at(2);
  ASSERT_TRUE(hand->at(2));
  EXPECT_EQ(hand->at(2)->place_mm, touch.truth(2).place_mm);
  SimulatedTouch::Truth held;
  held.place_mm = Eigen::Vector2d(10, 20);
  held.force_N = {1, 0, -3}; // nothing holds it sideways
  hand->hold(held);
  const Eigen::MatrixXd there = touch.at(2.1);
  EXPECT_EQ(hand->at(2.1)->force_N, Eigen::Vector3d(0, 0, -3));
  EXPECT_EQ(there, touch.resistances_ohm(held));
  EXPECT_EQ(hand->at(2)->place_mm, touch.truth(2).place_mm) << "of that time";
}

TEST(MovingTouch, RefusesTouchesThatDifferInWords) {
  SampleSet other = firstOf(30);
  other.touches(kTouchSize_mm, 3) = 2;
  EXPECT_NE(refusal([&] { MovingTouch{other}; }).find("one shape, size"), std::string::npos);
  other = firstOf(30);
  other.forces_N(0, 5) = 1;
  EXPECT_NE(refusal([&] { MovingTouch{other}; }).find("without tangential force"), std::string::npos);
  EXPECT_NE(refusal([&] { MovingTouch{firstOf(5)}; }).find("20 or more"), std::string::npos);
  EXPECT_NE(refusal([&] { MovingTouch{shippedSamples()}; }).find("samples of touches"), std::string::npos);
}

} // namespace
} // namespace palp
