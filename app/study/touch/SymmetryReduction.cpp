#include "app/study/touch/SymmetryReduction.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

namespace palp {

namespace {

/// Of a load on one area or by one indenter, whether its image is on the low side and it is not.
bool isBeyond(const LoadCase& load, const DesignMirror& mirror) {
  if (!load.indenters.empty()) return load.indenters.front().place_mm(mirror.axis) > mirror.length_mm / 2;
  return !load.areas.empty() && mirror.image(load).areas.front().area < load.areas.front().area;
}

} // namespace

SymmetryReduction::SymmetryReduction(const SensorDesign& design, const TouchRange& touches) {
  for (const int axis : {0, 1}) {
    const double middle_mm = design.block_mm(axis) / 2;
    if (touches.low_mm(axis) >= middle_mm || touches.high_mm(axis) <= middle_mm) continue;
    if (auto mirror = mirrorOf(design, axis)) mirrors_.push_back(std::move(*mirror));
  }
}

SymmetryReduction::SymmetryReduction(const SensorDesign& design) {
  for (const int axis : {0, 1}) {
    if (design.forceRange.low_N(axis) != -design.forceRange.high_N(axis)) continue;
    if (auto mirror = mirrorOf(design, axis)) mirrors_.push_back(std::move(*mirror));
  }
}

TouchRange SymmetryReduction::of(TouchRange touches) const {
  for (const DesignMirror& mirror : mirrors_) {
    double& low_mm = touches.low_mm(mirror.axis);
    low_mm = std::min(low_mm, mirror.length_mm - touches.high_mm(mirror.axis));
    touches.high_mm(mirror.axis) = mirror.length_mm / 2;
  }
  return touches;
}

std::vector<int> SymmetryReduction::of(std::span<const int> areas) const {
  std::vector<LoadCase> loads;
  for (const int area : areas) loads.push_back({.areas = {{area}}, .patches = {}});
  std::set<int> found;
  for (const LoadCase& load : of(loads)) found.insert(load.areas.front().area);
  return {found.begin(), found.end()};
}

std::vector<LoadCase> SymmetryReduction::of(std::span<const LoadCase> loads) const {
  std::vector<LoadCase> result(loads.begin(), loads.end());
  for (LoadCase& load : result)
    for (const DesignMirror& mirror : mirrors_)
      if (isBeyond(load, mirror)) load = mirror.image(std::move(load));
  return result;
}

void SymmetryReduction::mapBack(std::span<const LoadCase> loads, ConductionBatch::Answers& answers) const {
  for (std::size_t i = 0; i < answers.displacements.size(); ++i) {
    if (answers.displacements[i].upper_mm.size() == 0) continue;
    for (const DesignMirror& mirror : mirrors_) // they commute, and each leaves the other's side as it is
      if (isBeyond(loads[i], mirror)) {
        answers.displacements[i] = mirror.image(answers.displacements[i]);
        answers.resistances_ohm[i] = mirror.image(answers.resistances_ohm[i]);
      }
  }
}

} // namespace palp
