#include "app/study/touch/SampleGenerator.h"

#include "app/study/Version.h"
#include "io/DesignFile.h"
#include "model/DesignError.h"
#include "model/base/Cancelled.h"
#include "model/base/CounterRandom.h"
#include "model/base/GotExpected.h"
#include "model/base/Parallel.h"
#include "model/base/ProgressRelay.h"
#include "model/base/Text.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <utility>

namespace palp {

namespace {

constexpr std::size_t kBlock = 192;       // samples solved before they are handed out: about a second of work
constexpr std::size_t kFieldBlock = 64;   // the same where each has a conduction field of its own
constexpr std::size_t kBlocksOfParts = 4; // as many where each mesh solves its part of them
constexpr std::size_t kSurrogateBlock = 8192;
constexpr int kMostAreasTogether = 4; // in fits of surrogates
constexpr int kMostPerArea = 10'000'000;
constexpr int kMostRedraws = 20;

Eigen::Vector3d force_N(const ForceRange& range, std::uint64_t seed, int area, std::size_t sample) {
  Eigen::Vector3d force;
  for (int axis = 0; axis < 3; ++axis)
    force(axis) = range.low_N(axis) +
                  (range.high_N(axis) - range.low_N(axis)) *
                      uniformAt(seed, static_cast<std::uint64_t>(area), sample, static_cast<std::uint64_t>(axis));
  return force;
}

/// The number of one area, or none for `each` and `together`.
std::optional<int> onlyArea(const std::string& areas, int count) {
  if (areas == "each" || areas == "together") return {};
  int area = -1;
  const auto [end, error] = std::from_chars(areas.data(), areas.data() + areas.size(), area);
  if (error != std::errc{} || end != areas.data() + areas.size() || area < 0 || area >= count)
    throw DesignError(
        "areas: " + gotExpected(quotedText(areas), "each, together or an area from 0 to " + std::to_string(count - 1)));
  return area;
}

Eigen::Vector<double, kTouchRows> asRows(const Indenter& touch) {
  Eigen::Vector<double, kTouchRows> rows;
  rows << static_cast<double>(touch.shape), touch.radius_mm, touch.friction, touch.place_mm;
  return rows;
}

} // namespace

SampleRange shard(std::size_t total, int index, int count) {
  const auto i = static_cast<std::size_t>(index);
  const auto n = static_cast<std::size_t>(count);
  return {total * (i - 1) / n, total * i / n};
}

SampleGenerator::SampleGenerator(SensorDesign design, SampleRequest request)
    : design_(std::move(design)), request_(std::move(request)) {
  requireValid(design_);
  if (request_.perArea < 1 || request_.perArea > kMostPerArea)
    throw DesignError("per-area: " +
                      gotExpected(std::to_string(request_.perArea), "1 to " + std::to_string(kMostPerArea)));
  if (request_.touches) {
    if (const auto wrong = whyInvalid(*request_.touches, design_)) throw DesignError("touches: " + *wrong);
    if (request_.surrogate) throw DesignError("surrogate: " + gotExpected("touches", "forces on complete areas"));
    request_.areas = "touches";
    origin_.touches = inWords(*request_.touches);
    if (request_.touches->atOnce == 1) symmetry_ = SymmetryReduction(design_, *request_.touches);
    solved_ = symmetry_.of(*request_.touches);
  } else {
    onlyArea_ = onlyArea(request_.areas, design_.areas.count());
    // Eq. (1) pays little for a surrogate, and its samples are as they were to the last byte.
    if (request_.surrogate && request_.areas != "together" && design_.field()) symmetry_ = SymmetryReduction(design_);
  }
  origin_.designFingerprint = designFingerprint(design_);
  if (const FieldLaw* field = design_.field()) origin_.readout = field->readout;
  origin_.seed = request_.seed;
  origin_.areas = request_.areas;
  origin_.perArea = request_.perArea;
  origin_.solverTolerance = request_.relativeTolerance;
  origin_.surrogate = request_.surrogate;
  origin_.madeBy = programHere();
}

std::size_t SampleGenerator::total() const {
  const bool every = request_.areas == "each";
  return static_cast<std::size_t>(request_.perArea) * static_cast<std::size_t>(every ? design_.areas.count() : 1);
}

LoadCase SampleGenerator::load(std::size_t i) const {
  LoadCase load;
  const auto perArea = static_cast<std::size_t>(request_.perArea);
  if (request_.touches) {
    load.indenters = touchesAt(*request_.touches, request_.seed, i, redrawnTimes(i));
  } else if (request_.areas == "together") {
    for (int area = 0; area < design_.areas.count(); ++area)
      load.areas.push_back({area, force_N(design_.forceRange, request_.seed, area, i)});
  } else {
    const int area = onlyArea_.value_or(static_cast<int>(i / perArea));
    load.areas.push_back({area, force_N(design_.forceRange, request_.seed, area, i % perArea)});
  }
  return load;
}

MeshOptions SampleGenerator::meshOf(const Part& part) const {
  if (!part.touches) return request_.mesh;
  return part.touches->atOnce == 1 ? meshForPart(design_, *part.touches, request_.mesh)
                                   : meshForTouches(design_, *part.touches, request_.mesh);
}

MeshOptions SampleGenerator::meshing() {
  split();
  return meshOf(parts_.front());
}

bool SampleGenerator::prepare(Part& part, bool checked, const std::stop_token& stop) {
  if (part.solver) return true;
  const MeshOptions options = meshOf(part);
  const int concurrent = concurrentParts(static_cast<std::size_t>(&part - parts_.data()));
  BatchOptions batch{request_.relativeTolerance, request_.surrogate, threadCount(request_.threads) / concurrent};
  batch.checkFirst = checked;
  batch.skipFailed = request_.touches.has_value();
  if (part.touches && (parts_.size() > 1 || part.touches->shape != IndenterShape::Plane))
    batch.touched = touchedByTouches(design_, *part.touches, options);
  Mesh mesh;
  try {
    mesh = part.stages.measure("mesh", [&] { return sensorMesh(design_, options, stop); });
  } catch (const Cancelled&) {
    return false;
  }
  part.stages.measure("factorise", [&] {
    part.problem = std::make_unique<HyperelasticProblem>(design_, std::move(mesh));
    part.solver = std::make_unique<BatchSolver>(*part.problem, batch);
    if (design_.field()) part.field = std::make_unique<ConductionBatch>(*part.problem, *part.solver, batch);
  });
  return true;
}

void SampleGenerator::split() {
  if (!parts_.empty()) return;
  if (request_.touches && request_.touches->atOnce == 1) {
    for (const TouchRange& part : partsOfTouches(design_, solved_, request_.mesh, &cuts_))
      parts_.emplace_back().touches = part;
  } else { // two touches together are in no part alone
    parts_.resize(1);
    parts_.front().touches = request_.touches;
  }
}

/// All of the head of the file; touches' meshes are made when they are needed.
bool SampleGenerator::prepare(const std::stop_token& stop) {
  split();
  if (parts_.size() > 1) {
    const MeshOptions mesh = meshForPart(design_, *parts_.front().touches, request_.mesh);
    requireMeshable(design_, mesh);
    const double factor = mesh.meshSize_mm.value_or(standardMeshSize_mm(design_)) / standardMeshSize_mm(design_);
    origin_.mesh = "P2+bubble/P1d, " + std::to_string(parts_.size()) + " meshes of cells of " +
                   text(std::round(1000 * factor * mesh.zones.front().size_mm.minCoeff()) / 1000) +
                   " mm where their share of the touches" + (symmetry_.empty() ? " is" : " and their mirror images is");
    return !stop.stop_requested();
  }
  Part& part = parts_.front();
  if (!prepare(part, true, stop)) return false;
  stages_.add(std::exchange(part.stages, {}));
  origin_.mesh = part.problem->elementType() + ", " + std::to_string(part.problem->mesh().elementCount()) +
                 " elements, " + std::to_string(part.problem->mesh().nodeCount()) + " nodes";
  // All loads together are more than the surrogates of single areas can answer.
  if (!fitted_ && request_.surrogate && request_.areas != "together") {
    fitted_ = stages_.measure("surrogate", [&] { return fitSurrogates(stop); });
    if (!fitted_) return false;
    origin_.surrogateError = std::max(part.solver->surrogateError(), part.field ? part.field->surrogateError() : 0);
  }
  return true;
}

/// As many areas together as there are threads, as the predictor of an area is one thread's work and much memory.
bool SampleGenerator::fitSurrogates(const std::stop_token& stop) {
  Part& part = parts_.front();
  std::vector<int> wanted(static_cast<std::size_t>(onlyArea_ ? 1 : design_.areas.count()));
  std::iota(wanted.begin(), wanted.end(), onlyArea_.value_or(0));
  const std::vector<int> all = symmetry_.of(wanted);
  const auto together = static_cast<std::size_t>(std::min(threadCount(request_.threads), kMostAreasTogether));
  for (std::size_t k = 0; k < all.size(); k += together) {
    const std::span<const int> areas = std::span(all).subspan(k, std::min(together, all.size() - k));
    if (fitting_) fitting_(k, all.size());
    if (!part.solver->fitSurrogates(areas, stop) || (part.field && !part.field->fitSurrogates(areas, stop)))
      return false;
  }
  return true;
}

void SampleGenerator::setSeed(std::uint64_t seed) {
  request_.seed = origin_.seed = seed;
  redraws_.clear();
}

double SampleGenerator::measuredError() const {
  double error = 0;
  for (const Part& part : parts_)
    error = std::max({error, part.measuredError.value_or(0), part.solver ? part.solver->measuredError().value_or(0) : 0,
                      part.field ? part.field->surrogateError() : 0});
  return error;
}

bool SampleGenerator::errorMeasured() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const Part& part) {
    return part.measuredError || (part.solver && part.solver->measuredError());
  });
}

std::string SampleGenerator::doubts() const {
  std::vector<std::string> all;
  for (const Part& part : parts_) {
    all.insert(all.end(), part.doubts.begin(), part.doubts.end());
    if (part.solver) all.insert(all.end(), part.solver->nonUniqueLoads().begin(), part.solver->nonUniqueLoads().end());
  }
  if (all.empty()) return {};
  return (all.size() == 1 ? "" : std::to_string(all.size()) + " of the checked loads; the first: ") + all.front() +
         "; with friction, a mesh too coarse for the contact has several solutions: choose a finer mesh";
}

std::size_t SampleGenerator::solves() const {
  std::size_t all = 0;
  for (const Part& part : parts_) all += part.solves + (part.solver ? part.solver->solves() : 0);
  return all;
}

std::size_t SampleGenerator::leftToNewton() const {
  std::size_t all = 0;
  for (const Part& part : parts_) all += part.leftToNewton + (part.solver ? part.solver->leftToNewton() : 0);
  return all;
}

std::size_t SampleGenerator::samplesABlock() const {
  if (request_.surrogate) return kSurrogateBlock;
  return (design_.field() ? kFieldBlock : kBlock) * (parts_.size() > 1 ? kBlocksOfParts : 1);
}

const SampleOrigin& SampleGenerator::origin() {
  prepare();
  return origin_;
}

SampleSet SampleGenerator::emptySet(const std::stop_token& stop) {
  prepare(stop);
  return block({0, 0}, {});
}

std::size_t SampleGenerator::generate(SampleRange range, const std::function<void(const SampleSet&)>& take,
                                      const std::function<void(std::size_t)>& progress, const std::stop_token& stop) {
  if (stop.stop_requested() || !prepare(stop)) return 0;
  const std::size_t most = samplesABlock();
  std::size_t done = range.first;
  while (done < range.last && !stop.stop_requested()) {
    const SampleRange part{done, std::min(range.last, done + most)};
    const auto found = stages_.measure("sample", [&] {
      return answers(
          part, part.last == range.last,
          [&](std::size_t solved) {
            if (progress) progress(done - range.first + solved);
          },
          stop);
    });
    if (found.displacements.size() < part.last - part.first) break; // cancelled
    take(block(part, found));
    done = part.last;
  }
  return done - range.first;
}

ConductionBatch::Answers SampleGenerator::answers(const SampleRange& part, bool last,
                                                  const std::function<void(std::size_t)>& progress,
                                                  const std::stop_token& stop) {
  std::vector<std::size_t> numbers(part.last - part.first);
  std::iota(numbers.begin(), numbers.end(), part.first);
  const auto answersTo = [&](const std::vector<std::size_t>& some, const std::function<void(std::size_t)>& solved) {
    std::vector<LoadCase> loads;
    for (const std::size_t i : some) loads.push_back(load(i));
    ConductionBatch::Answers found = answers(symmetry_.of(loads), some, last, solved, stop);
    symmetry_.mapBack(loads, found);
    return found;
  };
  ConductionBatch::Answers all = answersTo(numbers, progress);
  while (true) {
    std::vector<std::size_t> open;
    for (std::size_t k = 0; k < all.displacements.size(); ++k)
      if (all.displacements[k].upper_mm.size() == 0) open.push_back(part.first + k);
    if (open.empty()) return all;
    for (const std::size_t i : open) redraw(i);
    ConductionBatch::Answers more = answersTo(open, {});
    if (more.displacements.size() < open.size()) return {};
    for (std::size_t k = 0; k < open.size(); ++k) {
      all.displacements[open[k] - part.first] = std::move(more.displacements[k]);
      all.resistances_ohm[open[k] - part.first] = std::move(more.resistances_ohm[k]);
    }
  }
}

int SampleGenerator::redrawnTimes(std::size_t number) const {
  const auto times = redraws_.find(number);
  return times == redraws_.end() ? 0 : times->second;
}

void SampleGenerator::redraw(std::size_t number) {
  if (++redraws_[number] > kMostRedraws)
    throw ConvergenceError("touch " + whyRedrawn_ + "; " + std::to_string(kMostRedraws) +
                           " replacements had no equilibrium either; expected ranges of positions and forces in which "
                           "most touches have one");
  ++redrawn_;
}

ConductionBatch::Answers SampleGenerator::answers(Part& part, const std::vector<LoadCase>& loads,
                                                  const std::vector<std::size_t>& numbers,
                                                  const std::function<void(std::size_t)>& progress,
                                                  const std::stop_token& stop) {
  if (request_.touches) part.solver->nameLoads(numbers);
  ConductionBatch::Answers result;
  if (part.field)
    result = part.field->solve(loads, progress, stop, numbers.front());
  else
    result.displacements = part.solver->solve(loads, progress, stop, numbers.front());
  for (std::size_t k = 0; k < result.displacements.size() && !part.field; ++k) {
    const ElectrodeDisplacements& moved = result.displacements[k];
    result.resistances_ohm.push_back(moved.upper_mm.size() > 0 ? rowColumnResistances(design_, moved)
                                                               : Eigen::MatrixXd());
  }
  if (const auto& left = part.solver->failedLoads(); !left.empty()) {
    const std::lock_guard lock(guard_);
    if (whyRedrawn_.empty() || std::stoull(left.front()) < std::stoull(whyRedrawn_)) whyRedrawn_ = left.front();
  }
  return result;
}

SampleSet SampleGenerator::block(SampleRange range, const ConductionBatch::Answers& answers) const {
  const auto count = static_cast<Eigen::Index>(range.last - range.first);
  SampleSet set;
  set.origin = origin_;
  set.rowWires = design_.rowWires();
  set.electrodesPerRowWire = design_.electrodesPerRowWire();
  set.columnWires = design_.columnWires();
  set.areaCount = design_.areas.count();
  const bool together = request_.areas == "together";
  set.area.resize(count);
  set.forces_N.resize(together ? 3 * set.areaCount : 3, count);
  set.touches.resize(request_.touches ? kTouchRows : 0, count);
  set.secondTouch.resize(request_.touches && request_.touches->atOnce > 1 ? kSecondTouchRows : 0, count);
  set.displacements_mm.resize(3 * design_.upper.electrodes(), count);
  set.resistances_ohm.resize(set.rowWires * set.columnWires, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const LoadCase load = this->load(range.first + static_cast<std::size_t>(i));
    if (request_.touches) {
      const Indenter& pressing = load.indenters[0];
      set.area(i) = areaUnder(design_, pressing.place_mm);
      set.touches.col(i) = asRows(pressing);
      set.forces_N.col(i) = pressing.press()->force_N;
      if (load.indenters.size() > 1)
        set.secondTouch.col(i) << asRows(load.indenters[1]), load.indenters[1].press()->force_N;
    } else {
      set.area(i) = together ? -1 : load.areas[0].area;
    }
    for (std::size_t a = 0; a < load.areas.size(); ++a)
      set.forces_N.block<3, 1>(3 * static_cast<Eigen::Index>(a), i) = load.areas[a].force_N;
    set.displacements_mm.col(i) = answers.displacements[static_cast<std::size_t>(i)].upper_mm.reshaped();
    set.resistances_ohm.col(i) = answers.resistances_ohm[static_cast<std::size_t>(i)].reshaped<Eigen::RowMajor>();
  }
  return set;
}

} // namespace palp
