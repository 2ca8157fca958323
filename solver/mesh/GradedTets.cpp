#include "solver/mesh/GradedTets.h"

#include "model/DesignError.h"
#include "model/base/Cancelled.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"
#include "solver/mesh/DelaunayTets.h"
#include "solver/mesh/GridLines.h"
#include "solver/mesh/QuadraticTets.h"
#include "solver/mesh/TopFaces.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <unordered_map>

namespace palp {

namespace {

/// Bends the lifted grid so that TetGen's weighted Delaunay tetrahedra are the path simplices of the cells, mirrored
/// from cell to cell: the weight grows with the square of the number of odd indices of a point (a function convex in
/// the set of odd directions, whose extension is linear on the path simplices: Lovasz 1983).
constexpr double weightOfOddIndices = 0.05;
constexpr double furthestMove = 0.35;   // of a cell, from a grid point to the electrode it is moved to
constexpr double smallestVolume = 0.15; // of a moved simplex, against where it was
constexpr double thinnestCell = 0.005;  // of the wanted size
/// Of the sizes at the free edges and at the bottom, where the field depends on more of the block: 0.6 to 3.2 % of
/// error in the lower electrodes' displacements become 0.4 to 0.8 %.
constexpr double finerByFactor = 0.6;
/// Of the sizes in the bulk and, once more, at the bottom, where a pressure law depends on the pressure at electrodes
/// 3 to 6 mm from the free edges, whose clamped ends' stresses are steep there.
constexpr double bulkForPressure = 0.5, bottomForPressure = 0.75;
constexpr double leastSideInDepths = 3;
constexpr double mostCellsForNodes = 4; // times the cells before: where electrodes take more they stay inside elements

/// Lines along x, y, z; points are numbered along x, then y, then z.
struct Grid {
  std::array<std::vector<double>, 3> stops, lines;
  std::array<SizeAlong, 3> sizes;

  [[nodiscard]] int count(int d) const { return static_cast<int>(lines[d].size()); }
  [[nodiscard]] int point(const Eigen::Vector3i& i) const { return (i(2) * count(1) + i(1)) * count(0) + i(0); }
  [[nodiscard]] Eigen::Vector3d place(const Eigen::Vector3i& i) const {
    return {lines[0][i(0)], lines[1][i(1)], lines[2][i(2)]};
  }
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
  size = {grading.bulk_mm(d), grading.growth, {}};
  for (int i = 0; i <= parts; ++i) {
    grid.stops[d].push_back(length * i / parts);
    size.places.push_back({grid.stops[d].back(), i == 0 || i == parts ? grading.edge_mm(d) : grading.border_mm(d)});
  }
}

/// Makes the electrodes' coordinates stops, where they are few enough and not too near to one another; others are met
/// by moving grid points.
void addStops(std::vector<double>& stops, const SizeAlong& size, const Eigen::RowVectorXd& electrodes) {
  constexpr std::size_t mostLinesForElectrodes = 40;
  std::vector<double> wanted(electrodes.begin(), electrodes.end());
  std::sort(wanted.begin(), wanted.end());
  const double same = 1e-9 * stops.back();
  wanted.erase(std::unique(wanted.begin(), wanted.end(), [=](double a, double b) { return b - a < same; }),
               wanted.end());
  if (wanted.size() > mostLinesForElectrodes) return;
  for (const double x : wanted) {
    const auto above = std::lower_bound(stops.begin() + 1, stops.end() - 1, x);
    const double room = thinnestCell * size(x);
    if (x - *(above - 1) >= room && *above - x >= room) stops.insert(above, x);
  }
}

/// Size across a disc's rim: the areas' borders', less for a small disc.
double rimSize(const Grading& grading, int d, const FineDisc& disc) {
  return grading.border_mm(d) * std::min(1., disc.radius_mm / grading.bulk_mm(d));
}

Grid gradedGrid(const SensorDesign& design, const Grading& grading, const std::vector<FineDisc>& discs,
                const std::vector<FineZone>& zones, const Eigen::Matrix3Xd& electrodes) {
  const Eigen::Vector3d& block = design.block_mm;
  Grid grid;
  setHorizontal(grid, 0, block.x(), design.areas.columns, grading);
  setHorizontal(grid, 1, block.y(), design.areas.rows, grading);
  for (const FineDisc& disc : discs)
    for (const double side : {-1., 1.}) {
      grid.sizes[0].places.push_back({disc.x_mm + side * disc.radius_mm, rimSize(grading, 0, disc)});
      grid.sizes[1].places.push_back({disc.y_mm + side * disc.radius_mm, rimSize(grading, 1, disc)});
    }
  for (const FineZone& zone : zones)
    for (const int d : {0, 1}) grid.sizes[d].places.push_back({zone.centre_mm(d), zone.size_mm(d), zone.half_mm(d)});
  grid.stops[2] = {0, block.z()};
  grid.sizes[2] = {grading.vertical_mm, grading.growth, {{0, grading.bottom_mm}, {block.z(), grading.top_mm}}};
  for (const FineZone& zone : zones)
    grid.sizes[2].places.push_back({block.z(), zone.layer_mm > 0 ? zone.layer_mm : zone.size_mm.minCoeff()});
  // Face diagonals join the grid points whose indices are both even to those where both are odd. An edge where stresses
  // are singular is resolved better where diagonals run into it: its two indices are to be both even or both odd. So
  // the rims of the clamped face get even indices, and the borders of the load areas the parity of the top face.
  for (const int d : {2, 0, 1}) {
    const std::vector<double> borders = grid.stops[d];
    addStops(grid.stops[d], grid.sizes[d], electrodes.row(d));
    grid.lines[d] = gridLines(grid.stops[d], grid.sizes[d]);
    if (d < 2) meetParities(borders, (grid.count(2) - 1) % 2 == 1, grid.sizes[d], grid.lines[d]);
  }
  return grid;
}

/// The grid point nearest to an electrode and how far it would move, in cells. Points of the block's faces stay there.
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
    if (result.index(d) == 0 || result.index(d) + 1 == grid.count(d)) result.move(d) = 1;
  }
  return result;
}

/// Volume of the path simplices of a cell, the smallest against that of the cell's in the grid; `at` gives the place of
/// a grid point. A path goes from the corner whose indices are all even to the one where all are odd.
template <class At> double smallestRelativeVolume(const Grid& grid, const Eigen::Vector3i& cell, const At& at) {
  static constexpr std::array<std::array<int, 3>, 6> paths{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  double smallest = 1;
  for (std::size_t k = 0; k < paths.size(); ++k) {
    Eigen::Vector3i corner = cell + cell.unaryExpr([](int i) { return i % 2; });
    const Eigen::Vector3d start = at(corner);
    Eigen::Matrix3d edges;
    double volume = k < 3 ? 1 : -1; // even permutations of the axes first
    for (int step = 0; step < 3; ++step) {
      const int d = paths[k][step], sign = cell(d) % 2 == 0 ? 1 : -1;
      corner(d) += sign;
      edges.col(step) = at(corner) - start;
      volume *= sign * (grid.lines[d][cell(d) + 1] - grid.lines[d][cell(d)]);
    }
    smallest = std::min(smallest, edges.determinant() / volume);
  }
  return smallest;
}

/// Finds a grid point for each electrode; where one is too far from all, where two want the same, or where moved points
/// squeeze an element, brings lines to electrodes, in rounds. Each line ends the move of an electrode along a direction
/// for good, and lines keep their distance, so there is an end.
class ElectrodeNodes {
public:
  ElectrodeNodes(Grid& grid, const Eigen::Matrix3Xd& electrodes)
      : grid_(grid), electrodes_(electrodes), mostCells_(mostCellsForNodes * grid.cells()) {}

  /// None where that takes too many cells or too thin ones.
  std::optional<std::vector<int>> find(const std::stop_token& stop) {
    for (;;) {
      throwIfStopped(stop);
      changed_ = false;
      bringLinesToTheFar();
      if (!failed_ && !changed_) takePoints();
      if (!failed_ && !changed_) relieveTheSqueezed();
      if (failed_) return {};
      if (changed_) continue;
      std::vector<int> points;
      for (const Nearest& place : places_) points.push_back(grid_.point(place.index));
      return points;
    }
  }

private:
  /// A line through the electrode across the direction of its furthest move.
  void bringLine(Eigen::Index e, const Nearest& place) {
    Eigen::Index d = 0;
    place.move.maxCoeff(&d);
    std::vector<double>& lines = grid_.lines[d];
    const double x = electrodes_(d, e), room = thinnestCell * grid_.sizes[d](x);
    const auto above = std::lower_bound(lines.begin() + 1, lines.end() - 1, x);
    failed_ = failed_ || x - *(above - 1) < room || *above - x < room;
    if (failed_) return;
    lines.insert(above, x);
    changed_ = true;
    failed_ = grid_.cells() > mostCells_;
  }
  void bringLinesToTheFar() {
    places_.clear();
    for (Eigen::Index e = 0; e < electrodes_.cols() && !failed_; ++e) {
      places_.push_back(nearest(grid_, electrodes_.col(e)));
      if (places_.back().move.maxCoeff() > furthestMove) bringLine(e, places_.back());
    }
  }
  void takePoints() {
    owners_.clear();
    std::vector<Eigen::Index> crowded;
    for (Eigen::Index e = 0; e < electrodes_.cols(); ++e) {
      const auto [owner, first] = owners_.try_emplace(grid_.point(places_[e].index), e);
      if (!first)
        crowded.push_back(places_[e].move.maxCoeff() > places_[owner->second].move.maxCoeff() ? e : owner->second);
    }
    for (const Eigen::Index e : crowded)
      if (!failed_) bringLine(e, places_[e]);
  }
  [[nodiscard]] Eigen::Vector3d at(const Eigen::Vector3i& index) const {
    const auto owner = owners_.find(grid_.point(index));
    return owner == owners_.end() ? grid_.place(index) : Eigen::Vector3d(electrodes_.col(owner->second));
  }
  void relieveTheSqueezed() {
    for (Eigen::Index e = 0; e < electrodes_.cols() && !failed_; ++e) {
      if (places_[e].move.maxCoeff() == 0) continue;
      double smallest = 1;
      for (int k = 0; k < 8; ++k) // the cells around the point
        smallest = std::min(smallest,
                            smallestRelativeVolume(grid_, places_[e].index - Eigen::Vector3i(k % 2, k / 2 % 2, k / 4),
                                                   [&](const Eigen::Vector3i& index) { return at(index); }));
      if (smallest >= smallestVolume) continue;
      bringLine(e, places_[e]);
      return; // indices have changed
    }
  }

  Grid& grid_;
  const Eigen::Matrix3Xd& electrodes_;
  double mostCells_;
  std::vector<Nearest> places_;
  std::unordered_map<int, Eigen::Index> owners_; ///< electrode of a grid point
  bool changed_ = false, failed_ = false;
};

/// Sides of a load area, no shorter than some depths of the uppermost electrodes: finer stresses decay above them.
Eigen::Vector2d effectiveSides(const SensorDesign& design) {
  const Rectangle area = design.areaRectangle(0);
  const double depth = design.block_mm.z() - design.upperElectrodes_mm().row(2).maxCoeff();
  return (area.high_mm - area.low_mm).cwiseMax(leastSideInDepths * depth);
}

void requireElements(const Grid& grid) {
  if (6 * grid.cells() > mostElements)
    throw DesignError("mesh: " + gotExpected(6 * grid.cells(), " elements", "up to 1e6; choose a larger mesh size"));
}

} // namespace

Grading defaultGrading(const SensorDesign& design, double size_mm) {
  const Eigen::Vector2d sides = effectiveSides(design);
  const double height = design.block_mm.z(), shortest = sides.minCoeff();
  // Stresses at the surface die out over the block's height or half an area, whichever is less.
  const Eigen::Vector2d reach = (sides / 2).cwiseMin(height);
  const double least = reach.minCoeff(), factor = size_mm / standardSize(design);
  Grading g;
  // The cells need not be narrow along the long side of narrow areas.
  g.bulk_mm = factor * 0.4 * (sides / 2).cwiseMin(2 * height).cwiseMax(shortest);
  g.border_mm = factor * 0.15 * reach;
  g.edge_mm = factor * 0.25 * reach;
  g.top_mm = factor * 0.1 * least;
  g.bottom_mm = factor * 0.15 * least;
  g.vertical_mm = factor * 0.4 * std::min(height, 2 * least + height / 10);
  if (finerForField(design)) {
    g.edge_mm *= finerByFactor;
    g.bottom_mm *= finerByFactor;
  }
  if (finerForPressure(design)) {
    g.bulk_mm *= bulkForPressure;
    g.bottom_mm *= bottomForPressure;
  }
  return g;
}

double standardSize(const SensorDesign& design) {
  return 0.4 * effectiveSides(design).minCoeff();
}

Grading gradingFor(const SensorDesign& design, const MeshOptions& options, std::vector<FineZone>& zones) {
  const double size = options.meshSize_mm.value_or(standardSize(design));
  Grading grading = defaultGrading(design, size);
  if (!options.fineBorders) grading.border_mm = grading.bulk_mm;
  zones = options.zones;
  for (FineZone& zone : zones) {
    zone.size_mm *= size / standardSize(design);
    zone.layer_mm *= size / standardSize(design);
  }
  return grading;
}

double gradedElements(const SensorDesign& design, const MeshOptions& options) {
  std::vector<FineZone> zones;
  const Grading grading = gradingFor(design, options, zones);
  const Eigen::Matrix3Xd electrodes = options.electrodesAsNodes ? design.upperElectrodes_mm() : Eigen::Matrix3Xd(3, 0);
  return 6 * gradedGrid(design, grading, options.discs, zones, electrodes).cells();
}

Mesh gradedTets(const SensorDesign& design, const Grading& grading, const std::vector<FineDisc>& discs,
                const std::vector<FineZone>& zones, bool electrodesAsNodes, const std::stop_token& stop) {
  Eigen::Matrix3Xd electrodes = electrodesAsNodes ? design.upperElectrodes_mm() : Eigen::Matrix3Xd(3, 0);
  Grid grid = gradedGrid(design, grading, discs, zones, electrodes);
  requireElements(grid);
  std::optional<std::vector<int>> electrodePoint = ElectrodeNodes(grid, electrodes).find(stop);
  if (!electrodePoint) {
    electrodes.resize(3, 0);
    electrodePoint.emplace();
    grid = gradedGrid(design, grading, discs, zones, electrodes);
  }
  requireElements(grid);
  const Eigen::Matrix3Xd indices = grid.indices();
  Eigen::VectorXd weights(indices.cols());
  Eigen::Matrix3Xd points(3, indices.cols());
  for (Eigen::Index i = 0; i < indices.cols(); ++i) {
    const Eigen::Vector3i index = indices.col(i).cast<int>();
    const double odd = index.unaryExpr([](int k) { return k % 2; }).sum();
    weights(i) = weightOfOddIndices * odd * odd;
    points.col(i) = grid.place(index);
  }
  for (Eigen::Index e = 0; e < electrodes.cols(); ++e) points.col((*electrodePoint)[e]) = electrodes.col(e);
  Mesh mesh = quadraticTets(points, weightedDelaunay(indices, weights, stop), stop);
  mesh.topFaceAreas = areasOfTopFaces(design, mesh);
  mesh.upperElectrodeNodes = std::move(*electrodePoint);
  return mesh;
}

} // namespace palp
