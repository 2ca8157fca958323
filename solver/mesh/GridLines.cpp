#include "solver/mesh/GridLines.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr int samples = 512;              // of the size along one interval
constexpr double roundingTolerance = 0.2; // of a cell: an interval of 2.2 cells gets 2

} // namespace

double SizeAlong::operator()(double x_mm) const {
  double h = largest_mm;
  for (const FinePlace& p : places)
    h = std::min(h, p.size_mm + growth * std::max(0., std::abs(x_mm - p.at_mm) - p.half_mm));
  return h;
}

std::vector<double> gridLines(const std::vector<double>& stops, const SizeAlong& size) {
  std::vector<double> lines{stops.front()};
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    const double step = (stops[i + 1] - stops[i]) / samples;
    std::vector<double> cells(samples + 1); // cells up to each sample
    for (int k = 0; k < samples; ++k) cells[k + 1] = cells[k] + step / size(stops[i] + (k + 0.5) * step);
    const int count = std::max(1, static_cast<int>(std::ceil(cells.back() - roundingTolerance)));
    for (int c = 1, k = 0; c < count; ++c) {
      const double wanted = cells.back() * c / count;
      while (cells[k + 1] < wanted) ++k;
      lines.push_back(stops[i] + step * (k + (wanted - cells[k]) / (cells[k + 1] - cells[k])));
    }
    lines.push_back(stops[i + 1]);
  }
  return lines;
}

void meetParities(const std::vector<double>& borders, bool oddBetween, const SizeAlong& size,
                  std::vector<double>& lines) {
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    const auto first = std::find(lines.begin(), lines.end(), borders[i]);
    const auto last = std::find(first, lines.end(), borders[i + 1]);
    const bool odd = oddBetween && i + 2 < borders.size();
    if (((last - lines.begin()) % 2 == 1) == odd) continue;
    const auto relativeWidth = [&](auto line) { return (*(line + 1) - *line) / size((*line + *(line + 1)) / 2); };
    auto widest = first;
    for (auto line = first; line != last; ++line)
      if (relativeWidth(line) > relativeWidth(widest)) widest = line;
    lines.insert(widest + 1, (*widest + *(widest + 1)) / 2);
  }
}

} // namespace palp
