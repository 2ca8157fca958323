#include "solver/MeshCost.h"

#include <gtest/gtest.h>

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

} // namespace
} // namespace palp
