#include "tests/benchmarks/CalculixBricks.h"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <map>
#include <sstream>
#include <vector>

namespace palp::bench {

namespace {

/// Nodes of 20-node bricks: the points of a grid of half bricks with at most one odd index.
class BrickGrid {
public:
  BrickGrid(const Eigen::Vector3d& block, const std::array<int, 3>& counts) : block_(block), counts_(counts) {
    for (int k = 0; k <= 2 * counts[2]; ++k)
      for (int j = 0; j <= 2 * counts[1]; ++j)
        for (int i = 0; i <= 2 * counts[0]; ++i)
          if (i % 2 + j % 2 + k % 2 < 2) number_.emplace(std::array{i, j, k}, static_cast<int>(number_.size()) + 1);
  }
  [[nodiscard]] int number(int i, int j, int k) const { return number_.at({i, j, k}); }
  [[nodiscard]] const std::map<std::array<int, 3>, int>& numbers() const { return number_; }
  [[nodiscard]] double at(int direction, int index) const {
    return block_(direction) * index / (2 * counts_[direction]);
  }
  [[nodiscard]] const std::array<int, 3>& counts() const { return counts_; }
  [[nodiscard]] int top() const { return 2 * counts_[2]; }

private:
  Eigen::Vector3d block_;
  std::array<int, 3> counts_;
  std::map<std::array<int, 3>, int> number_;
};

/// Shape functions of the 8-node face at reference coordinates, in the order of `corner` below.
constexpr int corner[8][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}};
double faceShape(int n, double x, double y) {
  const double a = corner[n][0], b = corner[n][1];
  if (n < 4) return (1 + a * x) * (1 + b * y) * (a * x + b * y - 1) / 4;
  return a == 0 ? (1 - x * x) * (1 + b * y) / 2 : (1 - y * y) * (1 + a * x) / 2;
}

/// Nodal shares of a uniform traction on a rectangle: 3 x 3 Gauss points on each face's part of it.
std::map<int, double> shares(const BrickGrid& grid, const Rectangle& area) {
  constexpr double point[3] = {-0.7745966692414834, 0, 0.7745966692414834}, weight[3] = {5. / 9, 8. / 9, 5. / 9};
  std::map<int, double> shares;
  const double whole = (area.high_mm - area.low_mm).prod();
  for (int j = 0; j < grid.counts()[1]; ++j)
    for (int i = 0; i < grid.counts()[0]; ++i) {
      const Eigen::Vector2d low(grid.at(0, 2 * i), grid.at(1, 2 * j)),
          high(grid.at(0, 2 * i + 2), grid.at(1, 2 * j + 2));
      const Eigen::Vector2d from = low.cwiseMax(area.low_mm), to = high.cwiseMin(area.high_mm);
      if ((to - from).minCoeff() <= 0) continue;
      for (int p = 0; p < 9; ++p) {
        const Eigen::Vector2d x =
            from + (to - from).cwiseProduct(Eigen::Vector2d(1 + point[p % 3], 1 + point[p / 3])) / 2;
        const Eigen::Vector2d r = 2 * (x - low).cwiseQuotient(high - low) - Eigen::Vector2d::Ones();
        const double w = weight[p % 3] * weight[p / 3] / 4 * (to - from).prod() / whole;
        for (int n = 0; n < 8; ++n)
          shares[grid.number(2 * i + 1 + corner[n][0], 2 * j + 1 + corner[n][1], grid.top())] +=
              w * faceShape(n, r.x(), r.y());
      }
    }
  return shares;
}

void writeDeck(std::ostream& deck, const SensorDesign& design, const BrickGrid& grid, const LoadCase& load) {
  deck << std::setprecision(13) << "*NODE, NSET=ALL\n";
  for (const auto& [index, number] : grid.numbers())
    deck << number << ", " << grid.at(0, index[0]) << ", " << grid.at(1, index[1]) << ", " << grid.at(2, index[2])
         << "\n";
  deck << "*ELEMENT, TYPE=C3D20R, ELSET=BLOCK\n";
  int element = 0;
  for (int k = 0; k < grid.top(); k += 2)
    for (int j = 0; j < 2 * grid.counts()[1]; j += 2)
      for (int i = 0; i < 2 * grid.counts()[0]; i += 2) {
        deck << ++element;
        int entries = 0;
        const auto put = [&](int n, int height) {
          if (++entries == 16)
            deck << ",\n" << grid.number(i + 1 + corner[n][0], j + 1 + corner[n][1], k + height);
          else
            deck << ", " << grid.number(i + 1 + corner[n][0], j + 1 + corner[n][1], k + height);
        };
        for (const int height : {0, 2})
          for (int n = 0; n < 4; ++n) put(n, height);
        for (const int height : {0, 2})
          for (int n = 4; n < 8; ++n) put(n, height);
        for (int n = 0; n < 4; ++n) put(n, 1);
        deck << "\n";
      }
  deck << "*NSET, NSET=BOTTOM\n";
  for (const auto& [index, number] : grid.numbers())
    if (index[2] == 0) deck << number << ",\n";
  const Material& m = design.material;
  const auto& law = std::get<MooneyRivlin>(m.law);
  deck << "*MATERIAL, NAME=RUBBER\n*HYPERELASTIC, MOONEY-RIVLIN\n"
       << law.c10_MPa << ", " << law.c01_MPa << ", " << 2 * m.compressibility_per_MPa()
       << "\n*SOLID SECTION, ELSET=BLOCK, MATERIAL=RUBBER\n*BOUNDARY\nBOTTOM, 1, 3\n"
          "*STEP, NLGEOM, INC=1000\n*STATIC\n1., 1.\n*CLOAD\n";
  for (const AreaLoad& area : load.areas)
    for (const auto& [node, share] : shares(grid, design.areaRectangle(area.area)))
      for (int d = 0; d < 3; ++d)
        if (area.force_N(d) != 0) deck << node << ", " << d + 1 << ", " << share * area.force_N(d) << "\n";
  deck << "*NODE PRINT, NSET=ALL\nU\n*END STEP\n";
}

/// Displacement at a point on a vertical edge of the bricks.
Eigen::Vector3d at(const BrickGrid& grid, const std::map<int, Eigen::Vector3d>& u, const Eigen::Vector3d& p,
                   const Eigen::Vector3d& block) {
  const auto& counts = grid.counts();
  const int i = static_cast<int>(std::lround(p.x() / block.x() * counts[0])) * 2;
  const int j = static_cast<int>(std::lround(p.y() / block.y() * counts[1])) * 2;
  const int k = std::min(counts[2] - 1, static_cast<int>(p.z() / block.z() * counts[2])) * 2;
  const double s = 2 * (p.z() - grid.at(2, k)) / (grid.at(2, k + 2) - grid.at(2, k)) - 1;
  return s * (s - 1) / 2 * u.at(grid.number(i, j, k)) + (1 - s * s) * u.at(grid.number(i, j, k + 1)) +
         s * (s + 1) / 2 * u.at(grid.number(i, j, k + 2));
}

} // namespace

CalculixAnswer calculixBricks(const SensorDesign& design, const std::array<int, 3>& counts, const LoadCase& load) {
  CalculixAnswer answer;
  if (std::system("command -v ccx > /dev/null") != 0) return answer;
  const auto folder = std::filesystem::temp_directory_path() / "palp-benchmark";
  std::filesystem::create_directories(folder);
  const BrickGrid grid(design.block_mm, counts);
  {
    std::ofstream deck(folder / "deck.inp");
    writeDeck(deck, design, grid, load);
  }
  const auto start = std::chrono::steady_clock::now();
  const std::string command = "cd '" + folder.string() + "' && OMP_NUM_THREADS=2 ccx deck > ccx.log 2>&1";
  const bool done = std::system(command.c_str()) == 0;
  answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::map<int, Eigen::Vector3d> u;
  std::ifstream results(folder / "deck.dat");
  for (std::string line; std::getline(results, line);) {
    std::istringstream numbers(line);
    int node = 0;
    Eigen::Vector3d value;
    if (numbers >> node >> value.x() >> value.y() >> value.z()) u[node] = value; // the last increment's stands
  }
  answer.ran = done && u.size() == grid.numbers().size();
  if (answer.ran) {
    const Eigen::Matrix3Xd electrodes = design.upperElectrodes_mm();
    answer.upper_mm.resize(3, electrodes.cols());
    for (Eigen::Index e = 0; e < electrodes.cols(); ++e)
      answer.upper_mm.col(e) = at(grid, u, electrodes.col(e), design.block_mm);
  }
  std::filesystem::remove_all(folder);
  return answer;
}

} // namespace palp::bench
