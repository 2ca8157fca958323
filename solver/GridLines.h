#pragma once

#include <vector>

namespace palp {

/// A place where the mesh is to be fine along one direction.
struct FinePlace {
  double at_mm = 0;
  double size_mm = 0;
};

/// Wanted size along one direction: h(x) = min(largest, size_i + growth |x - x_i|).
struct SizeAlong {
  double largest_mm = 1;
  double growth = 0.4;
  std::vector<FinePlace> places;
  [[nodiscard]] double operator()(double x_mm) const;
};

/// Coordinates of grid lines through all `stops` (ascending), each interval cut into cells of the wanted sizes.
std::vector<double> gridLines(const std::vector<double>& stops, const SizeAlong& size);

/// Brings lines to the wanted coordinates: moves the nearest line that is neither a stop nor moved before, where it
/// lies within half a cell, else adds one.
void bringLinesTo(const std::vector<double>& wanted, const std::vector<double>& stops, std::vector<double>& lines);

/// Splits the widest cell, measured by the wanted size, of each interval between stops that has an odd number of cells:
/// the pattern of elements, which alternates from cell to cell, then meets every stop alike.
void makeEven(const std::vector<double>& stops, const SizeAlong& size, std::vector<double>& lines);

} // namespace palp
