#include "solver/CalculixDeck.h"

#include "model/DesignError.h"
#include "solver/SensorMesh.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
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

LoadCase onAreaOfDeck() {
  return {{{0, {0, 0, -1}}}, {}};
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
  const std::vector<double> constants{std::get<MooneyRivlin>(design_.material.law).c10_MPa,
                                      std::get<MooneyRivlin>(design_.material.law).c01_MPa,
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

TEST_P(Deck, HoldsTheConstantsOfEveryLaw) {
  struct Written {
    RubberLaw law;
    std::string keyword;
    std::vector<std::vector<double>> lines; ///< D1 = 2 / kappa is left to the test
  };
  const double vanishing = 1e9; // D2 and D3, for which CalculiX replaces 0
  const std::vector<Written> all{
      {NeoHooke{0.2}, "*HYPERELASTIC, NEO HOOKE", {{0.2, 0}}},
      {Yeoh{0.2, 0.03, 0.002}, "*HYPERELASTIC, YEOH", {{0.2, 0.03, 0.002, 0, vanishing, vanishing}}},
      {Ogden{{0.4}, {2}}, "*HYPERELASTIC, OGDEN, N=1", {{0.4, 2, 0}}},
      {Ogden{{0.4, 0.02}, {2, 5}}, "*HYPERELASTIC, OGDEN, N=2", {{0.4, 2, 0.02, 5, 0, vanishing}}},
      {Ogden{{0.4, 0.02, 0.1}, {2, 5, -2}},
       "*HYPERELASTIC, OGDEN, N=3",
       {{0.4, 2, 0.02, 5, 0.1, -2, 0, vanishing}, {vanishing}}}};
  for (const auto& [law, keyword, lines] : all) {
    design_.material.law = law;
    auto deck = parsed(calculixDeck(design_, mesh_, onAreaOfDeck()));
    ASSERT_TRUE(deck.contains(keyword)) << keyword;
    const auto& written = deck[keyword];
    ASSERT_EQ(written.size(), lines.size()) << keyword;
    for (std::size_t line = 0; line < lines.size(); ++line) {
      ASSERT_EQ(written[line].size(), lines[line].size()) << keyword;
      for (std::size_t k = 0; k < lines[line].size(); ++k) {
        const double expected = lines[line][k] == 0 ? 2 * design_.material.compressibility_per_MPa() : lines[line][k];
        EXPECT_NEAR(written[line][k], expected, 1e-12 * std::abs(expected)) << keyword;
      }
    }
  }
}

TEST_P(Deck, IsRefusedForGentsLawWhichCalculixDoesNotHave) {
  design_.material.law = Gent{};
  try {
    static_cast<void>(calculixDeck(design_, mesh_, onAreaOfDeck()));
    FAIL() << "written";
  } catch (const DesignError& error) {
    EXPECT_NE(std::string(error.what()).find("got gent, expected mooney-rivlin, neo-hooke, yeoh or ogden"),
              std::string::npos)
        << error.what();
  }
}

TEST_P(Deck, IsRefusedForIncompressibleRubber) {
  design_.material.poissonRatio = 0.5;
  EXPECT_THROW(static_cast<void>(calculixDeck(design_, mesh_, {})), DesignError);
}

TEST_P(Deck, HoldsIndentersThatTouchTheTopAndMoveAsOne) {
  LoadCase load;
  load.indenters = {{IndenterShape::Sphere, 5, 0, {10, 12}, 0.5, Press{{0.4, 0, -2}}},
                    {IndenterShape::Flat, 3, 0.3, {22, 15}, 0, Motion{0.2, {0, 0}}}};
  auto deck = parsed(calculixDeck(design_, mesh_, load));
  const auto& sphere = deck["*NODE, NSET=INDENTER1"];
  double lowest = 100, outside = 0;
  for (std::size_t n = 0; n < sphere.size() / 2; ++n) { // the lower ones: on the sphere about (10, 12, 10)
    const Eigen::Vector3d at(sphere[n][1], sphere[n][2], sphere[n][3]);
    lowest = std::min(lowest, at.z());
    outside = std::max(outside, std::abs((at - Eigen::Vector3d(10, 12, 10)).norm() - 5));
  }
  EXPECT_NEAR(lowest, 5, 1e-12) << "it begins on the top face";
  EXPECT_LT(outside, 1e-11);
  // Wedges stand upright: their lower triangle runs counterclockwise seen from above.
  std::map<int, Eigen::Vector3d> place;
  for (const char* set : {"*NODE, NSET=INDENTER1", "*NODE, NSET=INDENTER2"})
    for (const auto& line : deck[set]) place[int(line[0])] = {line[1], line[2], line[3]};
  for (const char* set : {"*ELEMENT, TYPE=C3D6, ELSET=INDENTER1", "*ELEMENT, TYPE=C3D6, ELSET=INDENTER2"}) {
    ASSERT_GT(deck[set].size(), 100U);
    for (const auto& e : deck[set]) {
      ASSERT_EQ(e.size(), 7U);
      const Eigen::Vector3d a = place[int(e[1])], b = place[int(e[2])], c = place[int(e[3])], up = place[int(e[4])];
      EXPECT_GT((b - a).cross(c - a).dot(up - a), 0);
    }
  }
  // Every node of an indenter goes along with its reference in three directions.
  const std::size_t tied = sphere.size() + deck["*NODE, NSET=INDENTER2"].size();
  EXPECT_EQ(deck["*EQUATION"].size(), 2 * 3 * tied) << "a line with the count, one with the terms";
  // Each top face is the slave of one of them, and lies in the top face.
  const auto &one = deck["*SURFACE, NAME=SLAVE1, TYPE=ELEMENT"], &two = deck["*SURFACE, NAME=SLAVE2, TYPE=ELEMENT"];
  EXPECT_EQ(one.size() + two.size(), std::size_t(mesh_.topFaces.cols()));
  EXPECT_FALSE(one.empty() || two.empty());
  EXPECT_EQ(deck["*FRICTION"].size(), 1U) << "the punch has none";
  EXPECT_NEAR(deck["*FRICTION"][0][0], 0.5, 0);
  EXPECT_EQ(deck["*CONTACT PAIR, INTERACTION=CONTACT1, TYPE=SURFACE TO SURFACE"].size(), 1U);
  std::vector<double> pressed, aside;
  for (const auto& line : deck["*CLOAD, AMPLITUDE=AT_ONCE"]) pressed.push_back(line.back());
  for (const auto& line : deck["*CLOAD"]) aside.push_back(line.back());
  EXPECT_EQ(pressed, (std::vector<double>{-2}));
  EXPECT_EQ(aside, (std::vector<double>{0.4, 0}));
}

} // namespace
