#include "solver/CalculixDeck.h"

#include "model/DesignError.h"
#include "solver/SensorMesh.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <string>
#include <vector>

using namespace palp;

namespace {

/// The numbers of a deck's data lines by keyword line, in order; words count as nothing.
std::map<std::string, std::vector<std::vector<double>>> parsed(const std::string& deck) {
  std::map<std::string, std::vector<std::vector<double>>> blocks;
  std::string keyword, line;
  for (std::istringstream lines(deck); std::getline(lines, line);) {
    EXPECT_LE(std::count(line.begin(), line.end(), ','), 15) << line; // entries of a line
    if (line[0] == '*') {
      keyword = line;
      blocks[keyword];
      continue;
    }
    std::vector<double> numbers;
    std::string entry;
    for (std::istringstream entries(line); std::getline(entries, entry, ',');) {
      std::istringstream value(entry);
      double number = 0;
      if (!(value >> number)) continue;
      EXPECT_LE(entry.size(), 21U) << line; // a blank and the 20 characters that CalculiX reads
      numbers.push_back(number);
    }
    blocks[keyword].push_back(numbers);
  }
  return blocks;
}

class Deck : public testing::TestWithParam<bool> {
protected:
  SensorDesign design_ = paperDesign();
  Mesh mesh_ = GetParam() ? sensorMesh(design_, {.meshSize_mm = 9, .mapped = {}})
                          : sensorMesh(design_, {.meshSize_mm = {}, .mapped = std::array{3, 2, 1}});
};
INSTANTIATE_TEST_SUITE_P(TetsAndHexes, Deck, testing::Bool());

TEST_P(Deck, HoldsTheMeshTheMaterialTheClampAndTheWholeLoadByValue) {
  const LoadCase load{{{0, {0.5, 0, -6}}, {3, {0, 1, -2}}}, {}};
  auto deck = parsed(calculixDeck(design_, mesh_, load));
  const auto& nodes = deck["*NODE, NSET=ALL"];
  ASSERT_EQ(static_cast<int>(nodes.size()), mesh_.nodeCount());
  for (int n = 0; n < mesh_.nodeCount(); ++n) {
    ASSERT_EQ(nodes[n].size(), 4U);
    EXPECT_EQ(nodes[n][0], n + 1);
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(nodes[n][1 + d], mesh_.nodes_mm(d, n), 1e-11); // 13 digits
  }
  const auto& elements = deck[GetParam() ? "*ELEMENT, TYPE=C3D10, ELSET=BLOCK" : "*ELEMENT, TYPE=C3D8, ELSET=BLOCK"];
  ASSERT_EQ(static_cast<int>(elements.size()), mesh_.elementCount());
  for (int e = 0; e < mesh_.elementCount(); ++e) {
    ASSERT_EQ(static_cast<Eigen::Index>(elements[e].size()), 1 + mesh_.elements.rows());
    EXPECT_EQ(elements[e][0], e + 1);
    for (Eigen::Index n = 0; n < mesh_.elements.rows(); ++n) EXPECT_EQ(elements[e][1 + n], mesh_.elements(n, e) + 1);
  }
  const auto& material = deck["*HYPERELASTIC, MOONEY-RIVLIN"];
  ASSERT_EQ(material.size(), 1U);
  const std::vector<double> constants{design_.material.c10_MPa, design_.material.c01_MPa,
                                      2 * design_.material.compressibility_per_MPa()}; // d = 2 / kappa
  ASSERT_EQ(material[0].size(), constants.size());
  for (std::size_t k = 0; k < constants.size(); ++k) EXPECT_NEAR(material[0][k], constants[k], 1e-12); // 13 digits
  std::vector<double> bottom, clamped;
  for (const auto& line : deck["*NSET, NSET=BOTTOM"]) bottom.push_back(line[0]);
  for (int n = 0; n < mesh_.nodeCount(); ++n)
    if (mesh_.nodes_mm(2, n) == 0) clamped.push_back(n + 1);
  EXPECT_EQ(bottom, clamped);
  EXPECT_EQ(deck["*BOUNDARY"], (std::vector<std::vector<double>>{{1, 3}})); // BOTTOM, 1, 3
  Eigen::Vector3d total = Eigen::Vector3d::Zero(), moment = total;
  for (const auto& line : deck["*CLOAD"]) {
    ASSERT_EQ(line.size(), 3U);
    const int node = static_cast<int>(line[0]) - 1, d = static_cast<int>(line[1]) - 1;
    total(d) += line[2];
    moment += mesh_.nodes_mm.col(node).cross(line[2] * Eigen::Vector3d::Unit(d));
    EXPECT_EQ(mesh_.nodes_mm(2, node), 5);
  }
  const Eigen::Vector3d expected = Eigen::Vector3d(5, 7.5, 5).cross(load.areas[0].force_N) +
                                   Eigen::Vector3d(5, 22.5, 5).cross(load.areas[1].force_N);
  EXPECT_LT((total - load.totalForce_N()).norm(), 1e-10); // sums of numbers of 13 digits
  EXPECT_LT((moment - expected).norm(), 1e-8);
  EXPECT_EQ(deck["*NSET, NSET=UPPER_ELECTRODES"].size(), GetParam() ? 100U : 0U);
}

TEST_P(Deck, IsRefusedForIncompressibleRubber) {
  design_.material.poissonRatio = 0.5;
  EXPECT_THROW(static_cast<void>(calculixDeck(design_, mesh_, {})), DesignError);
}

TEST_P(Deck, IsRefusedForAnIndenterThatItCannotHold) {
  LoadCase load;
  load.indenters.emplace_back().place_mm = {15, 15};
  EXPECT_THROW(static_cast<void>(calculixDeck(design_, mesh_, load)), DesignError);
}

} // namespace
