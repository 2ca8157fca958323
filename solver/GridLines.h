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

/// A line whose index, counted from 0, is to be odd or even.
struct ParityPlace {
  double at_mm = 0;
  bool odd = false;
};

/// Splits the widest cell, measured by the wanted size, between two of the places (lines, ascending, the first at index
/// 0) wherever the second one's index has the other parity.
void meetParities(const std::vector<ParityPlace>& places, const SizeAlong& size, std::vector<double>& lines);

} // namespace palp
