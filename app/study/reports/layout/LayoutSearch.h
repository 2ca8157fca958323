#pragma once

#include "app/study/reports/layout/LayoutBound.h"
#include "solver/TouchFields.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>

namespace palp {

/// What a maker can keep. Wires stay straight and where they are along the block; electrodes slide on their wires and
/// layers change their depth.
struct MakerLimits {
  double grid_mm = 0.05;     ///< places are multiples of this; goes into 1 mm
  double pitch_mm = 1;       ///< smallest distance between electrodes of a wire
  double clearance_mm = 0.5; ///< smallest height of the upper layer over the lower one
  double cover_mm = 0.5; ///< thinnest rubber over the upper layer, under the lower one and next to the last electrodes
};

/// How freely electrodes move.
enum class LayoutFreedom {
  SameOnEveryWire, ///< both depths, and the places on the column-wires, the same on all of them
  WireByWire,      ///< besides, each column-wire has its own depth and places
};

/// What a search lowers: a number above 0 of a layout that can be made, infinite where it resolves nothing. `fineness`
/// is that of the field's quadrature, as FieldSensitivity's. Throws Cancelled.
using LayoutGoal = std::function<double(const SensorDesign& layout, double fineness, const std::stop_token& stop)>;

/// LayoutBound::mean() of a row-wire, or of all with row-wire -1. The response must outlive it.
LayoutGoal areaGoal(const AreaResponse& response, int rowWire, double relativeNoise, int threads);

/// The map's worst place: the largest deviation of the place [mm] of such touches that friction holds, all row-wires
/// read. The fields must outlive it.
LayoutGoal touchGoal(const TouchFields& touches, const Indenter& touch, double relativeNoise, int threads);

struct LayoutSearchResult {
  SensorDesign layout;
  double before = 0; ///< of the goal
  double after = 0;
  int evaluations = 0;
};

/// Lowers the goal by pattern search (Hooke and Jeeves, 1961) from the design and from random places; equal seeds give
/// equal layouts. Under the field layouts are judged on a
/// coarse quadrature, fewer of them, and electrodes keep as far apart as small spheres need. `progress` gets,
/// roughly, the share of the search that is done. Returns nullopt if cancelled.
std::optional<LayoutSearchResult> betterLayout(const SensorDesign& design, const LayoutGoal& goal,
                                               LayoutFreedom freedom, const MakerLimits& limits, std::uint64_t seed,
                                               const std::stop_token& stop, const ReportProgress& progress = {});

/// Why a maker could not keep the layout; empty where he can.
std::optional<std::string> makerProblem(const SensorDesign& layout, const MakerLimits& limits);

} // namespace palp
