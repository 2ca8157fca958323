#include "app/study/reports/layout/LayoutSearch.h"

#include "app/study/reports/map/TouchMap.h"
#include "model/base/Cancelled.h"
#include "model/base/Text.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace palp {

namespace {

constexpr int kRandomStarts = 4;
constexpr int kRandomStartsUnderField = 2;
constexpr int kMostUnderField = 400;    // layouts a start; a layout by Eq. (1) costs a thousandth
constexpr double kSearchFineness = 0.5; // of the field's quadrature: a percent of the bound is enough to choose by
constexpr double kFirstStep_mm = 1.6;   // on the paper's block of 30 mm; halved down to the grid
constexpr double kSlack_mm = 1e-9;      // limits are met by rounded numbers

using Places = std::vector<double>;

/// The upper depth, and for each free column-wire its depth and the places of its electrodes.
class Parameters {
public:
  Parameters(SensorDesign design, LayoutFreedom freedom)
      : design_(std::move(design)), wires_(freedom == LayoutFreedom::WireByWire ? design_.columnWires() : 1) {}

  [[nodiscard]] Places places() const {
    Places result{design_.upper.z(0, 0)};
    for (int wire = 0; wire < wires_; ++wire) {
      result.push_back(design_.lower.z(wire, 0));
      for (int e = 0; e < design_.electrodesPerColumnWire(); ++e) result.push_back(design_.lower.along(wire, e));
    }
    return result;
  }

  [[nodiscard]] SensorDesign layout(const Places& places) const {
    SensorDesign result = design_;
    const auto perWire = static_cast<std::size_t>(design_.electrodesPerColumnWire());
    result.upper.z_mm = {{places[0]}};
    result.lower.z_mm.clear();
    result.lower.along_mm.clear();
    for (std::size_t wire = 0; wire < static_cast<std::size_t>(wires_); ++wire) {
      const auto first = places.begin() + static_cast<std::ptrdiff_t>(1 + wire * (1 + perWire));
      result.lower.z_mm.emplace_back(wires_ == 1 ? 1 : perWire, *first);
      result.lower.along_mm.emplace_back(first + 1, first + 1 + static_cast<std::ptrdiff_t>(perWire));
    }
    return result;
  }

private:
  SensorDesign design_;
  int wires_;
};

/// The nearest multiple of the grid, as the decimal number that it is (3.55 and not 3.5500000000000003).
double onGrid(double value, double grid_mm) {
  return std::round(value / grid_mm) / std::round(1 / grid_mm);
}

/// Objective over places with what cannot be made at infinity.
class Search {
public:
  Search(const Parameters& parameters, const LayoutGoal& goal, const MakerLimits& limits, std::stop_token stop,
         std::function<void(int)> judged)
      : parameters_(parameters), goal_(goal), limits_(limits), stop_(std::move(stop)), judged_(std::move(judged)) {}

  double value(const Places& places) {
    const SensorDesign layout = parameters_.layout(places);
    if (makerProblem(layout, limits_) || !spheresFit(layout)) return std::numeric_limits<double>::infinity();
    if (layout.field() && left_-- <= 0) return std::numeric_limits<double>::infinity();
    judged_(++evaluations_);
    return goal_(layout, kSearchFineness, stop_);
  }

  /// Moves one place after the other while that helps, then halves the step.
  double descend(Places& places, const std::function<void(double)>& progress) {
    left_ = kMostUnderField;
    for (double& place : places) place = onGrid(place, limits_.grid_mm);
    double best = value(places);
    const double first = kFirstStep_mm * (parameters_.layout(places).block_mm.y() / paperDesign().block_mm.y());
    double step = first;
    const double halvings = std::log2(first / limits_.grid_mm) + 1;
    while (step > limits_.grid_mm * 0.99 && !stop_.stop_requested()) {
      progress(std::log2(first / step) / halvings);
      const double before = best;
      best = sweep(places, best, step);
      if (!(best < before * (1 - 1e-3))) step /= 2;
    }
    return best;
  }

  [[nodiscard]] int evaluations() const { return evaluations_; }

private:
  /// Whether small spheres with dipoles are a good model of the electrodes.
  static bool spheresFit(const SensorDesign& layout) {
    return !layout.field() || (check(layout).empty() && designWarnings(layout).empty());
  }

  double sweep(Places& places, double best, double step) {
    for (double& place : places)
      for (const double change : {step, -step}) {
        if (stop_.stop_requested()) return best;
        const double old = place;
        place = onGrid(old + change, limits_.grid_mm);
        const double now = value(places);
        if (now < best) {
          best = now;
          break;
        }
        place = old;
      }
    return best;
  }

  const Parameters& parameters_;
  const LayoutGoal& goal_;
  const MakerLimits& limits_;
  std::stop_token stop_;
  std::function<void(int)> judged_; ///< called with the number so far
  int evaluations_ = 0;
  int left_ = kMostUnderField; ///< of this start
};

/// Places anywhere in the block that can be made.
Places randomPlaces(const Parameters& parameters, const SensorDesign& design, const MakerLimits& limits,
                    std::mt19937_64& random) {
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11U) * 0x1p-53;
  };
  const auto perWire = static_cast<std::size_t>(design.electrodesPerColumnWire());
  constexpr int kTries = 10000;
  for (int attempt = 0; attempt < kTries; ++attempt) {
    Places places = parameters.places();
    places[0] = uniform(limits.cover_mm + limits.clearance_mm, design.block_mm.z() - limits.cover_mm);
    for (std::size_t p = 1; p < places.size(); p += 1 + perWire) {
      places[p] = uniform(limits.cover_mm, places[0] - limits.clearance_mm);
      for (std::size_t e = 1; e <= perWire; ++e)
        places[p + e] = uniform(limits.cover_mm, design.block_mm.y() - limits.cover_mm);
      std::sort(places.begin() + static_cast<std::ptrdiff_t>(p + 1),
                places.begin() + static_cast<std::ptrdiff_t>(p + 1 + perWire));
    }
    for (double& place : places) place = onGrid(place, limits.grid_mm);
    if (!makerProblem(parameters.layout(places), limits)) return places;
  }
  return parameters.places();
}

std::optional<std::string> wireProblem(const ElectrodeLayer& layer, int wire, double length_mm,
                                       const MakerLimits& limits) {
  std::vector<double> along;
  for (int e = 0; e < layer.electrodesPerWire(); ++e) {
    along.push_back(layer.along(wire, e));
    if (layer.z(wire, e) != layer.z(wire, 0)) return "is not straight";
  }
  std::sort(along.begin(), along.end());
  if (along.front() < limits.cover_mm - kSlack_mm || along.back() > length_mm - limits.cover_mm + kSlack_mm)
    return "has an electrode nearer than " + text(limits.cover_mm) + " mm to the block's side";
  for (std::size_t e = 1; e < along.size(); ++e)
    if (along[e] - along[e - 1] < limits.pitch_mm - kSlack_mm)
      return "has electrodes nearer to each other than " + text(limits.pitch_mm) + " mm";
  return {};
}

} // namespace

std::optional<std::string> makerProblem(const SensorDesign& layout, const MakerLimits& limits) {
  for (int wire = 0; wire < layout.columnWires(); ++wire)
    if (auto why = wireProblem(layout.lower, wire, layout.block_mm.y(), limits))
      return "column-wire " + std::to_string(wire) + " " + *why;
  for (int wire = 0; wire < layout.rowWires(); ++wire)
    if (auto why = wireProblem(layout.upper, wire, layout.block_mm.x(), limits))
      return "row-wire " + std::to_string(wire) + " " + *why;
  double lowest = layout.block_mm.z(), highest = 0, floor = layout.block_mm.z(), top = 0;
  for (int wire = 0; wire < layout.rowWires(); ++wire) {
    lowest = std::min(lowest, layout.upper.z(wire, 0));
    top = std::max(top, layout.upper.z(wire, 0));
  }
  for (int wire = 0; wire < layout.columnWires(); ++wire) {
    highest = std::max(highest, layout.lower.z(wire, 0));
    floor = std::min(floor, layout.lower.z(wire, 0));
  }
  if (lowest - highest < limits.clearance_mm - kSlack_mm)
    return "the layers are nearer than " + text(limits.clearance_mm) + " mm";
  if (floor < limits.cover_mm - kSlack_mm || top > layout.block_mm.z() - limits.cover_mm + kSlack_mm)
    return "a layer is covered by less than " + text(limits.cover_mm) + " mm of rubber";
  return {};
}

LayoutGoal areaGoal(const AreaResponse& response, int rowWire, double relativeNoise, int threads) {
  return [&response, rowWire, relativeNoise, threads](const SensorDesign& layout, double fineness,
                                                      const std::stop_token& stop) {
    return layoutBound(layout, response, rowWire, relativeNoise, threads, fineness, stop).mean();
  };
}

LayoutGoal touchGoal(const TouchFields& touches, const Indenter& touch, double relativeNoise, int threads) {
  const double Fz_N = touch.press()->force_N.z();
  return [&touches, Fz_N, relativeNoise, threads](const SensorDesign& layout, double fineness,
                                                  const std::stop_token& stop) {
    double worst_mm = 0;
    for (const TouchInfluence& of : touches.of(readingsAtRest(layout, threads, stop, fineness), threads, stop))
      worst_mm = std::max(worst_mm, touchDeviations(of, Fz_N, true, relativeNoise).place_mm.norm());
    return worst_mm;
  };
}

std::optional<LayoutSearchResult> betterLayout(const SensorDesign& design, const LayoutGoal& goal,
                                               LayoutFreedom freedom, const MakerLimits& limits, std::uint64_t seed,
                                               const std::stop_token& stop, const ReportProgress& progress) {
  const Parameters parameters(design, freedom);
  // For many positions together one start is enough and random ones are poor; few positions deserve more starts.
  const int starts = freedom == LayoutFreedom::WireByWire ? 0
                     : design.field()                     ? kRandomStartsUnderField
                                                          : kRandomStarts;
  int start = 0, before = 0; // layouts judged in earlier starts
  const auto tell = [&](double share, int tried) {
    if (progress) progress((start + share) / (starts + 1), std::to_string(tried) + " layouts tried");
  };
  // Under the field a start ends after a number of layouts; by Eq. (1) when its step is small.
  Search search(parameters, goal, limits, stop, [&](int tried) {
    if (design.field()) tell(static_cast<double>(tried - before) / kMostUnderField, tried);
  });
  const auto ofSteps = [&](double share) {
    if (!design.field()) tell(share, search.evaluations());
  };
  std::mt19937_64 random(seed);
  try {
    LayoutSearchResult result{design, goal(design, 1, stop), 0, 0};
    result.after = result.before;
    for (; start <= starts; ++start, before = search.evaluations()) {
      Places places = start == 0 ? parameters.places() : randomPlaces(parameters, design, limits, random);
      const double judged = search.descend(places, ofSteps);
      if (stop.stop_requested()) return {};
      // of a start that cannot be made, and of those that are no better by the coarse judgement
      if (!(judged < (design.field() ? 1.05 : 1) * result.after)) continue;
      const double reached = design.field() ? goal(parameters.layout(places), 1, stop) : judged;
      if (!(reached < result.after)) continue;
      result.after = reached;
      result.layout = parameters.layout(places);
    }
    result.evaluations = search.evaluations();
    return result;
  } catch (const Cancelled&) {
    return {};
  }
}

} // namespace palp
