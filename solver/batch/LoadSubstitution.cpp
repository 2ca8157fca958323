// Forward and backward sweeps of a LoadBatch through the factor, and the change of contact forces between them.

#include "solver/batch/LoadBatch.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace palp {

namespace {

constexpr int supernodesACall = 16; // between looks at a stop request

} // namespace

/// Right-hand sides of K0 du = r in single precision, relative to their norm; 0 for inactive columns.
void LoadBatch::scaleResiduals(const std::array<bool, batchColumns>& active) {
  const std::vector<int>& rows = model_.factorRows();
  const int padding = model_.paddingRow();
  std::array<double, batchColumns> squares{};
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i] != padding)
      for (int column = 0; column < batchColumns; ++column)
        squares[column] += r_[i * batchColumns + column] * r_[i * batchColumns + column];
  std::array<double, batchColumns> inverse{};
  for (int column = 0; column < batchColumns; ++column) {
    const bool finite = std::isfinite(squares[column]);
    if (active[column] && !finite) smallestJ_[column] = -1; // failed: a zero change must not count as converged
    scale_[column] = active[column] && finite ? std::sqrt(squares[column]) : 0;
    inverse[column] = scale_[column] > 0 ? 1 / scale_[column] : 0;
  }
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i] != padding)
      for (int column = 0; column < batchColumns; ++column) {
        const double r = inverse[column] > 0 ? r_[i * batchColumns + column] * inverse[column] : 0;
        solution_[std::size_t(rows[i]) * batchColumns + column] = static_cast<float>(r);
      }
  std::fill_n(solution_.data() + std::size_t(padding) * batchColumns, batchColumns, 0.F);
}

/// One sweep through these supernodes, for the blocks that have right-hand sides.
void LoadBatch::substitute(Direction direction, FactorPath::Range supernodes, const std::stop_token& stop) {
  unsigned live = 0;
  for (int column = 0; column < batchColumns; ++column)
    if (scale_[column] > 0) live |= 1U << unsigned(column / lanes);
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

/// Between forward and backward sweep: finds the nodes' motion, and adds the change of their forces.
void LoadBatch::substituteAlong(const FactorPath& path, const std::array<bool, batchColumns>& active,
                                std::span<const int> nodes, const Answer& answer, const std::stop_token& stop) {
  saved_.resize(path.rowCount() * batchColumns);
  const auto overRows = [&](const auto& take) { // begin and count in the solution, begin in the saved rows
    std::size_t saved = 0;
    for (const auto& [from, to] : path.rows()) {
      const std::size_t count = std::size_t(to - from) * batchColumns;
      take(solution_.begin() + std::ptrdiff_t(from) * batchColumns, count, saved_.begin() + std::ptrdiff_t(saved));
      saved += count;
    }
  };
  overRows([](auto x, std::size_t count, auto saved) { std::copy_n(x, count, saved); });
  for (std::size_t i = path.supernodes().size(); i-- > 0;) substitute(Direction::Backward, path.supernodes()[i], stop);
  if (stop.stop_requested()) return;
  std::array<std::vector<NodeForce>, batchColumns> added;
  answerMotion(active, nodes, answer, added);
  overRows([](auto x, std::size_t count, auto) { std::fill_n(x, count, 0.F); });
  for (int column = 0; column < batchColumns; ++column) addToRight(column, added[column]);
  for (const FactorPath::Range& range : path.supernodes()) substitute(Direction::Forward, range, stop);
  overRows([](auto x, std::size_t count, auto saved) {
    std::transform(x, x + std::ptrdiff_t(count), saved, x, std::plus<>());
  });
}

/// Sets the active columns' contact forces at the predicted motion; `added` becomes their change.
void LoadBatch::answerMotion(const std::array<bool, batchColumns>& active, std::span<const int> nodes,
                             const Answer& answer, std::array<std::vector<NodeForce>, batchColumns>& added) {
  Eigen::Matrix3Xd motion_mm(3, static_cast<Eigen::Index>(nodes.size()));
  for (int column = 0; column < batchColumns; ++column) {
    if (!active[column]) continue;
    for (std::size_t n = 0; n < nodes.size(); ++n)
      for (int d = 0; d < 3; ++d) {
        const std::size_t i = 3 * std::size_t(nodes[n]) + d;
        const float du = solution_[std::size_t(model_.factorRows()[i]) * batchColumns + column];
        motion_mm(d, static_cast<Eigen::Index>(n)) = u_[i * batchColumns + column] + scale_[column] * double(du);
      }
    std::map<int, Eigen::Vector3d> changes; // in double: in the end small compared with the forces
    const auto add = [&](double sign) {
      for (const auto& [node, force_N] : nodeForces_[column])
        changes.try_emplace(node, Eigen::Vector3d::Zero()).first->second += sign * force_N;
    };
    add(-1);
    if (!answer(column, motion_mm)) smallestJ_[column] = -1;
    add(1);
    for (const auto& [node, force_N] : changes) added[column].push_back({node, force_N});
  }
}

/// Adds forces to a column's right-hand side; a column without a residual is scaled by them.
void LoadBatch::addToRight(int column, const std::vector<NodeForce>& forces) {
  if (!(scale_[column] > 0)) {
    double square = 0;
    for (const auto& [node, force_N] : forces) square += force_N.squaredNorm();
    if (!std::isfinite(square)) smallestJ_[column] = -1;
    scale_[column] = std::isfinite(square) ? std::sqrt(square) : 0;
  }
  if (!(scale_[column] > 0)) return;
  for (const auto& [node, force_N] : forces)
    for (int d = 0; d < 3; ++d)
      if (const int row = model_.factorRows()[3 * std::size_t(node) + d]; row != model_.paddingRow())
        solution_[std::size_t(row) * batchColumns + column] += static_cast<float>(force_N(d) / scale_[column]);
}

} // namespace palp
