#include "model/SampleSet.h"

#include "model/base/Error.h"
#include "model/base/Text.h"

namespace palp {

bool SampleOrigin::imported() const {
  return mesh.starts_with(kImportedFrom);
}

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

std::string joinedMakers(const std::string& a, const std::string& b) {
  constexpr std::string_view separator = "; ";
  if (a == b) return a;
  const std::string known = a.empty() ? "unknown" : a, added = b.empty() ? "unknown" : b;
  const auto listed = [&](const std::string& list) { return std::string(separator) + list + std::string(separator); };
  return listed(known).find(listed(added)) != std::string::npos ? known : known + std::string(separator) + added;
}

Eigen::Matrix2Xd SampleSet::touchedPlaces_mm() const {
  if (hasTouches()) return touches.middleRows<2>(kTouchX_mm);
  return places_mm;
}

SampleSet samplesAt(const SampleSet& set, const std::vector<Eigen::Index>& chosen) {
  SampleSet part = set;
  part.area = set.area(chosen);
  for (const auto values : kSampleParts) {
    const Eigen::MatrixXd& all = set.*values;
    if (all.rows() > 0)
      part.*values = all(Eigen::all, chosen);
    else
      (part.*values).resize(0, static_cast<Eigen::Index>(chosen.size()));
  }
  return part;
}

SampleSet areaPart(const SampleSet& set, int area) {
  std::vector<Eigen::Index> chosen;
  for (Eigen::Index i = 0; i < set.size(); ++i)
    if (set.area(i) == area) chosen.push_back(i);
  return samplesAt(set, chosen);
}

void append(SampleSet& set, const SampleSet& block) {
  if (set.size() == 0) {
    set = block;
    return;
  }
  if (&set == &block) return append(set, SampleSet(block)); // its arrays grow before they are read
  for (const auto values : kSampleParts)
    if ((set.*values).rows() != (block.*values).rows())
      throw Error("samples: sets with different columns cannot be joined");
  set.origin.madeBy = joinedMakers(set.origin.madeBy, block.origin.madeBy);
  const Eigen::Index before = set.size();
  const Eigen::Index added = block.size();
  set.area.conservativeResize(before + added);
  set.area.tail(added) = block.area;
  for (const auto values : kSampleParts) {
    Eigen::MatrixXd& all = set.*values;
    all.conservativeResize(Eigen::NoChange, before + added);
    if (all.rows() > 0) all.rightCols(added) = block.*values;
  }
}

} // namespace palp
