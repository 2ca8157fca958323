#include "model/LoadCase.h"

#include <gtest/gtest.h>

#include <limits>

namespace palp {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

std::string problemOf(const LoadCase& load) {
  return whyInvalid(load, paperDesign()).value_or("");
}

TEST(LoadCase, AddsUpAllForces) {
  const LoadCase load{{{0, {1, 2, 3}}, {5, {0.5, 0, -6}}}, {{{15, 15}, 2, {0, 0, -1}}}};
  EXPECT_EQ(load.totalForce_N(), Eigen::Vector3d(1.5, 2, -4));
  EXPECT_EQ(LoadCase{}.totalForce_N(), Eigen::Vector3d::Zero());
}

TEST(LoadCase, ActsOnTheDesignWhereItsPartsLieOnIt) {
  EXPECT_EQ(problemOf({{{0, {1, 0, -6}}, {5, {0, 0, -1}}}, {{{5, 5}, 5, {0, 0, -1}}}}), "");
}

TEST(LoadCase, NamesTheAreaThatIsNotThere) {
  for (const int area : {-1, 6, 1000}) {
    const std::string sentence = problemOf({{{area, {0, 0, -1}}}, {}});
    EXPECT_NE(sentence.find("area: got " + std::to_string(area)), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("0 to 5"), std::string::npos) << sentence;
  }
}

TEST(LoadCase, NamesTheForceThatIsNoForce) {
  for (const double force : {kNotANumber, std::numeric_limits<double>::infinity(), -2e6}) {
    EXPECT_NE(problemOf({{{2, {0, force, 0}}}, {}}).find("area 2"), std::string::npos);
    EXPECT_NE(problemOf({{}, {{{15, 15}, 2, {0, 0, force}}}}).find("patch"), std::string::npos);
  }
}

TEST(LoadCase, NamesTheDiscThatLeavesTheFaceOrIsAPoint) {
  for (const PatchLoad& patch :
       {PatchLoad{{1, 15}, 2, {}}, PatchLoad{{29, 15}, 2, {}}, PatchLoad{{15, 1}, 2, {}}, PatchLoad{{15, 29}, 2, {}},
        PatchLoad{{15, 15}, 0, {}}, PatchLoad{{15, 15}, -1, {}}, PatchLoad{{15, 15}, kNotANumber, {}},
        PatchLoad{{15, 15}, 1e-200, {}}, PatchLoad{{15, 15}, 0.0099, {}}, PatchLoad{{kNotANumber, 15}, 2, {}}}) {
    const std::string sentence = problemOf({{}, {patch}});
    EXPECT_NE(sentence.find("30 x 30 mm"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("0.01 mm or more"), std::string::npos) << sentence;
  }
}

} // namespace
} // namespace palp
