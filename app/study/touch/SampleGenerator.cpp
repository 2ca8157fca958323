#include "app/study/touch/SampleGenerator.h"

#include "io/DesignFile.h"
#include "model/DesignError.h"
#include "model/base/Cancelled.h"
#include "model/base/CounterRandom.h"
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
    throw DesignError("areas: '" + areas + "'; allowed is each, together or an area from 0 to " +
                      std::to_string(count - 1));
  return area;
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
    throw DesignError("per-area: " + std::to_string(request_.perArea) + "; allowed is 1 to " +
                      std::to_string(kMostPerArea));
  if (request_.touches) {
    if (const auto wrong = whyInvalid(*request_.touches, design_)) throw DesignError("touches: " + *wrong);
    if (request_.surrogate) throw DesignError("surrogate: touches have none; only forces on whole areas do");
    request_.areas = "touches";
    origin_.touches = inWords(*request_.touches);
  } else {
    onlyArea_ = onlyArea(request_.areas, design_.areas.count());
  }
  origin_.designFingerprint = designFingerprint(design_);
  if (const FieldLaw* field = design_.field()) origin_.readout = field->readout;
  origin_.seed = request_.seed;
  origin_.areas = request_.areas;
  origin_.perArea = request_.perArea;
  origin_.solverTolerance = request_.relativeTolerance;
  origin_.surrogate = request_.surrogate;
}

std::size_t SampleGenerator::total() const {
  const bool every = request_.areas == "each";
  return static_cast<std::size_t>(request_.perArea) * static_cast<std::size_t>(every ? design_.areas.count() : 1);
}

LoadCase SampleGenerator::load(std::size_t i) const {
  LoadCase load;
  const auto perArea = static_cast<std::size_t>(request_.perArea);
  if (request_.touches) {
    load.indenters.push_back(touchAt(*request_.touches, request_.seed, i));
  } else if (request_.areas == "together") {
    for (int area = 0; area < design_.areas.count(); ++area)
      load.areas.push_back({area, force_N(design_.forceRange, request_.seed, area, i)});
  } else {
    const int area = onlyArea_.value_or(static_cast<int>(i / perArea));
    load.areas.push_back({area, force_N(design_.forceRange, request_.seed, area, i % perArea)});
  }
  return load;
}

/// Parts are solved side by side and share the threads, as many at a time as there are threads; the last of them, where
/// they are fewer, have all threads among them.
int SampleGenerator::partsBeside(std::size_t index) const {
  const auto threads = static_cast<std::size_t>(threadCount(request_.threads)), last = parts_.size() % threads;
  return static_cast<int>(index < parts_.size() - last ? threads : last);
}

bool SampleGenerator::prepare(Part& part, bool checked, const std::stop_token& stop) {
  if (part.solver) return true;
  MeshOptions options = request_.mesh;
  const int beside = partsBeside(static_cast<std::size_t>(&part - parts_.data()));
  BatchOptions batch{request_.relativeTolerance, request_.surrogate, threadCount(request_.threads) / beside};
  batch.checkFirst = checked;
  if (part.touches) {
    options = meshForPart(design_, *part.touches, options);
    if (parts_.size() > 1 || part.touches->shape != IndenterShape::Plane)
      batch.touched = touchedByTouches(design_, *part.touches, options);
  }
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

/// All that the head of the file says; touches' meshes are made when they are needed.
bool SampleGenerator::prepare(const std::stop_token& stop) {
  if (parts_.empty()) {
    if (request_.touches)
      for (const TouchRange& part : partsOfTouches(design_, *request_.touches, request_.mesh, &cuts_))
        parts_.emplace_back().touches = part;
    else
      parts_.resize(1);
  }
  if (parts_.size() > 1) {
    const MeshOptions mesh = meshForPart(design_, *parts_.front().touches, request_.mesh);
    requireMeshable(design_, mesh);
    const double factor = mesh.meshSize_mm.value_or(standardMeshSize_mm(design_)) / standardMeshSize_mm(design_);
    origin_.mesh = "P2+bubble/P1d, " + std::to_string(parts_.size()) + " meshes of cells of " +
                   text(std::round(1000 * factor * mesh.zones.front().size_mm.minCoeff()) / 1000) +
                   " mm where their share of the touches is";
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
  const int first = onlyArea_.value_or(0), count = onlyArea_ ? 1 : design_.areas.count();
  const int together = std::min(threadCount(request_.threads), kMostAreasTogether);
  for (int k = 0; k < count; k += together) {
    std::vector<int> areas(static_cast<std::size_t>(std::min(together, count - k)));
    std::iota(areas.begin(), areas.end(), first + k);
    if (fitting_) fitting_(static_cast<std::size_t>(k), static_cast<std::size_t>(count));
    if (!part.solver->fitSurrogates(areas, stop) || (part.field && !part.field->fitSurrogates(areas, stop)))
      return false;
  }
  return true;
}

void SampleGenerator::setSeed(std::uint64_t seed) {
  request_.seed = origin_.seed = seed;
}

void SampleGenerator::Part::giveBack() {
  if (solver) {
    solves += solver->solves();
    leftToNewton += solver->leftToNewton();
    measuredError = std::max({measuredError, solver->measuredError(), field ? field->surrogateError() : 0});
  }
  field.reset();
  solver.reset();
  problem.reset();
}

double SampleGenerator::measuredError() const {
  double error = 0;
  for (const Part& part : parts_)
    error = std::max({error, part.measuredError, part.solver ? part.solver->measuredError() : 0,
                      part.field ? part.field->surrogateError() : 0});
  return error;
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

std::size_t SampleGenerator::partOf(const LoadCase& load) const {
  if (parts_.size() == 1) return 0;
  const Eigen::Vector2d from_mm = load.indenters.front().place_mm - request_.touches->low_mm;
  const Eigen::Vector2d extent_mm = request_.touches->high_mm - request_.touches->low_mm;
  std::array<int, 2> at{};
  for (int d = 0; d < 2; ++d)
    if (cuts_[d] > 1) at[d] = std::clamp(static_cast<int>(from_mm(d) / extent_mm(d) * cuts_[d]), 0, cuts_[d] - 1);
  return static_cast<std::size_t>(at[1] * cuts_[0] + at[0]);
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

/// Parts with the most touches come first, so that the threads end together; the last block's give their memory back as
/// they are done.
ConductionBatch::Answers SampleGenerator::answers(const SampleRange& part, bool last,
                                                  const std::function<void(std::size_t)>& progress,
                                                  const std::stop_token& stop) {
  std::vector<LoadCase> loads;
  for (std::size_t i = part.first; i < part.last; ++i) loads.push_back(load(i));
  if (parts_.size() == 1) return answers(parts_.front(), loads, progress, stop, part.first);
  std::vector<std::vector<std::size_t>> ofParts(parts_.size());
  for (std::size_t i = 0; i < loads.size(); ++i) ofParts[partOf(loads[i])].push_back(i);
  ConductionBatch::Answers all{std::vector<ElectrodeDisplacements>(loads.size()),
                               std::vector<Eigen::MatrixXd>(loads.size())};
  std::map<int, std::vector<std::size_t>, std::greater<>> inWork; // by how many are solved side by side
  for (std::size_t p = 0; p < parts_.size(); ++p)
    if (!ofParts[p].empty()) inWork[partsBeside(p)].push_back(p);
  for (auto& [beside, some] : inWork)
    std::stable_sort(some.begin(), some.end(),
                     [&](std::size_t a, std::size_t b) { return ofParts[a].size() > ofParts[b].size(); });
  const bool first = std::none_of(parts_.begin(), parts_.end(), [](const Part& p) { return p.solver || p.solves > 0; });
  std::size_t done = 0;
  ProgressRelay relay([&](std::size_t more) { progress(done += more); });
  std::atomic<bool> whole = true;
  const std::size_t checked = inWork.begin()->second.front();
  for (const auto& [beside, some] : inWork)
    inParallel(some.size(), beside, [&, &parts = some](std::size_t k) {
      const std::size_t p = parts[k];
      if (!answerPart(p, first && p == checked, loads, part.first, ofParts[p], relay, stop, all)) whole = false;
      if (last) parts_[p].giveBack();
    });
  for (Part& p : parts_) stages_.add(std::exchange(p.stages, {}));
  return whole ? std::move(all) : ConductionBatch::Answers{};
}

bool SampleGenerator::answerPart(std::size_t index, bool checked, std::span<const LoadCase> loads,
                                 std::size_t firstNumber, std::span<const std::size_t> own, ProgressRelay& progress,
                                 const std::stop_token& stop, ConductionBatch::Answers& all) {
  Part& part = parts_[index];
  if (!prepare(part, checked, stop)) return false;
  std::vector<LoadCase> some;
  std::vector<std::size_t> numbers;
  for (const std::size_t i : own) {
    some.push_back(loads[i]);
    numbers.push_back(firstNumber + i);
  }
  part.solver->nameLoads(std::move(numbers));
  std::size_t done = 0;
  ConductionBatch::Answers found = answers(
      part, some, [&](std::size_t solved) { progress.add(solved - std::exchange(done, solved)); }, stop, 0);
  part.solver->rest();
  if (found.displacements.size() < own.size()) return false;
  for (std::size_t k = 0; k < own.size(); ++k) {
    all.displacements[own[k]] = std::move(found.displacements[k]);
    all.resistances_ohm[own[k]] = std::move(found.resistances_ohm[k]);
  }
  return true;
}

ConductionBatch::Answers SampleGenerator::answers(Part& part, std::span<const LoadCase> loads,
                                                  const std::function<void(std::size_t)>& progress,
                                                  const std::stop_token& stop, std::size_t firstNumber) const {
  if (part.field) return part.field->solve(loads, progress, stop, firstNumber);
  ConductionBatch::Answers result{part.solver->solve(loads, progress, stop, firstNumber), {}};
  for (const ElectrodeDisplacements& moved : result.displacements)
    result.resistances_ohm.push_back(rowColumnResistances(design_, moved));
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
  set.displacements_mm.resize(3 * design_.upper.electrodes(), count);
  set.resistances_ohm.resize(set.rowWires * set.columnWires, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const LoadCase load = this->load(range.first + static_cast<std::size_t>(i));
    if (request_.touches) {
      const Indenter& pressing = load.indenters[0];
      set.area(i) = areaUnder(design_, pressing.place_mm);
      set.touches.col(i) << static_cast<double>(pressing.shape), pressing.radius_mm, pressing.friction,
          pressing.place_mm;
      set.forces_N.col(i) = pressing.press()->force_N;
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
