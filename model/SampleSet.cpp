#include "model/SampleSet.h"

#include "model/base/Text.h"

#include <vector>

namespace palp {

std::string difference(const SampleOrigin& a, const SampleOrigin& b) {
  const auto differs = [](const char* what, const std::string& left, const std::string& right) {
    return std::string(what) + " differs: " + left + " and " + right;
  };
  if (a.designFingerprint != b.designFingerprint) return differs("design", a.designFingerprint, b.designFingerprint);
  if (a.seed != b.seed) return differs("seed", std::to_string(a.seed), std::to_string(b.seed));
  if (a.areas != b.areas) return differs("areas", a.areas, b.areas);
  if (a.touches != b.touches) return differs("touches", a.touches, b.touches);
  if (a.perArea != b.perArea) return differs("per_area", std::to_string(a.perArea), std::to_string(b.perArea));
  if (a.mesh != b.mesh) return differs("mesh", a.mesh, b.mesh);
  if (a.solverTolerance != b.solverTolerance)
    return differs("solver tolerance", text(a.solverTolerance), text(b.solverTolerance));
  if (a.surrogate != b.surrogate)
    return differs("kind", a.surrogate ? "surrogate" : "full solves", b.surrogate ? "surrogate" : "full solves");
  return {};
}

SampleSet areaPart(const SampleSet& set, int area) {
  std::vector<Eigen::Index> chosen;
  for (Eigen::Index i = 0; i < set.size(); ++i)
    if (set.area(i) == area) chosen.push_back(i);
  SampleSet part = set;
  part.area = set.area(chosen);
  if (set.hasTouches()) part.touches = set.touches(Eigen::all, chosen);
  part.forces_N = set.forces_N(Eigen::all, chosen);
  part.displacements_mm = set.displacements_mm(Eigen::all, chosen);
  part.resistances_ohm = set.resistances_ohm(Eigen::all, chosen);
  return part;
}

void append(SampleSet& set, const SampleSet& block) {
  if (set.size() == 0) {
    set = block;
    return;
  }
  const Eigen::Index before = set.size();
  const Eigen::Index added = block.size();
  set.area.conservativeResize(before + added);
  set.area.tail(added) = block.area;
  const auto addColumns = [&](Eigen::MatrixXd& to, const Eigen::MatrixXd& from) {
    to.conservativeResize(Eigen::NoChange, before + added);
    to.rightCols(added) = from;
  };
  if (set.hasTouches()) addColumns(set.touches, block.touches);
  addColumns(set.forces_N, block.forces_N);
  addColumns(set.displacements_mm, block.displacements_mm);
  addColumns(set.resistances_ohm, block.resistances_ohm);
}

} // namespace palp
