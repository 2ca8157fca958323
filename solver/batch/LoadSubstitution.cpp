// How a LoadBatch substitutes through the factor.

#include "solver/batch/LoadBatch.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace palp {

namespace {

constexpr int supernodesACall = 16; // between looks at a stop request

} // namespace

/// Right sides of K0 du = r in single precision, relative to their norm; inactive lanes have none.
void LoadBatch::scaleResiduals(const std::array<bool, batchLanes>& active) {
  const std::vector<int>& rows = model_.factorRows();
  const int filling = model_.fillingRow();
  std::array<double, batchLanes> squares{};
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i] != filling)
      for (int lane = 0; lane < batchLanes; ++lane)
        squares[lane] += r_[i * batchLanes + lane] * r_[i * batchLanes + lane];
  std::array<double, batchLanes> inverse{};
  for (int lane = 0; lane < batchLanes; ++lane) {
    const bool finite = std::isfinite(squares[lane]);
    if (active[lane] && !finite) smallestJ_[lane] = -1; // lost, and no arrival for want of a change
    scale_[lane] = active[lane] && finite ? std::sqrt(squares[lane]) : 0;
    inverse[lane] = scale_[lane] > 0 ? 1 / scale_[lane] : 0;
  }
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i] != filling)
      for (int lane = 0; lane < batchLanes; ++lane) {
        const double r = inverse[lane] > 0 ? r_[i * batchLanes + lane] * inverse[lane] : 0;
        solution_[std::size_t(rows[i]) * batchLanes + lane] = static_cast<float>(r);
      }
  std::fill_n(solution_.data() + std::size_t(filling) * batchLanes, batchLanes, 0.F);
}

/// One way through these supernodes, of the blocks that have right sides.
void LoadBatch::substitute(Direction direction, FactorPath::Range supernodes, const std::stop_token& stop) {
  unsigned live = 0;
  for (int lane = 0; lane < batchLanes; ++lane)
    if (scale_[lane] > 0) live |= 1U << unsigned(lane / lanes);
  const BlockedFactor factor = model_.factor();
  const auto& kernels = laneKernels();
  const auto [from, to] = supernodes;
  if (direction == Direction::Forward)
    for (int first = from; first < to && !stop.stop_requested(); first += supernodesACall)
      kernels.forward(factor, first, std::min(to, first + supernodesACall), live, solution_.data());
  else
    for (int last = to; last > from && !stop.stop_requested(); last -= supernodesACall)
      kernels.backward(factor, std::max(from, last - supernodesACall), last, live, solution_.data());
}

/// Between the two ways of the substitution: how the nodes move, and what the change of their forces adds.
void LoadBatch::substituteAlong(const FactorPath& path, const std::array<bool, batchLanes>& active,
                                std::span<const int> nodes, const Answer& answer, const std::stop_token& stop) {
  held_.resize(path.rowCount() * batchLanes);
  const auto overRows = [&](const auto& take) { // begin and count in the solution, begin in what is held
    std::size_t held = 0;
    for (const auto& [from, to] : path.rows()) {
      const std::size_t count = std::size_t(to - from) * batchLanes;
      take(solution_.begin() + std::ptrdiff_t(from) * batchLanes, count, held_.begin() + std::ptrdiff_t(held));
      held += count;
    }
  };
  overRows([](auto x, std::size_t count, auto held) { std::copy_n(x, count, held); });
  for (std::size_t i = path.supernodes().size(); i-- > 0;) substitute(Direction::Backward, path.supernodes()[i], stop);
  if (stop.stop_requested()) return;
  std::array<std::vector<NodeForce>, batchLanes> added;
  answerMotion(active, nodes, answer, added);
  overRows([](auto x, std::size_t count, auto) { std::fill_n(x, count, 0.F); });
  for (int lane = 0; lane < batchLanes; ++lane) addToRight(lane, added[lane]);
  for (const FactorPath::Range& range : path.supernodes()) substitute(Direction::Forward, range, stop);
  overRows([](auto x, std::size_t count, auto held) {
    std::transform(x, x + std::ptrdiff_t(count), held, x, std::plus<>());
  });
}

/// The active lanes' forces where the directions would lead; `added` to those that the directions were found for.
void LoadBatch::answerMotion(const std::array<bool, batchLanes>& active, std::span<const int> nodes,
                             const Answer& answer, std::array<std::vector<NodeForce>, batchLanes>& added) {
  Eigen::Matrix3Xd motion_mm(3, static_cast<Eigen::Index>(nodes.size()));
  for (int lane = 0; lane < batchLanes; ++lane) {
    if (!active[lane]) continue;
    for (std::size_t n = 0; n < nodes.size(); ++n)
      for (int d = 0; d < 3; ++d) {
        const std::size_t i = 3 * std::size_t(nodes[n]) + d;
        const float du = solution_[std::size_t(model_.factorRows()[i]) * batchLanes + lane];
        motion_mm(d, static_cast<Eigen::Index>(n)) = u_[i * batchLanes + lane] + scale_[lane] * double(du);
      }
    std::map<int, Eigen::Vector3d> changes; // in double: small beside the forces, in the end
    const auto add = [&](double sign) {
      for (const auto& [node, force_N] : nodeForces_[lane])
        changes.try_emplace(node, Eigen::Vector3d::Zero()).first->second += sign * force_N;
    };
    add(-1);
    if (!answer(lane, motion_mm)) smallestJ_[lane] = -1;
    add(1);
    for (const auto& [node, force_N] : changes) added[lane].push_back({node, force_N});
  }
}

/// A lane that had no residual is scaled by these forces.
void LoadBatch::addToRight(int lane, const std::vector<NodeForce>& forces) {
  if (!(scale_[lane] > 0)) {
    double square = 0;
    for (const auto& [node, force_N] : forces) square += force_N.squaredNorm();
    if (!std::isfinite(square)) smallestJ_[lane] = -1;
    scale_[lane] = std::isfinite(square) ? std::sqrt(square) : 0;
  }
  if (!(scale_[lane] > 0)) return;
  for (const auto& [node, force_N] : forces)
    for (int d = 0; d < 3; ++d)
      if (const int row = model_.factorRows()[3 * std::size_t(node) + d]; row != model_.fillingRow())
        solution_[std::size_t(row) * batchLanes + lane] += static_cast<float>(force_N(d) / scale_[lane]);
}

} // namespace palp
