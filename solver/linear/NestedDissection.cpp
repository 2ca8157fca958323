#include "solver/linear/NestedDissection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

namespace palp {

namespace {

constexpr int leaf = 6; // number of groups that are not cut any further
constexpr double samePlane = 1e-9;
constexpr double imbalanceExponent = 3;

/// Across these directions, in numbers of planes along the axes, a tetrahedral grid's cuts are smallest: its triangles
/// lie along the axes' planes and along their diagonals.
constexpr int directionCount = 9;
constexpr std::array<std::array<int, 3>, directionCount> directions{
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1}}};

/// Number of each group's plane along one axis.
std::vector<int> planesAlong(const SparsePattern& pattern, int axis) {
  const auto x = [&](int g) { return pattern.groupPositions_mm(axis, g); };
  const auto groups = static_cast<int>(pattern.groupPositions_mm.cols());
  std::vector<int> sorted(groups), plane(groups);
  std::iota(sorted.begin(), sorted.end(), 0);
  std::sort(sorted.begin(), sorted.end(), [&](int a, int b) { return x(a) < x(b) || (x(a) == x(b) && a < b); });
  const double tolerance = groups > 0 ? samePlane * (x(sorted.back()) - x(sorted.front())) : 0;
  for (int i = 1; i < groups; ++i)
    plane[sorted[i]] = plane[sorted[i - 1]] + (x(sorted[i]) - x(sorted[i - 1]) > tolerance ? 1 : 0);
  return plane;
}

/// Number of each group's plane across one direction, and the furthest plane that its neighbours lie on.
struct Planes {
  std::vector<int> own, furthest;
};

Planes planesAcross(const SparsePattern& pattern, const std::array<std::vector<int>, 3>& along,
                    const std::array<int, 3>& direction, const std::vector<bool>& isLast) {
  Planes planes;
  planes.own.resize(pattern.groupPositions_mm.cols());
  for (std::size_t g = 0; g < planes.own.size(); ++g)
    for (int axis = 0; axis < 3; ++axis) planes.own[g] += direction[axis] * along[axis][g];
  planes.furthest = planes.own;
  for (int g = 0; g < static_cast<int>(planes.own.size()); ++g)
    for (int k = pattern.groupColumns[g]; k < pattern.groupColumns[g + 1]; ++k) {
      const int other = pattern.groupRows[k];
      if (isLast[g] || isLast[other]) continue;
      planes.furthest[g] = std::max(planes.furthest[g], planes.own[other]);
      planes.furthest[other] = std::max(planes.furthest[other], planes.own[g]);
    }
  return planes;
}

/// A cut behind `plane`, the last of the lower half: groups there or below with neighbours beyond it are the separator.
struct Cut {
  int direction = -1;
  int plane = 0;
  double cost = 0;
};

class Dissection {
public:
  explicit Dissection(const SparsePattern& pattern) {
    std::array<std::vector<int>, 3> along;
    for (int axis = 0; axis < 3; ++axis) along[axis] = planesAlong(pattern, axis);
    std::vector<bool> isLast(pattern.groupPositions_mm.cols());
    for (int g : pattern.lastGroups) isLast[g] = true;
    for (int d = 0; d < directionCount; ++d) planes_[d] = planesAcross(pattern, along, directions[d], isLast);
    for (int g = 0; g < static_cast<int>(isLast.size()); ++g)
      if (!isLast[g]) order_.push_back(g);
    dissect(order_);
    order_.insert(order_.end(), pattern.lastGroups.begin(), pattern.lastGroups.end());
  }
  [[nodiscard]] std::vector<int> order() && { return std::move(order_); }

private:
  void dissect(std::span<int> groups) {
    if (groups.size() <= leaf) return;
    Cut best;
    for (int d = 0; d < directionCount; ++d)
      if (const Cut cut = bestCut(groups, d); cut.direction >= 0 && (best.direction < 0 || cut.cost < best.cost))
        best = cut;
    if (best.direction < 0) return;
    const Planes& planes = planes_[best.direction];
    const auto isLower = [&](int g) { return planes.own[g] <= best.plane && planes.furthest[g] <= best.plane; };
    const auto isUpper = [&](int g) { return planes.own[g] > best.plane; };
    const auto upper = std::stable_partition(groups.begin(), groups.end(), isLower);
    const auto cut = std::stable_partition(upper, groups.end(), isUpper);
    dissect({groups.begin(), upper});
    dissect({upper, cut});
  }

  /// The cheapest cut that leaves something on both sides: few groups on it, halves of like size.
  Cut bestCut(std::span<const int> groups, int direction) {
    const Planes& planes = planes_[direction];
    const auto [low, high] =
        std::minmax_element(groups.begin(), groups.end(), [&](int a, int b) { return planes.own[a] < planes.own[b]; });
    const int first = planes.own[*low], count = planes.own[*high] - first + 1;
    onPlane_.assign(count + 1, 0);
    reaching_.assign(count + 1, 0);
    for (int g : groups) {
      ++onPlane_[planes.own[g] - first];
      ++reaching_[planes.own[g] - first];
      --reaching_[std::min(planes.furthest[g] - first, count)];
    }
    Cut best;
    int below = 0, cut = 0;
    for (int p = 0; p + 1 < count; ++p) {
      below += onPlane_[p];
      cut += reaching_[p];
      const double lower = below - cut, upper = double(groups.size()) - below;
      if (lower <= 0 || upper <= 0) continue;
      const double equality = 4 * lower * upper / ((lower + upper) * (lower + upper));
      const double cost = cut / std::pow(equality, imbalanceExponent);
      if (best.direction < 0 || cost < best.cost) best = {direction, first + p, cost};
    }
    return best;
  }

  std::array<Planes, directionCount> planes_;
  std::vector<int> order_;
  std::vector<int> onPlane_, reaching_; // scratch
};

} // namespace

std::vector<int> nestedDissection(const SparsePattern& pattern) {
  return Dissection(pattern).order();
}

} // namespace palp
