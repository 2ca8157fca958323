#include "solver/mesh/GradedTets.h"

#include "model/DesignError.h"
#include "model/TouchRange.h"
#include "model/base/Cancelled.h"
#include "solver/HyperelasticProblem.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>
#include <set>

using namespace palp;

namespace {

/// Volume of the elements by their corners, each counted as positive: more than the block's where they overlap.
double volume(const Mesh& mesh) {
  double sum = 0;
  for (int e = 0; e < mesh.elementCount(); ++e) {
    Eigen::Matrix3d edges;
    for (int i = 0; i < 3; ++i)
      edges.col(i) = mesh.nodes_mm.col(mesh.elements(i + 1, e)) - mesh.nodes_mm.col(mesh.elements(0, e));
    sum += edges.determinant() / 6;
    EXPECT_GT(edges.determinant(), 0) << e;
  }
  return sum;
}

/// Area of the top faces of one load area, or of all (-1).
double topArea(const Mesh& mesh, int area) {
  double sum = 0;
  for (Eigen::Index f = 0; f < mesh.topFaces.cols(); ++f) {
    if (area >= 0 && mesh.topFaceAreas(f) != area) continue;
    const auto corner = [&](int n) { return Eigen::Vector3d(mesh.nodes_mm.col(mesh.topFaces(n, f))); };
    sum += (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm() / 2;
  }
  return sum;
}

void expectSoundMesh(const SensorDesign& design, const Mesh& mesh) {
  EXPECT_NEAR(volume(mesh), design.block_mm.prod(), 1e-9 * design.block_mm.prod()); // sums of 1e5 numbers
  for (int area = 0; area < design.areas.count(); ++area) {
    const Rectangle r = design.areaRectangle(area);
    EXPECT_NEAR(topArea(mesh, area), (r.high_mm - r.low_mm).prod(), 1e-9 * (r.high_mm - r.low_mm).prod()) << area;
  }
  const Eigen::Matrix3Xd electrodes = design.upperElectrodes_mm();
  if (mesh.upperElectrodeNodes.empty()) return;
  ASSERT_EQ(static_cast<Eigen::Index>(mesh.upperElectrodeNodes.size()), electrodes.cols());
  for (std::size_t i = 0; i < mesh.upperElectrodeNodes.size(); ++i)
    EXPECT_EQ(Eigen::Vector3d(mesh.nodes_mm.col(mesh.upperElectrodeNodes[i])),
              Eigen::Vector3d(electrodes.col(static_cast<Eigen::Index>(i))));
}

/// Ascending random coordinates inside the length that keep their distance.
std::vector<double> irregular(int count, double length, double apart, std::mt19937& random) {
  std::uniform_real_distribution<double> anywhere(0.3, length - 0.3 - (count - 1) * apart);
  std::vector<double> x(count);
  for (double& value : x) value = anywhere(random);
  std::sort(x.begin(), x.end());
  for (int i = 0; i < count; ++i) x[i] += i * apart;
  return x;
}

/// Electrodes at random places along each row-wire.
SensorDesign irregularDesign(int electrodes, double height_mm, bool wireByWire, bool depths, unsigned seed) {
  std::mt19937 random(seed);
  SensorDesign design = paperDesign();
  design.block_mm.z() = height_mm;
  design.lower.z_mm = {{0.2 * height_mm}};
  design.upper.z_mm = {{0.8 * height_mm}};
  design.upper.along_mm.clear();
  for (int wire = 0; wire < (wireByWire ? design.rowWires() : 1); ++wire)
    design.upper.along_mm.push_back(irregular(electrodes, 30, 0.12, random));
  if (depths) {
    std::uniform_real_distribution<double> depth(0.5 * height_mm, 0.95 * height_mm);
    design.upper.z_mm.assign(design.rowWires(), std::vector<double>(electrodes));
    for (std::vector<double>& list : design.upper.z_mm)
      for (double& z : list) z = depth(random);
  }
  return design;
}

Mesh meshOf(const SensorDesign& design, double times = 1) {
  return gradedTets(design, defaultGrading(design, times * standardSize(design)));
}

TEST(GradedTets, FillTheBlockAndItsLoadAreasWithTheElectrodesAsNodes) {
  for (const double height : {1., 5., 30.}) {
    SensorDesign design = paperDesign();
    design.block_mm.z() = height;
    design.upper.z_mm = {{0.8 * height}};
    design.lower.z_mm = {{0.2 * height}};
    const Mesh mesh = meshOf(design, 2);
    EXPECT_FALSE(mesh.upperElectrodeNodes.empty());
    expectSoundMesh(design, mesh);
  }
}

TEST(GradedTets, AreFinerForTheFieldOnlyWhereLowerElectrodesFollowOrPressureActs) {
  SensorDesign design = paperDesign();
  const Mesh plain = meshOf(design);
  const auto same = [&](const Mesh& mesh) {
    return mesh.nodes_mm == plain.nodes_mm && mesh.elements == plain.elements;
  };
  design.lowerFollowsRubber = true;
  EXPECT_TRUE(same(meshOf(design))) << "Eq. (1)";
  design.resistance = FieldLaw{};
  const Mesh finer = meshOf(design);
  EXPECT_GT(finer.nodeCount(), plain.nodeCount());
  EXPECT_LT(finer.nodeCount(), 2 * plain.nodeCount());
  EXPECT_FALSE(finer.upperElectrodeNodes.empty());
  expectSoundMesh(design, finer);
  design.lowerFollowsRubber = false;
  EXPECT_TRUE(same(meshOf(design))) << "held";
  design.pressureLaw = PressureLaw{};
  const Mesh pressed = meshOf(design);
  EXPECT_GT(pressed.nodeCount(), finer.nodeCount()) << "in the bulk as well";
  EXPECT_LT(pressed.nodeCount(), 4 * plain.nodeCount());
}

/// Random layouts: electrodes a row-wire, height, a list a wire, a depth an electrode.
struct Layout {
  int electrodes;
  double height_mm;
  bool wireByWire, depths;
};
/// In the names of the tests.
void PrintTo(const Layout& layout, std::ostream* out) {
  *out << layout.electrodes << " electrodes, " << layout.height_mm << " mm high"
       << (layout.wireByWire ? ", wire by wire" : "") << (layout.depths ? ", at depths of their own" : "");
}
class IrregularElectrodes : public testing::TestWithParam<Layout> {};
INSTANTIATE_TEST_SUITE_P(Layouts, IrregularElectrodes,
                         testing::Values(Layout{45, 5, false, false}, Layout{45, 1, false, false},
                                         Layout{45, 30, false, false}, Layout{45, 5, true, false},
                                         Layout{12, 5, true, false}, Layout{12, 5, true, true},
                                         Layout{10, 30, true, true}, Layout{6, 1, true, true},
                                         Layout{200, 5, false, false}));

TEST_P(IrregularElectrodes, AreMeshedSoundly) {
  const auto [electrodes, height, wireByWire, depths] = GetParam();
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const SensorDesign design = irregularDesign(electrodes, height, wireByWire, depths, seed);
    ASSERT_TRUE(check(design).empty()) << check(design)[0].sentence;
    expectSoundMesh(design, meshOf(design, 1.5));
  }
}

TEST(GradedTets, KeepElectrodesAsNodesWhereAFewLinesMoreServeThem) {
  SensorDesign design = paperDesign();
  design.upper.along_mm.assign(10, {});
  for (int w = 0; w < 10; ++w) // wire by wire elsewhere, at 100 coordinates in all
    for (int e = 0; e < 10; ++e) design.upper.along_mm[w].push_back(1.2 + 2.9 * e + 0.05 * w);
  const Mesh mesh = meshOf(design);
  EXPECT_FALSE(mesh.upperElectrodeNodes.empty());
  expectSoundMesh(design, mesh);
}

TEST(GradedTets, LeaveElectrodesInsideElementsWhereTheyLieAlmostTogether) {
  SensorDesign design = paperDesign();
  design.upper.along_mm[0][1] = design.upper.along_mm[0][0] + 2e-6; // what check() lets pass
  design.upper.along_mm[0][5] = 1e-7 + 15;                          // beside a wire of the grid
  ASSERT_TRUE(check(design).empty());
  const Mesh mesh = meshOf(design, 1.5);
  expectSoundMesh(design, mesh);
  EXPECT_TRUE(mesh.upperElectrodeNodes.empty());
  design = paperDesign();
  design.upper.along_mm[0][0] = 1e-7; // at a face, where points stay in their plane
  ASSERT_TRUE(check(design).empty());
  expectSoundMesh(design, meshOf(design, 1.5));
}

TEST(GradedTets, AreSmallestAtTheBordersAndTheLoadedFaceAndGrowWithTheDistance) {
  const SensorDesign design = paperDesign();
  const Grading grading = defaultGrading(design, standardSize(design));
  const Mesh mesh = gradedTets(design, grading, {}, {}, false);
  // Lines of the grid along x at the top edge y = 0, and along z at the corner.
  const auto lines = [&](int along) {
    std::vector<double> x;
    const int corners = mesh.elements.topRows<4>().maxCoeff() + 1;
    for (int n = 0; n < corners; ++n) {
      const Eigen::Vector3d p = mesh.nodes_mm.col(n);
      const bool on = along == 2 ? p.x() == 0 && p.y() == 0 : p.y() == 0 && p.z() == design.block_mm.z();
      if (on) x.push_back(p(along));
    }
    std::sort(x.begin(), x.end());
    return x;
  };
  const std::vector<double> x = lines(0), z = lines(2);
  const auto cellAt = [](const std::vector<double>& grid, double at) {
    const auto above = std::lower_bound(grid.begin() + 1, grid.end() - 1, at);
    return *above - *(above - 1);
  };
  EXPECT_LT(cellAt(x, 10.01), 1.5 * grading.border_mm.x());
  EXPECT_LT(cellAt(x, 9.99), 1.5 * grading.border_mm.x());
  EXPECT_LT(cellAt(x, 0.01), 1.5 * grading.edge_mm.x());
  EXPECT_GT(cellAt(x, 15), 1.5 * cellAt(x, 10.01));
  EXPECT_LT(cellAt(z, design.block_mm.z()), 1.5 * grading.top_mm);
  EXPECT_LT(cellAt(z, 0), 1.5 * grading.bottom_mm);
  EXPECT_GT(cellAt(z, 2.5), cellAt(z, design.block_mm.z()));
  for (const auto& [grid, largest] : {std::pair{x, grading.bulk_mm.x()}, {z, grading.vertical_mm}})
    for (std::size_t i = 0; i + 1 < grid.size(); ++i) EXPECT_LT(grid[i + 1] - grid[i], 1.5 * largest);
  for (const double border : {10., 20.}) EXPECT_TRUE(std::binary_search(x.begin(), x.end(), border));
}

TEST(GradedTets, RunDiagonalsIntoTheEdgesWhereStressesAreSingular) {
  // Each corner of the clamped face, and each point where borders of load areas cross, has a face diagonal.
  const SensorDesign design = paperDesign();
  const Mesh mesh = gradedTets(design, defaultGrading(design, standardSize(design)), {}, {}, false);
  const auto hasDiagonal = [&](const Eigen::Vector3d& p) {
    for (int e = 0; e < mesh.elementCount(); ++e)
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b < 4; ++b) {
          const Eigen::Vector3d from = mesh.nodes_mm.col(mesh.elements(a, e)),
                                to = mesh.nodes_mm.col(mesh.elements(b, e));
          if ((from - p).norm() < 1e-9 && from.z() == to.z() && from.x() != to.x() && from.y() != to.y()) return true;
        }
    return false;
  };
  for (const double x : {0., 30.})
    for (const double y : {0., 30.}) EXPECT_TRUE(hasDiagonal({x, y, 0})) << x << " " << y;
  for (const double x : {10., 20.}) EXPECT_TRUE(hasDiagonal({x, 15, 5})) << x;
}

SensorDesign withAreas(int columns, int rows) {
  SensorDesign design = paperDesign();
  design.areas = {columns, rows};
  return design;
}

TEST(GradedTets, FollowNarrowAreasOnlyAcrossThemAndAsFarAsElectrodesFeelThem) {
  const double paper = gradedElements(paperDesign(), {});
  EXPECT_LT(gradedElements(withAreas(20, 1), {}), 6 * paper); // 48 times where the narrow side sets all sizes
  EXPECT_LT(gradedElements(withAreas(1, 20), {}), 6 * paper);
  EXPECT_LT(gradedElements(withAreas(40, 1), {}), 11 * paper);
  const Grading narrow = defaultGrading(withAreas(20, 1), standardSize(withAreas(20, 1)));
  const Grading same = defaultGrading(paperDesign(), standardSize(paperDesign()));
  EXPECT_LT(narrow.bulk_mm.x(), same.bulk_mm.x());
  EXPECT_EQ(narrow.bulk_mm.y(), same.bulk_mm.y());
  EXPECT_EQ(narrow.border_mm.y(), same.border_mm.y());
}

/// Narrow areas over an electrode 1 mm below them: what the cells leave in its displacement is no more than on the
/// paper's block, 0.9 %.
TEST(GradedTets, OfNarrowAreasAreAsGoodForTheElectrodesAsThePapers) {
  SensorDesign design = paperDesign();
  design.block_mm = {3, 3, 5};
  design.areas = {2, 1};
  design.upper = {{1.5}, {{1.5}}, {{4}}};
  design.lower = {{1, 2}, {{1.5}}, {{1}}};
  const auto upper_mm = [&](double times) {
    const HyperelasticProblem problem(design, meshOf(design, times));
    return problem.electrodes(problem.solve({{{1, {0.03, 0, -0.18}}}, {}}).state()).upper_mm;
  };
  const Eigen::Matrix3Xd standard = upper_mm(1), fine = upper_mm(0.8);
  EXPECT_LT((standard - fine).norm(), 0.009 * fine.norm());
}

TEST(GradedTets, RefuseMoreElementsThanAllowedAndStopWhenAsked) {
  const SensorDesign design = paperDesign();
  EXPECT_THROW(static_cast<void>(meshOf(design, 0.1)), DesignError);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(static_cast<void>(
                   gradedTets(design, defaultGrading(design, standardSize(design)), {}, {}, true, stop.get_token())),
               Cancelled);
}

} // namespace

// The mesh of touches under the field, of which a decoder learns: smaller cells, more layers, and no other's.
TEST(GradedTets, OfTouchesUnderTheFieldHaveSmallerCellsAndMoreLayers) {
  const auto layers = [](const Mesh& mesh) {
    std::set<long> heights; // of corners, in nm
    for (int e = 0; e < mesh.elementCount(); ++e)
      for (int i = 0; i < 4; ++i) heights.insert(std::lround(1e6 * mesh.nodes_mm(2, mesh.elements(i, e))));
    return heights.size() - 1;
  };
  SensorDesign design = paperDesign();
  TouchRange range = touchesOf(design);
  range.low_mm = {9, 9};
  range.high_mm = {15, 15};
  const MeshOptions pairs = meshForPart(design, range, {}), learned = meshToLearnFrom(design, range, {});
  design.resistance = FieldLaw{};
  const MeshOptions field = meshForPart(design, range, {});
  EXPECT_EQ(pairs.zones.at(0).layer_mm, pairs.zones.at(0).size_mm.minCoeff());
  EXPECT_TRUE(field.zones.at(0).size_mm.isApprox(0.8 * pairs.zones.at(0).size_mm));
  EXPECT_LT(meshToLearnFrom(design, range, {}).zones.at(0).layer_mm, learned.zones.at(0).layer_mm);
  const Mesh coarse = sensorMesh(design, pairs), fine = sensorMesh(design, field);
  EXPECT_GT(fine.nodeCount(), 1.3 * coarse.nodeCount());
  EXPECT_GT(layers(fine), layers(coarse));
}
