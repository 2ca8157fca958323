#include "app/gui/project/IndenterPath.h"

#include "app/gui/project/JsonFields.h"
#include "model/SensorDesign.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

const Indenter* indenterOf(const LoadCase& load, const IndenterPath& path) {
  const auto k = static_cast<std::size_t>(path.indenter);
  return path.indenter >= 0 && k < load.indenters.size() ? &load.indenters[k] : nullptr;
}

std::vector<LoadCase> allLoads(const LoadCase& load, const IndenterPath& path) {
  std::vector<LoadCase> all{load};
  for (const auto& step : path.steps) {
    all.push_back(load);
    all.back().indenters[static_cast<std::size_t>(path.indenter)].control = step;
  }
  return all;
}

double hundredthOf(double value) {
  return std::round(100 * value) / 100;
}

} // namespace

std::optional<std::string> whyInvalid(const LoadCase& load, const IndenterPath& path, const SensorDesign& design) {
  if (indenterOf(load, path) == nullptr)
    return "a path of indenter " + std::to_string(path.indenter) + ", which does not exist";
  return whyInvalid(allLoads(load, path), design);
}

std::vector<LoadCase> loadsAfter(const LoadCase& load, const std::optional<IndenterPath>& path,
                                 const SensorDesign& design) {
  if (!path || path->steps.empty() || whyInvalid(load, *path, design)) return {};
  std::vector<LoadCase> all = allLoads(load, *path);
  all.erase(all.begin());
  return all;
}

std::optional<IndenterPath> pathKept(const std::optional<IndenterPath>& path, const LoadCase& before,
                                     const LoadCase& after) {
  if (!path || before.indenters.size() > after.indenters.size()) return {};
  const Indenter* its = indenterOf(after, *path);
  if (its == nullptr) return {};
  const bool alike = path->steps.empty() || path->steps.front().index() == its->control.index();
  return alike ? path : std::nullopt;
}

Eigen::Matrix2Xd wayOf(const LoadCase& load, const std::optional<IndenterPath>& path) {
  const Indenter* its = path ? indenterOf(load, *path) : nullptr;
  if (its == nullptr || its->motion() == nullptr) return {};
  Eigen::Matrix2Xd way(2, 1 + static_cast<Eigen::Index>(path->steps.size()));
  way.col(0) = its->place_mm + its->motion()->shift_mm;
  for (std::size_t k = 0; k < path->steps.size(); ++k) {
    const Motion* motion = std::get_if<Motion>(&path->steps[k]);
    if (motion == nullptr) return {};
    way.col(static_cast<Eigen::Index>(k) + 1) = its->place_mm + motion->shift_mm;
  }
  return way;
}

std::vector<std::variant<Press, Motion>> stepsAlong(const Eigen::Matrix2Xd& drawn_mm, const Motion& from, int most) {
  double length = 0;
  for (Eigen::Index k = 1; k < drawn_mm.cols(); ++k) length += (drawn_mm.col(k) - drawn_mm.col(k - 1)).norm();
  constexpr double kLeastStep_mm = 0.25;
  const int count = std::min(most, static_cast<int>(length / kLeastStep_mm));
  std::vector<std::variant<Press, Motion>> steps;
  double gone = 0;
  Eigen::Index next = 1;
  for (int k = 1; k <= count; ++k) {
    const double wanted = length * k / count;
    while (next + 1 < drawn_mm.cols() && gone + (drawn_mm.col(next) - drawn_mm.col(next - 1)).norm() < wanted) {
      gone += (drawn_mm.col(next) - drawn_mm.col(next - 1)).norm();
      ++next;
    }
    const Eigen::Vector2d corner = drawn_mm.col(next - 1), part = drawn_mm.col(next) - corner;
    const double share = part.norm() > 0 ? std::clamp((wanted - gone) / part.norm(), 0.0, 1.0) : 1;
    const Eigen::Vector2d shift = from.shift_mm + corner + share * part - drawn_mm.col(0);
    steps.emplace_back(Motion{from.depth_mm, {hundredthOf(shift.x()), hundredthOf(shift.y())}});
  }
  return steps;
}

std::string loadFile(const LoadCase& load, const IndenterPath& path, const SensorDesign& design) {
  std::vector<LoadCase> all{load};
  for (const LoadCase& next : loadsAfter(load, path, design)) all.push_back(next);
  Json steps = Json::array();
  for (const LoadCase& each : all) steps.push_back({{"indenters", jsonOf(each.indenters)}});
  return jsonText(steps, 4) + "\n";
}

} // namespace palp
