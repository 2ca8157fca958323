#include "solver/batch/LoadBatch.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palp {

namespace {

using ElementLanes = std::array<double, largestElementDofs * lanes>;

std::size_t at(std::size_t row, int block) {
  return row * batchLanes + std::size_t(block) * lanes;
}

/// Asks for the numbers of a block at an element's nodes, in [3 nodes][32], before they are needed: they lie anywhere
/// in an array that no cache holds. Past the last element nothing is asked for.
inline void prefetch(const ElementwiseTangent& model, int place, int block, const double* values) {
  if (place >= model.mesh().elements()) return;
  for (int n = 0; n < model.mesh().kernels().nodes; ++n)
    for (int d = 0; d < 3; ++d) __builtin_prefetch(values + at(3 * std::size_t(model.nodes(place)[n]) + d, block));
}

/// The same of the directions [rows of the factor + 1][32].
inline void prefetch(const ElementwiseTangent& model, int place, int block, const float* directions) {
  if (place >= model.mesh().elements()) return;
  for (int n = 0; n < model.mesh().kernels().nodes; ++n)
    for (int d = 0; d < 3; ++d)
      __builtin_prefetch(directions +
                         at(std::size_t(model.factorRows()[3 * std::size_t(model.nodes(place)[n]) + d]), block));
}

/// Each lane's change relative to its size (and the floor for each number) where that is larger than what is there;
/// what is no number stays.
void growToRelativeChange(const LaneVector& before, const LaneVector& after, const LaneVector& size, double floor,
                          std::array<double, batchLanes>& largest) {
  std::array<double, batchLanes> difference{}, norm{};
  for (std::size_t i = 0; i < after.size(); ++i)
    difference[i % batchLanes] += (after[i] - before[i]) * (after[i] - before[i]);
  for (std::size_t i = 0; i < size.size(); ++i) norm[i % batchLanes] += size[i] * size[i] + floor * floor;
  for (int lane = 0; lane < batchLanes; ++lane) {
    const double relative = norm[lane] == 0 ? 0 : std::sqrt(difference[lane] / norm[lane]);
    if (!(relative <= largest[lane])) largest[lane] = relative;
  }
}

} // namespace

LoadBatch::LoadBatch(const ElementwiseTangent& model, const PointProbe& upper, const PointProbe& lower, Watched watched)
    : model_(model), upper_(upper), lower_(lower), watched_(watched),
      u_(3 * std::size_t(model.mesh().nodes()) * batchLanes), r_(u_.size()),
      x_(std::size_t(model.mesh().elements()) * model.mesh().unknowns() * batchLanes), local_(x_.size()),
      solution_(std::size_t(model.rightSideRows()) * batchLanes), probed_(model.mesh().elements()) {
  for (const PointProbe* probe : {&upper_, &lower_})
    for (const auto& holders : probe->holders())
      for (const PointProbe::Holder& holder : holders) probed_[model.placeOf(holder.element)] = 1;
}

void LoadBatch::reset(int block, bool inSingle) {
  const std::size_t own = std::size_t(model_.mesh().unknowns()) * lanes;
  for (std::size_t row = 0; row < 3 * std::size_t(model_.mesh().nodes()); ++row)
    std::fill_n(u_.data() + at(row, block), lanes, 0.);
  for (std::size_t e = 0; e < std::size_t(model_.mesh().elements()); ++e)
    std::fill_n(x_.data() + (e * blocks + block) * own, own, 0.);
  for (int lane = block * lanes; lane < (block + 1) * lanes; ++lane) {
    forces_[lane].clear();
    nodeForces_[lane].clear();
    atRest_[lane] = true;
    if (mixing_) mixing_->begin(lane, false);
  }
  starts_[block] = {};
  begins_[block] = behind_[block] = false;
  inSingle_[block] = inSingle;
}

void LoadBatch::mix(int lane, bool inSingle) {
  const int block = lane / lanes;
  if (!mixing_) {
    for (int b = 0; b < blocks; ++b) catchUp(b); // without what is not there yet
    mixing_ = std::make_unique<LaneMixing>(3 * std::size_t(model_.mesh().nodes()),
                                           std::size_t(model_.mesh().elements()) * model_.mesh().unknowns(),
                                           model_.mesh().unknowns());
    uBefore_.resize(u_.size());
    xBefore_.resize(x_.size());
  }
  mixing_->begin(lane, true);
  forces_[lane].clear();
  nodeForces_[lane].clear();
  atRest_[lane] = true;
  inSingle_[block] = inSingle;
  LaneStarts& starts = starts_[block];
  starts.begins[lane % lanes] = starts.atRest[lane % lanes] = -1;
  starts.ahead[lane % lanes] = 0;
  begins_[block] = true;
}

void LoadBatch::goOn(int lane, bool straight) {
  mixing_->restart(lane);
  LaneStarts& starts = starts_[lane / lanes];
  starts.begins[lane % lanes] = -1;
  starts.ahead[lane % lanes] = straight ? -1 : 0;
  begins_[lane / lanes] = true;
}

/// What waits for the next iteration is done first, so that it need not go along.
void LoadBatch::move(int from, int to) {
  const int old = from / lanes, now = to / lanes;
  catchUp(old);
  catchUp(now);
  const int own = model_.mesh().unknowns();
  copyLane(u_.data(), u_.size(), 1, from, to);
  copyLane(uBefore_.data(), uBefore_.size(), 1, from, to);
  copyLane(x_.data(), x_.size(), own, from, to);
  copyLane(xBefore_.data(), xBefore_.size(), own, from, to);
  mixing_->copy(from, to);
  forces_[to] = std::exchange(forces_[from], {});
  nodeForces_[to] = std::exchange(nodeForces_[from], {});
  atRest_[to] = atRest_[from];
  for (const auto masks : {&LaneStarts::begins, &LaneStarts::atRest, &LaneStarts::ahead})
    (starts_[now].*masks)[to % lanes] = std::exchange((starts_[old].*masks)[from % lanes], 0);
  begins_[now] = begins_[now] || begins_[old];
}

bool LoadBatch::isAtRest(int block) const {
  const auto first = atRest_.begin() + block * lanes;
  return std::find(first, first + lanes, false) == first + lanes;
}

/// Of lanes at rest there are no forces, no volume change, and no rounding errors of either.
void LoadBatch::keepRest(int block, double* values, int count) const {
  for (int lane = 0; lane < lanes; ++lane)
    if (atRest_[block * lanes + lane])
      for (int i = 0; i < count; ++i) values[i * lanes + lane] = 0;
}

/// Lanes that begin another load: their displacements, and the unknowns that are up to date.
void LoadBatch::startAnew() {
  for (int b = 0; b < blocks; ++b) {
    if (!begins_[b]) continue;
    laneKernels().beginLoads(u_.data() + b * lanes, uBefore_.data() + b * lanes, 3 * model_.mesh().nodes(), batchLanes,
                             starts_[b]);
    for (int e = 0; e < model_.mesh().elements(); ++e)
      if (probed_[e]) startAnew(e, b);
  }
}

void LoadBatch::startAnew(int place, int block) {
  const std::size_t own = ownStart(place, block);
  laneKernels().beginLoads(x_.data() + own, xBefore_.data() + own, model_.mesh().unknowns(), lanes, starts_[block]);
}

void LoadBatch::addPolynomials(int block, const std::vector<double>& displacements, const std::vector<double>& unknowns,
                               int terms, const double* monomials) {
  std::fill_n(atRest_.begin() + block * lanes, lanes, false);
  const auto& kernels = laneKernels();
  kernels.addPolynomials(displacements.data(), terms, monomials, 3 * model_.mesh().nodes(), u_.data() + block * lanes,
                         batchLanes);
  const int own = model_.mesh().unknowns();
  for (int e = 0; e < model_.mesh().elements(); ++e)
    kernels.addPolynomials(unknowns.data() + std::size_t(e) * own * terms, terms, monomials, own,
                           x_.data() + ownStart(model_.placeOf(e), block), lanes);
}

/// Residuals of the live blocks, whose unknowns catch up on the way: they stand in the cache here.
void LoadBatch::evaluateResiduals(const std::array<bool, blocks>& live, const std::stop_token& stop) {
  const Discretisation& mesh = model_.mesh();
  const ElementKernels& kernels = mesh.kernels();
  std::fill(r_.begin(), r_.end(), 0.);
  for (int lane = 0; lane < batchLanes; ++lane)
    for (const auto& [shares, force_N] : forces_[lane])
      for (const auto& [node, share] : *shares)
        for (int d = 0; d < 3; ++d) r_[(3 * std::size_t(node) + d) * batchLanes + lane] += share * force_N(d);
  for (int lane = 0; lane < batchLanes; ++lane)
    for (const auto& [node, force_N] : nodeForces_[lane])
      for (int d = 0; d < 3; ++d) r_[(3 * std::size_t(node) + d) * batchLanes + lane] += force_N(d);
  smallestJ_.fill(1);
  std::array<bool, blocks> rests{}, someRest{};
  for (int b = 0; b < blocks; ++b) {
    const auto first = atRest_.begin() + b * lanes;
    rests[b] = isAtRest(b);
    someRest[b] = !rests[b] && std::find(first, first + lanes, true) != first + lanes;
  }
  alignas(64) ElementLanes u, f;
  alignas(64) std::array<std::array<double, 2 * lanes>, blocks> range;
  for (auto& r : range) r.fill(1);
  for (int e = 0; e < mesh.elements() && !stop.stop_requested(); ++e) {
    const int* nodes = model_.nodes(e);
    for (int b = 0; b < blocks; ++b) {
      if (!live[b]) continue;
      prefetch(model_, e + 1, b, u_.data());
      prefetch(model_, e + 1, b, r_.data());
      const std::size_t own = ownStart(e, b);
      if (behind_[b]) prefetch(model_, e + 1, b, solution_.data());
      if (behind_[b] && !probed_[e]) updateUnknowns(e, b);
      if (begins_[b] && !probed_[e]) startAnew(e, b);
      if (rests[b]) {
        std::fill_n(local_.data() + own, mesh.unknowns() * lanes, 0.);
        continue;
      }
      laneKernels().gather(u_.data() + b * lanes, nodes, kernels.nodes, u.data());
      const auto residual = inSingle_[b] ? kernels.residualOfLoadsInSingle : kernels.residualOfLoads;
      residual(model_.rubber(), {model_.geometry(e), u.data(), x_.data() + own},
               {f.data(), local_.data() + own, range[b].data()});
      if (someRest[b]) {
        keepRest(b, f.data(), 3 * kernels.nodes);
        keepRest(b, local_.data() + own, mesh.unknowns());
      }
      kernels.condenseLoads(model_.elimination(e), local_.data() + own, f.data());
      laneKernels().subtract(f.data(), nodes, kernels.nodes, r_.data() + b * lanes);
    }
  }
  for (int lane = 0; lane < batchLanes; ++lane) smallestJ_[lane] = range[lane / lanes][lane % lanes];
  for (int b = 0; b < blocks; ++b) {
    if (!live[b]) continue;
    starts_[b] = {};
    begins_[b] = behind_[b] = false;
    std::fill_n(atRest_.begin() + b * lanes, lanes, false);
  }
}

/// u += du, or what is mixed of it.
void LoadBatch::moveAlongDirections() {
  const std::vector<int>& rows = model_.factorRows();
  if (mixing_) return mixing_->moveLeading(rows, solution_.data(), scale_, u_.data());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (int lane = 0; lane < batchLanes; ++lane)
      u_[i * batchLanes + lane] += scale_[lane] * double(solution_[std::size_t(rows[i]) * batchLanes + lane]);
}

/// dx = -Kxx^-1 local - W du with the directions du found last.
void LoadBatch::updateUnknowns(int place, int block) {
  const Discretisation& mesh = model_.mesh();
  const ElementKernels& kernels = mesh.kernels();
  const std::size_t own = ownStart(place, block);
  alignas(64) ElementLanes du, dx;
  const double* scale = scale_.data() + block * lanes;
  laneKernels().gatherScaled(solution_.data() + block * lanes, model_.factorRows().data(), scale, model_.nodes(place),
                             kernels.nodes, du.data());
  kernels.recoverLoads(model_.elimination(place), model_.localInverse(place), local_.data() + own, du.data(),
                       dx.data());
  const int count = mesh.unknowns();
  if (mixing_) return mixing_->moveFollowing(block, std::size_t(place), dx.data(), x_.data() + own);
  for (int i = 0; i < count * lanes; ++i)
    if (scale[i % lanes] > 0) x_[own + i] += dx[i];
}

Eigen::Matrix3Xd LoadBatch::displacementsOf(int lane) const {
  return Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<batchLanes>>(u_.data() + lane,
                                                                              3 * model_.mesh().nodes())
      .reshaped(3, model_.mesh().nodes());
}

Eigen::Matrix3Xd LoadBatch::displacementsOf(int lane, std::span<const int> nodes) const {
  Eigen::Matrix3Xd u(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (int d = 0; d < 3; ++d)
      u(d, static_cast<Eigen::Index>(n)) =
          u_[(3 * std::size_t(nodes[n]) + std::size_t(d)) * batchLanes + std::size_t(lane)];
  return u;
}

Eigen::MatrixXd LoadBatch::unknownsOf(int lane) const {
  Eigen::MatrixXd x(model_.mesh().unknowns(), model_.mesh().elements());
  for (int e = 0; e < model_.mesh().elements(); ++e)
    for (int k = 0; k < model_.mesh().unknowns(); ++k) x(k, e) = unknown(e, k, lane);
  return x;
}

void LoadBatch::catchUp(int block) {
  if (!behind_[block]) return;
  for (int e = 0; e < model_.mesh().elements(); ++e)
    if (!probed_[e]) updateUnknowns(e, block);
  behind_[block] = false;
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
  iterate(active, change, {}, FactorPath({}, {}), {}, stop);
}

void LoadBatch::iterate(const std::array<bool, batchLanes>& active, std::array<double, batchLanes>& change,
                        std::span<const int> nodes, const FactorPath& path, const Answer& answer,
                        const std::stop_token& stop) {
  std::array<bool, blocks> live{};
  for (int lane = 0; lane < batchLanes; ++lane) live[lane / lanes] = live[lane / lanes] || active[lane];
  for (int b = 0; b < blocks; ++b)
    if (!live[b]) catchUp(b); // before other directions take the place of its own
  startAnew();
  const std::vector<WatchedValues> before = watchedNow();
  evaluateResiduals(live, stop);
  scaleResiduals(active);
  const FactorPath::Range all{0, model_.factor().count};
  substitute(Direction::Forward, all, stop);
  if (answer) substituteAlong(path, active, nodes, answer, stop);
  substitute(Direction::Backward, all, stop);
  moveAlongDirections();
  for (int e = 0; e < model_.mesh().elements(); ++e)
    for (int b = 0; b < blocks; ++b)
      if (probed_[e] && live[b]) updateUnknowns(e, b);
  for (int b = 0; b < blocks; ++b) behind_[b] = behind_[b] || live[b];
  const std::vector<WatchedValues> after = watchedNow();
  std::array<double, batchLanes> largest{};
  for (std::size_t k = 0; k < after.size(); ++k)
    growToRelativeChange(before[k].values, after[k].values, after[after[k].relativeTo].values, after[k].floor, largest);
  for (int lane = 0; lane < batchLanes; ++lane)
    if (active[lane]) change[lane] = smallestJ_[lane] > 0 && std::isfinite(largest[lane]) ? largest[lane] : -1;
}

std::vector<LoadBatch::WatchedValues> LoadBatch::watchedNow() const {
  std::vector<WatchedValues> all;
  all.push_back({displacementsAt(upper_), 0, 0});
  if (watched_.lower) all.push_back({displacementsAt(lower_), 0, 0});
  if (watched_.pressures_MPa > 0) all.push_back({pressuresAt(upper_), all.size(), watched_.pressures_MPa});
  if (watched_.block) all.push_back({u_, all.size(), 0});
  return all;
}

std::vector<ElectrodeDisplacements> LoadBatch::electrodes(int block) const {
  const LaneVector up = displacementsAt(upper_), low = displacementsAt(lower_), pressure = pressuresAt(upper_);
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
