#include "solver/batch/LoadBatch.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace palp {

namespace {

using ElementLanes = std::array<double, largestElementDofs * lanes>;

std::size_t at(std::size_t row, int block) {
  return row * batchColumns + std::size_t(block) * lanes;
}

/// Prefetches a block's values at an element's nodes, in [3 nodes][32]: they are scattered over an array larger than
/// the caches. Does nothing past the last element.
inline void prefetch(const ElementwiseTangent& model, int place, int block, const double* values) {
  if (place >= model.mesh().elements()) return;
  for (int n = 0; n < model.mesh().kernels().nodes; ++n)
    for (int d = 0; d < 3; ++d) __builtin_prefetch(values + at(3 * std::size_t(model.nodes(place)[n]) + d, block));
}

/// The same for the directions [rows of the factor + 1][32].
inline void prefetch(const ElementwiseTangent& model, int place, int block, const float* directions) {
  if (place >= model.mesh().elements()) return;
  for (int n = 0; n < model.mesh().kernels().nodes; ++n)
    for (int d = 0; d < 3; ++d)
      __builtin_prefetch(directions +
                         at(std::size_t(model.factorRows()[3 * std::size_t(model.nodes(place)[n]) + d]), block));
}

/// Raises `largest` to each column's change relative to its size (and to `floor` per number); NaN stays NaN.
void growToRelativeChange(const LaneVector& before, const LaneVector& after, const LaneVector& size, double floor,
                          std::array<double, batchColumns>& largest) {
  std::array<double, batchColumns> difference{}, norm{};
  for (std::size_t i = 0; i < after.size(); ++i)
    difference[i % batchColumns] += (after[i] - before[i]) * (after[i] - before[i]);
  for (std::size_t i = 0; i < size.size(); ++i) norm[i % batchColumns] += size[i] * size[i] + floor * floor;
  for (int column = 0; column < batchColumns; ++column) {
    const double relative = norm[column] == 0 ? 0 : std::sqrt(difference[column] / norm[column]);
    if (!(relative <= largest[column])) largest[column] = relative;
  }
}

} // namespace

LoadBatch::LoadBatch(const ElementwiseTangent& model, const PointProbe& upper, const PointProbe& lower, Watched watched)
    : model_(model), upper_(upper), lower_(lower), watched_(watched),
      u_(3 * std::size_t(model.mesh().nodes()) * batchColumns), r_(u_.size()),
      x_(std::size_t(model.mesh().elements()) * model.mesh().unknowns() * batchColumns), local_(x_.size()),
      solution_(std::size_t(model.rightSideRows()) * batchColumns), probed_(model.mesh().elements()) {
  for (const PointProbe* probe : {&upper_, &lower_})
    for (const auto& hosts : probe->hosts())
      for (const PointProbe::Host& host : hosts) probed_[model.placeOf(host.element)] = 1;
}

void LoadBatch::reset(int block, bool inSingle) {
  const std::size_t own = std::size_t(model_.mesh().unknowns()) * lanes;
  for (std::size_t row = 0; row < 3 * std::size_t(model_.mesh().nodes()); ++row)
    std::fill_n(u_.data() + at(row, block), lanes, 0.);
  for (std::size_t e = 0; e < std::size_t(model_.mesh().elements()); ++e)
    std::fill_n(x_.data() + (e * blocks + block) * own, own, 0.);
  for (int column = block * lanes; column < (block + 1) * lanes; ++column) {
    forces_[column].clear();
    nodeForces_[column].clear();
    atRest_[column] = true;
    if (mixing_) mixing_->begin(column, false);
  }
  guesses_[block] = {};
  begins_[block] = stale_[block] = false;
  inSingle_[block] = inSingle;
}

void LoadBatch::mix(int column, bool inSingle) {
  const int block = column / lanes;
  if (!mixing_) {
    for (int b = 0; b < blocks; ++b) updateInternal(b); // while there is no mixing yet
    mixing_ = std::make_unique<AndersonBatch>(3 * std::size_t(model_.mesh().nodes()),
                                              std::size_t(model_.mesh().elements()) * model_.mesh().unknowns(),
                                              model_.mesh().unknowns());
    uBefore_.resize(u_.size());
    xBefore_.resize(x_.size());
  }
  mixing_->begin(column, true);
  forces_[column].clear();
  nodeForces_[column].clear();
  atRest_[column] = true;
  inSingle_[block] = inSingle;
  InitialGuess& guess = guesses_[block];
  guess.begins[column % lanes] = guess.atRest[column % lanes] = -1;
  guess.ahead[column % lanes] = 0;
  begins_[block] = true;
}

void LoadBatch::continueWith(int column, bool extrapolate) {
  assert(mixing_ && column >= 0 && column < batchColumns && "a column started with mix");
  mixing_->restart(column);
  InitialGuess& guess = guesses_[column / lanes];
  guess.begins[column % lanes] = -1;
  guess.ahead[column % lanes] = extrapolate ? -1 : 0;
  begins_[column / lanes] = true;
}

/// Pending updates are done first, so that they need not be moved.
void LoadBatch::move(int from, int to) {
  assert(mixing_ && from != to && std::min(from, to) >= 0 && std::max(from, to) < batchColumns);
  const int old = from / lanes, now = to / lanes;
  updateInternal(old);
  updateInternal(now);
  const int own = model_.mesh().unknowns();
  copyColumn(u_.data(), u_.size(), 1, from, to);
  copyColumn(uBefore_.data(), uBefore_.size(), 1, from, to);
  copyColumn(x_.data(), x_.size(), own, from, to);
  copyColumn(xBefore_.data(), xBefore_.size(), own, from, to);
  mixing_->copy(from, to);
  forces_[to] = std::exchange(forces_[from], {});
  nodeForces_[to] = std::exchange(nodeForces_[from], {});
  atRest_[to] = atRest_[from];
  for (const auto masks : {&InitialGuess::begins, &InitialGuess::atRest, &InitialGuess::ahead})
    (guesses_[now].*masks)[to % lanes] = std::exchange((guesses_[old].*masks)[from % lanes], 0);
  begins_[now] = begins_[now] || begins_[old];
}

bool LoadBatch::isAtRest(int block) const {
  const auto first = atRest_.begin() + block * lanes;
  return std::find(first, first + lanes, false) == first + lanes;
}

/// Sets the values of columns at rest to exactly 0, without rounding errors.
void LoadBatch::zeroAtRest(int block, double* values, int count) const {
  for (int lane = 0; lane < lanes; ++lane)
    if (atRest_[block * lanes + lane])
      for (int i = 0; i < count; ++i) values[i * lanes + lane] = 0;
}

/// Lanes that begin another load: their displacements, and the unknowns that are up to date.
void LoadBatch::beginLoads() {
  for (int b = 0; b < blocks; ++b) {
    if (!begins_[b]) continue;
    laneKernels().beginLoads(u_.data() + b * lanes, uBefore_.data() + b * lanes, 3 * model_.mesh().nodes(),
                             batchColumns, guesses_[b]);
    for (int e = 0; e < model_.mesh().elements(); ++e)
      if (probed_[e]) beginLoads(e, b);
  }
}

void LoadBatch::beginLoads(int place, int block) {
  const std::size_t own = ownStart(place, block);
  laneKernels().beginLoads(x_.data() + own, xBefore_.data() + own, model_.mesh().unknowns(), lanes, guesses_[block]);
}

void LoadBatch::addPolynomials(int block, const std::vector<double>& displacements, const std::vector<double>& unknowns,
                               int terms, const double* monomials) {
  std::fill_n(atRest_.begin() + block * lanes, lanes, false);
  const auto& kernels = laneKernels();
  kernels.addPolynomials(displacements.data(), terms, monomials, 3 * model_.mesh().nodes(), u_.data() + block * lanes,
                         batchColumns);
  const int own = model_.mesh().unknowns();
  for (int e = 0; e < model_.mesh().elements(); ++e)
    kernels.addPolynomials(unknowns.data() + std::size_t(e) * own * terms, terms, monomials, own,
                           x_.data() + ownStart(model_.placeOf(e), block), lanes);
}

/// Residuals of the live blocks. Stale internal unknowns are updated here, while the element's data are in the cache.
void LoadBatch::evaluateResiduals(const std::array<bool, blocks>& live, const std::stop_token& stop) {
  const Discretisation& mesh = model_.mesh();
  const ElementKernels& kernels = mesh.kernels();
  const LawKernels& law = kernels.of(model_.rubber());
  std::fill(r_.begin(), r_.end(), 0.);
  for (int column = 0; column < batchColumns; ++column)
    for (const auto& [shares, force_N] : forces_[column])
      for (const auto& [node, share] : *shares)
        for (int d = 0; d < 3; ++d) r_[(3 * std::size_t(node) + d) * batchColumns + column] += share * force_N(d);
  for (int column = 0; column < batchColumns; ++column)
    for (const auto& [node, force_N] : nodeForces_[column])
      for (int d = 0; d < 3; ++d) r_[(3 * std::size_t(node) + d) * batchColumns + column] += force_N(d);
  smallestJ_.fill(1);
  std::array<bool, blocks> blockAtRest{}, someAtRest{};
  for (int b = 0; b < blocks; ++b) {
    const auto first = atRest_.begin() + b * lanes;
    blockAtRest[b] = isAtRest(b);
    someAtRest[b] = !blockAtRest[b] && std::find(first, first + lanes, true) != first + lanes;
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
      if (stale_[b]) prefetch(model_, e + 1, b, solution_.data());
      if (stale_[b] && !probed_[e]) updateUnknowns(e, b);
      if (begins_[b] && !probed_[e]) beginLoads(e, b);
      if (blockAtRest[b]) {
        std::fill_n(local_.data() + own, mesh.unknowns() * lanes, 0.);
        continue;
      }
      laneKernels().gather(u_.data() + b * lanes, nodes, kernels.nodes, u.data());
      const auto residual = inSingle_[b] ? law.residualOfLoadsInSingle : law.residualOfLoads;
      residual(model_.rubber(), {model_.geometry(e), u.data(), x_.data() + own},
               {f.data(), local_.data() + own, range[b].data()});
      if (someAtRest[b]) {
        zeroAtRest(b, f.data(), 3 * kernels.nodes);
        zeroAtRest(b, local_.data() + own, mesh.unknowns());
      }
      kernels.condenseLoads(model_.elimination(e), local_.data() + own, f.data());
      laneKernels().subtract(f.data(), nodes, kernels.nodes, r_.data() + b * lanes);
    }
  }
  for (int column = 0; column < batchColumns; ++column) smallestJ_[column] = range[column / lanes][column % lanes];
  for (int b = 0; b < blocks; ++b) {
    if (!live[b]) continue;
    guesses_[b] = {};
    begins_[b] = stale_[b] = false;
    std::fill_n(atRest_.begin() + b * lanes, lanes, false);
  }
}

/// u += du, mixed where there is mixing.
void LoadBatch::moveAlongDirections() {
  const std::vector<int>& rows = model_.factorRows();
  if (mixing_) return mixing_->moveLeading(rows, solution_.data(), scale_, u_.data());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (int column = 0; column < batchColumns; ++column)
      u_[i * batchColumns + column] += scale_[column] * double(solution_[std::size_t(rows[i]) * batchColumns + column]);
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

Eigen::Matrix3Xd LoadBatch::displacementsOf(int column) const {
  return Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<batchColumns>>(u_.data() + column,
                                                                                3 * model_.mesh().nodes())
      .reshaped(3, model_.mesh().nodes());
}

Eigen::Matrix3Xd LoadBatch::displacementsOf(int column, std::span<const int> nodes) const {
  Eigen::Matrix3Xd u(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (int d = 0; d < 3; ++d)
      u(d, static_cast<Eigen::Index>(n)) =
          u_[(3 * std::size_t(nodes[n]) + std::size_t(d)) * batchColumns + std::size_t(column)];
  return u;
}

Eigen::MatrixXd LoadBatch::unknownsOf(int column) const {
  Eigen::MatrixXd x(model_.mesh().unknowns(), model_.mesh().elements());
  for (int e = 0; e < model_.mesh().elements(); ++e)
    for (int k = 0; k < model_.mesh().unknowns(); ++k) x(k, e) = unknown(e, k, column);
  return x;
}

void LoadBatch::updateInternal(int block) {
  if (!stale_[block]) return;
  for (int e = 0; e < model_.mesh().elements(); ++e)
    if (!probed_[e]) updateUnknowns(e, block);
  stale_[block] = false;
}

LaneVector LoadBatch::displacementsAt(const PointProbe& probe) const {
  LaneVector out(3 * probe.hosts().size() * batchColumns);
  for (std::size_t i = 0; i < probe.hosts().size(); ++i) {
    const PointProbe::Host& host = probe.hosts()[i].front();
    double* value = out.data() + 3 * i * batchColumns;
    for (Eigen::Index n = 0; n < host.shapes.size(); ++n) {
      const double shape = host.shapes(n);
      if (shape == 0) continue;
      const double* u =
          u_.data() + 3 * std::size_t(model_.mesh().node(host.element, static_cast<int>(n))) * batchColumns;
      for (int k = 0; k < 3 * batchColumns; ++k) value[k] += shape * u[k];
    }
    if (host.bubble != 0)
      for (int k = 0; k < 3 * batchColumns; ++k)
        value[k] += host.bubble * unknown(host.element, k / batchColumns, k % batchColumns);
  }
  return out;
}

LaneVector LoadBatch::pressuresAt(const PointProbe& probe) const {
  LaneVector out(probe.hosts().size() * batchColumns);
  for (std::size_t i = 0; i < probe.hosts().size(); ++i) {
    const auto& hosts = probe.hosts()[i];
    for (const PointProbe::Host& host : hosts) {
      const int first = model_.mesh().unknowns() - static_cast<int>(host.pressure.size());
      for (Eigen::Index k = 0; k < host.pressure.size(); ++k)
        for (int column = 0; column < batchColumns; ++column)
          out[i * batchColumns + column] -=
              host.pressure(k) * unknown(host.element, first + static_cast<int>(k), column) / double(hosts.size());
    }
  }
  return out;
}

void LoadBatch::iterate(const std::array<bool, batchColumns>& active, std::array<double, batchColumns>& change,
                        const std::stop_token& stop) {
  iterate(active, change, {}, FactorPath({}, {}), {}, stop);
}

void LoadBatch::iterate(const std::array<bool, batchColumns>& active, std::array<double, batchColumns>& change,
                        std::span<const int> nodes, const FactorPath& path, const Answer& answer,
                        const std::stop_token& stop) {
  assert((nodes.empty() || answer) && "contact nodes need their forces");
  std::array<bool, blocks> live{};
  for (int column = 0; column < batchColumns; ++column) live[column / lanes] = live[column / lanes] || active[column];
  for (int b = 0; b < blocks; ++b)
    if (!live[b]) updateInternal(b); // before the next directions overwrite its own
  beginLoads();
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
  for (int b = 0; b < blocks; ++b) stale_[b] = stale_[b] || live[b];
  const std::vector<WatchedValues> after = watchedNow();
  std::array<double, batchColumns> largest{};
  for (std::size_t k = 0; k < after.size(); ++k)
    growToRelativeChange(before[k].values, after[k].values, after[after[k].relativeTo].values, after[k].floor, largest);
  for (int column = 0; column < batchColumns; ++column)
    if (active[column])
      change[column] = smallestJ_[column] > 0 && std::isfinite(largest[column]) ? largest[column] : -1;
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
  const auto ofColumn = [](const LaneVector& values, int column) {
    return Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<batchColumns>>(
        values.data() + column, static_cast<Eigen::Index>(values.size() / batchColumns));
  };
  std::vector<ElectrodeDisplacements> all;
  for (int l = block * lanes; l < (block + 1) * lanes; ++l)
    all.push_back({ofColumn(up, l).reshaped(3, Eigen::AutoSize), ofColumn(low, l).reshaped(3, Eigen::AutoSize),
                   ofColumn(pressure, l)});
  return all;
}

} // namespace palp
