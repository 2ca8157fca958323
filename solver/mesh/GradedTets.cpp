#include "solver/mesh/GradedTets.h"

#include "model/DesignError.h"
#include "model/base/Text.h"
#include "solver/mesh/DelaunayTets.h"
#include "solver/mesh/GridLines.h"
#include "solver/mesh/QuadraticTets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace palp {

namespace {

/// Bends the lifted grid so that TetGen's weighted Delaunay tetrahedra are the path simplices of the cells, mirrored
/// from cell to cell: the weight grows with the square of the number of odd indices of a point (a function convex in
/// the set of odd directions, whose extension is linear on the path simplices: Lovasz 1983).
constexpr double weightOfOddIndices = 0.05;
constexpr double furthestMove = 0.35; // of a cell, from a grid point to the electrode it is moved to
constexpr double mostElements = 1e6;

/// Lines along x, y, z; points are numbered along x, then y, then z.
struct Grid {
  std::array<std::vector<double>, 3> stops, lines;
  std::array<SizeAlong, 3> sizes;

  [[nodiscard]] int count(int d) const { return static_cast<int>(lines[d].size()); }
  [[nodiscard]] int point(const Eigen::Vector3i& i) const { return (i(2) * count(1) + i(1)) * count(0) + i(0); }
  [[nodiscard]] double cells() const { return double(count(0) - 1) * (count(1) - 1) * (count(2) - 1); }
  [[nodiscard]] Eigen::Matrix3Xd indices() const {
    Eigen::Matrix3Xd all(3, Eigen::Index(count(0)) * count(1) * count(2));
    for (int k = 0; k < count(2); ++k)
      for (int j = 0; j < count(1); ++j)
        for (int i = 0; i < count(0); ++i) all.col(point({i, j, k})) << i, j, k;
    return all;
  }
};

void setHorizontal(Grid& grid, int d, double length, int parts, const Grading& grading) {
  SizeAlong& size = grid.sizes[d];
  size = {grading.bulk_mm, grading.growth, {}};
  for (int i = 0; i <= parts; ++i) {
    grid.stops[d].push_back(length * i / parts);
    size.places.push_back({grid.stops[d].back(), i == 0 || i == parts ? grading.edge_mm : grading.border_mm});
  }
}

/// Makes the electrodes' coordinates stops, where they are few enough; others are met by moving grid points.
void addStops(std::vector<double>& stops, const Eigen::RowVectorXd& electrodes) {
  constexpr std::size_t mostLinesForElectrodes = 40;
  std::vector<double> wanted(electrodes.begin(), electrodes.end());
  std::sort(wanted.begin(), wanted.end());
  const double same = 1e-9 * stops.back();
  wanted.erase(std::unique(wanted.begin(), wanted.end(), [=](double a, double b) { return b - a < same; }),
               wanted.end());
  if (wanted.size() > mostLinesForElectrodes) return;
  for (const double x : wanted) {
    const auto above = std::lower_bound(stops.begin() + 1, stops.end() - 1, x);
    if (x - *(above - 1) >= same && *above - x >= same) stops.insert(above, x);
  }
}

/// Size across a disc's rim: the areas' borders', less for a small disc.
double rimSize(const Grading& grading, const FineDisc& disc) {
  return grading.border_mm * std::min(1., disc.radius_mm / grading.bulk_mm);
}

Grid gradedGrid(const SensorDesign& design, const Grading& grading, const std::vector<FineDisc>& discs,
                const Eigen::Matrix3Xd& electrodes) {
  const Eigen::Vector3d& block = design.block_mm;
  Grid grid;
  setHorizontal(grid, 0, block.x(), design.areas.columns, grading);
  setHorizontal(grid, 1, block.y(), design.areas.rows, grading);
  for (const FineDisc& disc : discs)
    for (const double side : {-1., 1.}) {
      grid.sizes[0].places.push_back({disc.x_mm + side * disc.radius_mm, rimSize(grading, disc)});
      grid.sizes[1].places.push_back({disc.y_mm + side * disc.radius_mm, rimSize(grading, disc)});
    }
  grid.stops[2] = {0, block.z()};
  grid.sizes[2] = {grading.vertical_mm, grading.growth, {{0, grading.bottom_mm}, {block.z(), grading.top_mm}}};
  // Face diagonals join the grid points whose indices are both even to those where both are odd. An edge where stresses
  // are singular is resolved better where diagonals run into it: its two indices are to be both even or both odd. So
  // the rims of the clamped face get even indices, and the borders of the load areas the parity of the top face.
  for (const int d : {2, 0, 1}) {
    const std::vector<double> borders = grid.stops[d];
    addStops(grid.stops[d], electrodes.row(d));
    grid.lines[d] = gridLines(grid.stops[d], grid.sizes[d]);
    if (d < 2) meetParities(borders, (grid.count(2) - 1) % 2 == 1, grid.sizes[d], grid.lines[d]);
  }
  return grid;
}

/// The grid point nearest to an electrode and how far it would move, in cells.
struct Nearest {
  Eigen::Vector3i index;
  Eigen::Vector3d move;
};
Nearest nearest(const Grid& grid, const Eigen::Vector3d& p) {
  Nearest result;
  for (int d = 0; d < 3; ++d) {
    const std::vector<double>& lines = grid.lines[d];
    const auto above = std::lower_bound(lines.begin() + 1, lines.end() - 1, p(d));
    const double cell = *above - *(above - 1), part = (p(d) - *(above - 1)) / cell;
    result.index(d) = static_cast<int>(above - lines.begin()) - (part < 0.5 ? 1 : 0);
    result.move(d) = std::min(part, 1 - part);
    const bool stop =
        std::find(grid.stops[d].begin(), grid.stops[d].end(), lines[result.index(d)]) != grid.stops[d].end();
    if (stop && result.move(d) > 1e-9) result.move(d) = 1; // it must stay on its plane
  }
  return result;
}

/// Grid point of each electrode; where one is too far from all, a line is brought to it, which may need another round.
std::vector<int> electrodePoints(Grid& grid, const Eigen::Matrix3Xd& electrodes) {
  for (;;) {
    std::vector<int> points;
    std::vector<char> taken(grid.indices().cols());
    bool complete = true;
    for (Eigen::Index e = 0; e < electrodes.cols() && complete; ++e) {
      const Nearest place = nearest(grid, electrodes.col(e));
      Eigen::Index furthest = 0;
      const bool near = place.move.maxCoeff(&furthest) <= furthestMove;
      const int point = grid.point(place.index);
      complete = near && !taken[point];
      if (!complete) {
        std::vector<double>& lines = grid.lines[furthest];
        lines.insert(std::lower_bound(lines.begin(), lines.end(), electrodes(furthest, e)), electrodes(furthest, e));
        break;
      }
      taken[point] = 1;
      points.push_back(point);
    }
    if (complete) return points;
  }
}

/// Load area of each top face, by its centre.
Eigen::VectorXi areasOfFaces(const SensorDesign& design, const Mesh& mesh) {
  Eigen::VectorXi areas(mesh.topFaces.cols());
  const auto part = [](double x, double length, int parts) {
    return std::min(parts - 1, static_cast<int>(x / length * parts));
  };
  for (Eigen::Index f = 0; f < areas.size(); ++f) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (int n = 0; n < 3; ++n) centre += mesh.nodes_mm.col(mesh.topFaces(n, f)) / 3;
    areas(f) = part(centre.y(), design.block_mm.y(), design.areas.rows) * design.areas.columns +
               part(centre.x(), design.block_mm.x(), design.areas.columns);
  }
  return areas;
}

void requireElements(const Grid& grid) {
  if (6 * grid.cells() > mostElements)
    throw DesignError("mesh: " + text(6 * grid.cells()) + " elements; allowed are 1e6: choose a larger mesh size");
}

} // namespace

Grading defaultGrading(const SensorDesign& design, double size_mm) {
  const Rectangle area = design.areaRectangle(0);
  const double side = (area.high_mm - area.low_mm).minCoeff(), height = design.block_mm.z();
  // Stresses at the surface die out over the block's height or half an area, whichever is less.
  const double reach = std::min(height, side / 2);
  const double factor = size_mm / standardSize(design);
  Grading g;
  g.bulk_mm = factor * 0.4 * side;
  g.border_mm = factor * 0.15 * reach;
  g.edge_mm = factor * 0.25 * reach;
  g.top_mm = factor * 0.1 * reach;
  g.bottom_mm = factor * 0.15 * reach;
  g.vertical_mm = factor * 0.4 * std::min(height, 2 * reach + height / 10);
  return g;
}

double standardSize(const SensorDesign& design) {
  const Rectangle area = design.areaRectangle(0);
  return 0.4 * (area.high_mm - area.low_mm).minCoeff();
}

Mesh gradedTets(const SensorDesign& design, const Grading& grading, const std::vector<FineDisc>& discs,
                bool electrodesAsNodes) {
  const Eigen::Matrix3Xd electrodes = electrodesAsNodes ? design.upperElectrodes_mm() : Eigen::Matrix3Xd(3, 0);
  Grid grid = gradedGrid(design, grading, discs, electrodes);
  requireElements(grid);
  const std::vector<int> electrodePoint = electrodePoints(grid, electrodes);
  requireElements(grid);
  const Eigen::Matrix3Xd indices = grid.indices();
  Eigen::VectorXd weights(indices.cols());
  Eigen::Matrix3Xd points(3, indices.cols());
  for (Eigen::Index i = 0; i < indices.cols(); ++i) {
    double odd = 0;
    for (int d = 0; d < 3; ++d) {
      const auto index = static_cast<std::size_t>(indices(d, i));
      odd += double(index % 2);
      points(d, i) = grid.lines[d][index];
    }
    weights(i) = weightOfOddIndices * odd * odd;
  }
  for (Eigen::Index e = 0; e < electrodes.cols(); ++e) points.col(electrodePoint[e]) = electrodes.col(e);
  Mesh mesh = quadraticTets(points, weightedDelaunay(indices, weights));
  mesh.topFaceAreas = areasOfFaces(design, mesh);
  mesh.upperElectrodeNodes = electrodePoint;
  return mesh;
}

} // namespace palp
