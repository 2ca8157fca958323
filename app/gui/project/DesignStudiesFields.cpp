#include "app/gui/project/ProjectFields.h"

#include <limits>

namespace palp {

namespace {

constexpr Within kShare{0, 1}, kWires{0, 10000};
constexpr std::size_t kMapQuantities = 8;
constexpr double kUnbounded = -1; ///< in the file, for infinity, which JSON cannot represent

/// Bounds, which may be infinite.
void bound(JsonFields& fields, const std::string& key, Eigen::Vector3d& bound) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Eigen::Vector3d stored = bound.array().isFinite().select(bound, kUnbounded);
  fields.field(key, stored);
  fields.require(key, (stored.array() >= 0 || stored.array() == kUnbounded).all(),
                 "numbers from 0, or -1 for no bound");
  bound = (stored.array() == kUnbounded).select(kInfinity, stored);
}

void buildable(JsonFields& fields, const std::string& key, SensorDesign& design) {
  fields.field(key, design);
  if (!fields.reading()) return;
  const std::vector<DesignFault> faults = check(design);
  fields.require(key, faults.empty(), faults.empty() ? "" : "a design that can be built: " + faults[0].sentence);
}

} // namespace

static void describe(JsonFields& fields, BoundSummary& bounds) {
  bound(fields, "centre_with_prior_percent", bounds.centreWithPrior);
  bound(fields, "centre_without_prior_percent", bounds.centreWithoutPrior);
  bound(fields, "all_with_prior_percent", bounds.allWithPrior);
  bound(fields, "all_without_prior_percent", bounds.allWithoutPrior);
}

static void describe(JsonFields& fields, DesignSweepSettings& sweep) {
  constexpr Within kRange{0, 1e6};
  fields.field("number", sweep.number);
  fields.field("values", sweep.values, Within{2, 50});
  sweep.proposed = !fields.form("from", !sweep.proposed);
  if (sweep.proposed) return;
  fields.branch("from", sweep.from, kRange);
  fields.branch("to", sweep.to, kRange);
}

static void describe(JsonFields& fields, DesignSweepCurve::Point& point) {
  fields.field("at", point.at, Within{-1e12, 1e12});
  fields.field("bounds", point.bounds);
}

static void describe(JsonFields& fields, DesignSweepCurve& curve) {
  buildable(fields, "design", curve.design);
  fields.field("number", curve.number);
  fields.field("noise", curve.noise, kShare);
  fields.field("left", curve.left, Within{0, 1000});
  fields.field("points", curve.points);
  fields.require("points", !curve.points.empty(), "a list of at least one point");
}

static void describe(JsonFields& fields, DesignsCompared& compared) {
  buildable(fields, "earlier", compared.earlier);
  buildable(fields, "now", compared.now);
  fields.field("name", compared.name);
  fields.field("load", compared.load);
  fields.field("noise", compared.noise, kShare);
  fields.field("earlier_bounds", compared.earlierBounds);
  fields.field("now_bounds", compared.nowBounds);
  fields.field("words", compared.words);
  fields.field("rows", compared.rows, kWires);
  fields.field("columns", compared.columns, kWires);
  fields.field("difference_percent", compared.difference_percent);
  const std::size_t count = static_cast<std::size_t>(compared.rows) * static_cast<std::size_t>(compared.columns);
  fields.require("difference_percent", compared.difference_percent.size() == count,
                 "a list of " + std::to_string(count) + " numbers");
}

static void describe(JsonFields& fields, FoundLayout& found) {
  buildable(fields, "from", found.from);
  buildable(fields, "layout", found.layout);
  fields.field("before", found.before);
  fields.field("after", found.after);
  fields.field("tried", found.tried, Within{0, 1e9});
}

static void describe(JsonFields& fields, MapSettings& map) {
  fields.field("shape", map.shape, kIndenterShapes);
  fields.field("radius_mm", map.radius_mm, Within{0, 1e4});
  fields.field("force_N", map.force_N, Within{0, 1e4});
  fields.field("places", map.places, Within{2, kMostMapPlaces});
  fields.field("law", map.law);
  fields.require("law", map.law.empty() || map.law == "pairs" || kReadouts.find(map.law),
                 "empty, pairs, or " + kReadouts.allowed());
}

static void describe(JsonFields& fields, MappedResolution& mapped) {
  buildable(fields, "design", mapped.design);
  fields.field("touch", mapped.touch);
  fields.field("noise", mapped.noise, kShare);
  fields.field("low_mm", mapped.low_mm);
  fields.field("high_mm", mapped.high_mm);
  fields.require("high_mm", (mapped.high_mm.array() > mapped.low_mm.array()).all(), "a position beyond low_mm");
  fields.field("places", mapped.places, Within{2, kMostMapPlaces * 100});
  fields.field("contact_radius_mm", mapped.contactRadius_mm, Within{0, 1e6});
  fields.field("values", mapped.values);
  const std::size_t count = static_cast<std::size_t>(mapped.places[0]) * static_cast<std::size_t>(mapped.places[1]);
  const bool complete = std::ranges::all_of(mapped.values, [&](const auto& list) { return list.size() == count; });
  fields.require("values", mapped.values.size() == kMapQuantities && complete,
                 std::to_string(kMapQuantities) + " lists of " + std::to_string(count) + " numbers");
}

void describe(JsonFields& fields, DesignStudies& studies) {
  fields.sparse("scale_wires", studies.scaleWires, false);
  fields.sparse("sweep", studies.sweep, {});
  fields.sparse("found_layout", studies.found);
  fields.sparse("sweep_curve", studies.curve);
  fields.sparse("comparison", studies.compared);
  fields.sparse("map", studies.map, {});
  fields.sparse("mapped_resolution", studies.mapped);
}

} // namespace palp
