#include "model/LoadCase.h"

#include "model/base/GotExpected.h"
#include "model/base/Text.h"

namespace palp {

namespace {

constexpr double kLargestForce_N = 1e6;
constexpr double kSmallestRadius_mm = 0.01; // a force on a point has no finite displacement

std::optional<std::string> forceProblem(const std::string& where, const Eigen::Vector3d& force_N) {
  if (force_N.allFinite() && force_N.cwiseAbs().maxCoeff() <= kLargestForce_N) return {};
  return where + ": force: " + gotExpected(shortTexts(force_N) + " N", "a finite number up to 1e6 N in each direction");
}

std::optional<std::string> patchProblem(const PatchLoad& patch, const Eigen::Vector3d& block_mm) {
  const double r = patch.radius_mm;
  const Eigen::Vector2d& c = patch.centre_mm;
  const bool inside = r >= kSmallestRadius_mm && c.x() - r >= 0 && c.y() - r >= 0 && c.x() + r <= block_mm.x() &&
                      c.y() + r <= block_mm.y();
  if (!inside) // a NaN lands here as well
    return "patch: " + gotExpected("centre " + shortTexts(c) + " mm, radius " + shortText(r) + " mm",
                                   "a radius of " + shortText(kSmallestRadius_mm) +
                                       " mm or more and a disc that lies completely on the top face of " +
                                       shortText(block_mm.x()) + " x " + shortText(block_mm.y()) + " mm");
  return forceProblem("patch", patch.force_N);
}

/// Whether two indenters are the same body under the same kind of control.
bool sameBody(const Indenter& a, const Indenter& b) {
  Indenter other = b;
  other.control = a.control;
  return a == other && a.control.index() == b.control.index();
}

} // namespace

Eigen::Vector3d LoadCase::totalForce_N() const {
  Eigen::Vector3d total = Eigen::Vector3d::Zero();
  for (const AreaLoad& load : areas) total += load.force_N;
  for (const PatchLoad& load : patches) total += load.force_N;
  return total;
}

std::optional<std::string> whyInvalid(const LoadCase& load, const SensorDesign& design) {
  for (const AreaLoad& areaLoad : load.areas) {
    if (areaLoad.area < 0 || areaLoad.area >= design.areas.count())
      return "area: " + gotExpected(std::to_string(areaLoad.area),
                                    "0 to " + std::to_string(design.areas.count() - 1) + ", the areas of the design");
    if (auto wrong = forceProblem("area " + std::to_string(areaLoad.area), areaLoad.force_N)) return wrong;
  }
  for (const PatchLoad& patch : load.patches)
    if (auto wrong = patchProblem(patch, design.block_mm)) return wrong;
  for (const Indenter& indenter : load.indenters)
    if (auto wrong = whyInvalid(indenter, design)) return wrong;
  return {};
}

std::optional<std::string> whyInvalid(const std::vector<LoadCase>& path, const SensorDesign& design) {
  if (path.empty()) return "steps of the path: " + gotExpected("0", "1 or more");
  for (std::size_t step = 0; step < path.size(); ++step) {
    const std::string where = path.size() > 1 ? "step " + std::to_string(step) + " of the path: " : "";
    const std::vector<Indenter>&first = path.front().indenters, &now = path[step].indenters;
    if (now.empty()) return where + "indenters: " + gotExpected("0", "1 or more, the same in each step");
    if (auto wrong = whyInvalid(path[step], design)) return where + *wrong;
    if (now.size() != first.size())
      return where + "indenters: " +
             gotExpected(std::to_string(now.size()), "the " + std::to_string(first.size()) + " of step 0");
    for (std::size_t k = 0; k < now.size(); ++k)
      if (!sameBody(now[k], first[k]))
        return where + "indenter " + std::to_string(k) + ": " +
               gotExpected("another " + shapeName(now[k].shape) + " than in step 0",
                           "the same shape, size, position, friction and control (force or depth) in each step");
  }
  return {};
}

} // namespace palp
