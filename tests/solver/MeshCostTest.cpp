#include "solver/MeshCost.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palp {
namespace {

TEST(MeshCost, CountsTheElementsOfTheMeshBeforeItIsMade) {
  for (const double share : {3., 1.}) {
    MeshOptions options;
    options.meshSize_mm = share * standardMeshSize_mm(paperDesign());
    const double made = sensorMesh(paperDesign(), options).elementCount();
    EXPECT_NEAR(meshCost(paperDesign(), options).elements / made, 1, 0.2)
        << share; // electrodes bring lines in addition
  }
  EXPECT_EQ(costInWords(meshCost(paperDesign())), "");
}

TEST(MeshCost, SaysElementsTimeAndMemoryOfAMeshThatTakesLong) {
  MeshOptions options;
  options.mapped = {100, 100, 40};
  const std::string words = costInWords(meshCost(paperDesign(), options));
  EXPECT_NE(words.find("400,000 elements"), std::string::npos) << words;
  EXPECT_NE(words.find(" min and "), std::string::npos) << words;
  EXPECT_NE(words.find(" GB"), std::string::npos) << words;
}

TEST(MeshCost, IsWhatTheMeshesOfThePapersBlockTook) {
  struct Measured {
    double elements, seconds, memory_MB; ///< of processor time
  };
  const double coresOfTwo = 1.7, within = 1.3;
  for (const auto& [elements, seconds, memory_MB] :
       {Measured{9720, 1.2, 234}, {30576, 8.1, 720}, {53760, 26.8, 1503}, {105336, 79, 3170}}) {
    // As many elements: hexahedra have fewer unknowns.
    MeshOptions options;
    options.mapped = {static_cast<int>(std::lround(elements * 4.2 / 3.3)), 1, 1};
    const MeshCost cost = meshCost(paperDesign(), options);
    EXPECT_LT(std::abs(std::log(cost.seconds * coresOfTwo / seconds)), std::log(within)) << elements;
    EXPECT_LT(std::abs(std::log(cost.memory_MB / memory_MB)), std::log(within)) << elements;
  }
}

TEST(MeshCost, FollowsInAFewWordsWhatIsBeingDone) {
  EXPECT_EQ(costInBrief(meshCost(paperDesign())), "");
  MeshOptions options;
  options.mapped = {100, 100, 40};
  const std::string words = costInBrief(meshCost(paperDesign(), options));
  EXPECT_EQ(words.find(": 400,000 elements, about "), 0U) << words;
  EXPECT_NE(words.find(" GB"), std::string::npos) << words;
}

} // namespace
} // namespace palp
