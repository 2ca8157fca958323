#include "solver/batch/LoadBatch.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace palp {

namespace {

constexpr int largestElementDofs = 30;
constexpr int supernodesACall = 16; // between looks at a stop request
using ElementLanes = std::array<double, largestElementDofs * lanes>;

/// Inline, where std::copy becomes a call.
inline void copyLanes(const double* from, double* to) {
  std::memcpy(to, from, lanes * sizeof(double));
}

std::size_t at(std::size_t row, int block) {
  return row * batchLanes + std::size_t(block) * lanes;
}

/// Asks for the numbers of a block at an element's nodes, in [3 nodes][32], before they are needed: they lie anywhere
/// in an array that no cache holds. Past the last element nothing is asked for.
inline void prefetch(const Discretisation& mesh, int element, int block, const double* values) {
  if (element >= mesh.elements()) return;
  for (int n = 0; n < mesh.kernels().nodes; ++n)
    for (int d = 0; d < 3; ++d) __builtin_prefetch(values + at(3 * std::size_t(mesh.node(element, n)) + d, block));
}

} // namespace

LoadBatch::LoadBatch(const ElementwiseTangent& model, const PointProbe& upper)
    : model_(model), upper_(upper), u_(3 * std::size_t(model.mesh().nodes()) * batchLanes), r_(u_.size()),
      x_(std::size_t(model.mesh().elements()) * model.mesh().unknowns() * batchLanes), local_(x_.size()),
      solution_(std::size_t(model.rightSideRows()) * batchLanes) {}

void LoadBatch::reset(int block) {
  const std::size_t own = std::size_t(model_.mesh().unknowns()) * lanes;
  for (std::size_t row = 0; row < 3 * std::size_t(model_.mesh().nodes()); ++row)
    std::fill_n(u_.data() + at(row, block), lanes, 0.);
  for (std::size_t e = 0; e < std::size_t(model_.mesh().elements()); ++e)
    std::fill_n(x_.data() + (e * blocks + block) * own, own, 0.);
  for (int lane = 0; lane < lanes; ++lane) forces_[block * lanes + lane].clear();
  atRest_[block] = true;
}

void LoadBatch::addPolynomials(int block, const std::vector<double>& displacements, const std::vector<double>& unknowns,
                               int terms, const double* monomials) {
  atRest_[block] = false;
  const auto& kernels = laneKernels();
  kernels.addPolynomials(displacements.data(), terms, monomials, 3 * model_.mesh().nodes(), u_.data() + block * lanes,
                         batchLanes);
  const int own = model_.mesh().unknowns();
  for (int e = 0; e < model_.mesh().elements(); ++e)
    kernels.addPolynomials(unknowns.data() + std::size_t(e) * own * terms, terms, monomials, own,
                           x_.data() + (std::size_t(e) * blocks + block) * own * lanes, lanes);
}

void LoadBatch::evaluateResiduals(const std::array<bool, blocks>& live, const std::stop_token& stop) {
  const Discretisation& mesh = model_.mesh();
  const ElementKernels& kernels = mesh.kernels();
  const int own = mesh.unknowns();
  std::fill(r_.begin(), r_.end(), 0.);
  for (int lane = 0; lane < batchLanes; ++lane)
    for (const auto& [shares, force_N] : forces_[lane])
      for (const auto& [node, share] : *shares)
        for (int d = 0; d < 3; ++d) r_[(3 * std::size_t(node) + d) * batchLanes + lane] += share * force_N(d);
  smallestJ_.fill(1);
  alignas(64) ElementLanes u, f;
  alignas(64) std::array<std::array<double, 2 * lanes>, blocks> range;
  for (auto& r : range) r.fill(1);
  for (int e = 0; e < mesh.elements() && !stop.stop_requested(); ++e) {
    for (int b = 0; b < blocks; ++b) {
      if (!live[b]) continue;
      prefetch(mesh, e + 1, b, u_.data());
      prefetch(mesh, e + 1, b, r_.data());
      const std::size_t own0 = (std::size_t(e) * blocks + b) * own * lanes;
      if (atRest_[b]) { // no forces, no volume change, and no rounding errors of either
        std::fill_n(local_.data() + own0, own * lanes, 0.);
        continue;
      }
      for (int n = 0; n < kernels.nodes; ++n)
        for (int d = 0; d < 3; ++d)
          copyLanes(u_.data() + at(3 * std::size_t(mesh.node(e, n)) + d, b), u.data() + (3 * n + d) * lanes);
      kernels.residualOfLoads(model_.rubber(), {model_.geometry(e), u.data(), x_.data() + own0},
                              {f.data(), local_.data() + own0, range[b].data()});
      kernels.condenseLoads(model_.elimination(e), local_.data() + own0, f.data());
      for (int n = 0; n < kernels.nodes; ++n)
        for (int d = 0; d < 3; ++d) {
          double* r = r_.data() + at(3 * std::size_t(mesh.node(e, n)) + d, b);
          const double* p = f.data() + (3 * n + d) * lanes;
          for (int lane = 0; lane < lanes; ++lane) r[lane] -= p[lane];
        }
    }
  }
  for (int lane = 0; lane < batchLanes; ++lane) smallestJ_[lane] = range[lane / lanes][lane % lanes];
  for (int b = 0; b < blocks; ++b) atRest_[b] = atRest_[b] && !live[b];
}

/// K0 du = r; u += du. Residuals go to single precision relative to their norm, and the directions back, which stand
/// where the residuals stood; inactive lanes get none.
void LoadBatch::solveDirections(const std::array<bool, batchLanes>& active, const std::stop_token& stop) {
  const std::vector<int>& rows = model_.factorRows();
  std::array<double, batchLanes> squares{};
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i] >= 0)
      for (int lane = 0; lane < batchLanes; ++lane)
        squares[lane] += r_[i * batchLanes + lane] * r_[i * batchLanes + lane];
  std::array<double, batchLanes> inverse{};
  for (int lane = 0; lane < batchLanes; ++lane) {
    scale_[lane] = active[lane] && std::isfinite(squares[lane]) ? std::sqrt(squares[lane]) : 0;
    inverse[lane] = scale_[lane] > 0 ? 1 / scale_[lane] : 0;
  }
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i] >= 0)
      for (int lane = 0; lane < batchLanes; ++lane) {
        const double r = inverse[lane] > 0 ? r_[i * batchLanes + lane] * inverse[lane] : 0;
        solution_[std::size_t(rows[i]) * batchLanes + lane] = static_cast<float>(r);
      }
  const BlockedFactor factor = model_.factor();
  for (int first = 0; first < factor.count && !stop.stop_requested(); first += supernodesACall)
    laneKernels().forward(factor, first, std::min(factor.count, first + supernodesACall), solution_.data());
  for (int last = factor.count; last > 0 && !stop.stop_requested(); last -= supernodesACall)
    laneKernels().backward(factor, std::max(0, last - supernodesACall), last, solution_.data());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (int lane = 0; lane < batchLanes; ++lane) {
      const std::size_t k = i * batchLanes + lane;
      r_[k] = rows[i] >= 0 ? scale_[lane] * double(solution_[std::size_t(rows[i]) * batchLanes + lane]) : 0;
      u_[k] += r_[k];
    }
}

/// dx = -Kxx^-1 local - W du with the directions du just found.
void LoadBatch::updateUnknowns(const std::array<bool, blocks>& live, const std::stop_token& stop) {
  const Discretisation& mesh = model_.mesh();
  const ElementKernels& kernels = mesh.kernels();
  const int own = mesh.unknowns();
  alignas(64) ElementLanes du, dx;
  for (int e = 0; e < mesh.elements() && !stop.stop_requested(); ++e) {
    for (int b = 0; b < blocks; ++b) {
      if (!live[b]) continue;
      prefetch(mesh, e + 1, b, r_.data());
      for (int n = 0; n < kernels.nodes; ++n)
        for (int d = 0; d < 3; ++d)
          copyLanes(r_.data() + at(3 * std::size_t(mesh.node(e, n)) + d, b), du.data() + (3 * n + d) * lanes);
      const std::size_t own0 = (std::size_t(e) * blocks + b) * own * lanes;
      kernels.recoverLoads(model_.elimination(e), model_.localInverse(e), local_.data() + own0, du.data(), dx.data());
      for (int i = 0; i < own * lanes; ++i)
        if (scale_[b * lanes + i % lanes] > 0) x_[own0 + i] += dx[i];
    }
  }
}

LaneVector LoadBatch::displacementsAt(const PointProbe& probe) const {
  LaneVector out(3 * probe.holders().size() * batchLanes);
  for (std::size_t i = 0; i < probe.holders().size(); ++i) {
    const PointProbe::Holder& holder = probe.holders()[i].front();
    double* value = out.data() + 3 * i * batchLanes;
    for (Eigen::Index n = 0; n < holder.shapes.size(); ++n) {
      const double shape = holder.shapes(n);
      if (shape == 0) continue;
      const double* u =
          u_.data() + 3 * std::size_t(model_.mesh().node(holder.element, static_cast<int>(n))) * batchLanes;
      for (int k = 0; k < 3 * batchLanes; ++k) value[k] += shape * u[k];
    }
    if (holder.bubble != 0)
      for (int k = 0; k < 3 * batchLanes; ++k)
        value[k] += holder.bubble * unknown(holder.element, k / batchLanes, k % batchLanes);
  }
  return out;
}

LaneVector LoadBatch::pressuresAt(const PointProbe& probe) const {
  LaneVector out(probe.holders().size() * batchLanes);
  for (std::size_t i = 0; i < probe.holders().size(); ++i) {
    const auto& holders = probe.holders()[i];
    for (const PointProbe::Holder& holder : holders) {
      const int first = model_.mesh().unknowns() - static_cast<int>(holder.pressure.size());
      for (Eigen::Index k = 0; k < holder.pressure.size(); ++k)
        for (int lane = 0; lane < batchLanes; ++lane)
          out[i * batchLanes + lane] -=
              holder.pressure(k) * unknown(holder.element, first + static_cast<int>(k), lane) / double(holders.size());
    }
  }
  return out;
}

void LoadBatch::iterate(const std::array<bool, batchLanes>& active, std::array<double, batchLanes>& change,
                        const std::stop_token& stop) {
  std::array<bool, blocks> live{};
  for (int lane = 0; lane < batchLanes; ++lane) live[lane / lanes] = live[lane / lanes] || active[lane];
  const LaneVector before = displacementsAt(upper_);
  evaluateResiduals(live, stop);
  solveDirections(active, stop);
  updateUnknowns(live, stop);
  const LaneVector after = displacementsAt(upper_);
  std::array<double, batchLanes> difference{}, norm{};
  for (std::size_t i = 0; i < after.size(); ++i) {
    difference[i % batchLanes] += (after[i] - before[i]) * (after[i] - before[i]);
    norm[i % batchLanes] += after[i] * after[i];
  }
  for (int lane = 0; lane < batchLanes; ++lane) {
    if (!active[lane]) continue;
    const double relative = norm[lane] > 0 ? std::sqrt(difference[lane] / norm[lane]) : 0;
    change[lane] = smallestJ_[lane] > 0 && std::isfinite(relative) ? relative : -1;
  }
}

std::vector<ElectrodeDisplacements> LoadBatch::electrodes(int block, const PointProbe& lower) const {
  const LaneVector up = displacementsAt(upper_), low = displacementsAt(lower), pressure = pressuresAt(upper_);
  const auto ofLane = [](const LaneVector& values, int lane) {
    return Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<batchLanes>>(
        values.data() + lane, static_cast<Eigen::Index>(values.size() / batchLanes));
  };
  std::vector<ElectrodeDisplacements> all;
  for (int l = block * lanes; l < (block + 1) * lanes; ++l)
    all.push_back(
        {ofLane(up, l).reshaped(3, Eigen::AutoSize), ofLane(low, l).reshaped(3, Eigen::AutoSize), ofLane(pressure, l)});
  return all;
}

} // namespace palp
