#include "solver/StretchMap.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr int intervals = 4096;

double interpolate(const std::vector<double>& from, const std::vector<double>& to, double value) {
  const auto above = std::upper_bound(from.begin() + 1, from.end() - 1, value);
  const std::size_t i = above - from.begin();
  return to[i - 1] + (value - from[i - 1]) * (to[i] - to[i - 1]) / (from[i] - from[i - 1]);
}

} // namespace

StretchMap::StretchMap(double length_mm, double largest_mm, double growth, const std::vector<FinePlace>& places) {
  const auto size = [&](double x) {
    double h = largest_mm;
    for (const FinePlace& p : places) h = std::min(h, p.size_mm + growth * std::abs(x - p.at_mm));
    return h;
  };
  x_.resize(intervals + 1);
  t_.resize(intervals + 1);
  for (int i = 1; i <= intervals; ++i) {
    x_[i] = length_mm * i / intervals;
    t_[i] = t_[i - 1] + (x_[i] - x_[i - 1]) / size((x_[i] + x_[i - 1]) / 2);
  }
}

double StretchMap::stretched(double x_mm) const {
  return interpolate(x_, t_, x_mm);
}
double StretchMap::unstretched(double t) const {
  return interpolate(t_, x_, t);
}

} // namespace palp
