#include "model/SampleSet.h"

#include "model/Text.h"

namespace palp {

std::string difference(const SampleOrigin& a, const SampleOrigin& b) {
  const auto differs = [](const char* what, const std::string& left, const std::string& right) {
    return std::string(what) + " differs: " + left + " and " + right;
  };
  if (a.designFingerprint != b.designFingerprint) return differs("design", a.designFingerprint, b.designFingerprint);
  if (a.seed != b.seed) return differs("seed", std::to_string(a.seed), std::to_string(b.seed));
  if (a.areas != b.areas) return differs("areas", a.areas, b.areas);
  if (a.perArea != b.perArea) return differs("per_area", std::to_string(a.perArea), std::to_string(b.perArea));
  if (a.mesh != b.mesh) return differs("mesh", a.mesh, b.mesh);
  if (a.solverTolerance != b.solverTolerance)
    return differs("solver tolerance", text(a.solverTolerance), text(b.solverTolerance));
  if (a.surrogate != b.surrogate)
    return differs("kind", a.surrogate ? "surrogate" : "full solves", b.surrogate ? "surrogate" : "full solves");
  return {};
}

} // namespace palp
