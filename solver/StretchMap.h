#pragma once

#include <vector>

namespace palp {

/// A place where the mesh is to be fine along one direction: the size there, and how far it spreads.
struct FinePlace {
  double at_mm = 0;
  double size_mm = 0;
};

/// Stretch of one coordinate in which a mesh of size 1 has the wanted local sizes: t(x) = integral of dx / h(x),
/// h(x) = min(largest, size_i + growth |x - x_i|).
class StretchMap {
public:
  StretchMap(double length_mm, double largest_mm, double growth, const std::vector<FinePlace>& places);

  [[nodiscard]] double stretched(double x_mm) const;
  [[nodiscard]] double unstretched(double t) const;
  [[nodiscard]] double length() const { return t_.back(); } ///< in stretched coordinates: the number of cells

private:
  std::vector<double> x_, t_;
};

} // namespace palp
