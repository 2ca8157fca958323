#pragma once

#include <vector>

namespace palp {

/// A place where the mesh is to be fine along one direction.
struct FinePlace {
  double at_mm = 0;
  double size_mm = 0;
  double half_mm = 0; ///< half of its width
};

/// Wanted size along one direction: h(x) = min(largest, size_i + growth d_i), d_i being the distance to the place.
struct SizeAlong {
  double largest_mm = 1;
  double growth = 0.4;
  std::vector<FinePlace> places;
  [[nodiscard]] double operator()(double x_mm) const;
};

/// Coordinates of grid lines through all `stops` (ascending), each interval cut into cells of the wanted sizes.
std::vector<double> gridLines(const std::vector<double>& stops, const SizeAlong& size);

/// Splits the widest cell, measured by the wanted size, between two of the borders (lines, ascending) where it takes
/// another line for the indices that are wanted, counted from 0: of the last border an even one, of those between odd
/// ones or even ones. The first is the first line.
void meetParities(const std::vector<double>& borders, bool oddBetween, const SizeAlong& size,
                  std::vector<double>& lines);

} // namespace palp
