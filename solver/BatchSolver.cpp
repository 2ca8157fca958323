#include "solver/BatchSolver.h"

#include "model/DesignError.h"
#include "model/base/Parallel.h"
#include "model/base/Text.h"
#include "solver/batch/AreaSurrogate.h"
#include "solver/batch/BatchEngine.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace palp {

namespace {

constexpr std::size_t loadsACheck = 700; // the first load and one in this many is compared with full Newton
constexpr int surrogateChecks = 3;       // of surrogates, whose error their fits have already measured, over all calls
constexpr double fullNewtonResidual = 1e-11; // of the solves that answers are compared with
constexpr double fullContactResidual = 1e-9; // with indenters
constexpr double largestError = 1e-3; // difference from full Newton: a larger one is another equilibrium, not rounding

/// How a load was solved.
enum class Strategy { Surrogate, Iteration, FullNewton };

} // namespace

struct BatchSolver::State {
  HyperelasticProblem problem;
  std::size_t firstNumber = 0;      ///< of this call's loads, in messages
  std::vector<std::size_t> numbers; ///< number of each load instead, if any
  BatchOptions options;
  std::unique_ptr<BatchEngine> engine;
  std::vector<std::optional<AreaSurrogate>> surrogates;
  std::size_t fullSolves = 0, leftToNewton = 0;
  std::vector<std::string> failedLoads; ///< of this call
  std::optional<double> measuredError;
  std::vector<std::string> nonUniqueLoads;
  std::size_t loadsSeen = 0, checks; ///< over all calls
  int surrogatesChecked = 0;

  State(const HyperelasticProblem& p, BatchOptions o)
      : problem(p), options(o), surrogates(p.design().areas.count()), checks(o.checkFirst ? 0 : 1) {}

  [[nodiscard]] std::string number(std::size_t i) const {
    return std::to_string(numbers.empty() ? firstNumber + i : numbers[i]);
  }

  void requireLoads(std::span<const LoadCase> loads) const {
    for (std::size_t i = 0; i < loads.size(); ++i)
      if (const auto why = whyInvalid(loads[i], problem.design())) throw DesignError("load " + number(i) + ": " + *why);
  }

  /// Makes the engine. Returns false if cancelled.
  bool prepare(const std::stop_token& stop) {
    if (engine) return true;
    if (options.touched && canBeLast(problem.mesh(), *options.touched)) {
      auto tangent = touchedTangent(problem.block(), *options.touched, options.threads, stop);
      if (!tangent) return false;
      engine = std::make_unique<BatchEngine>(problem, std::move(*tangent), options.relativeTolerance, options.threads,
                                             *options.touched);
      return true;
    }
    auto rest = problem.block().initialTangent(options.threads, stop);
    if (!rest || stop.stop_requested()) return false;
    engine = std::make_unique<BatchEngine>(problem, std::move(rest), options.relativeTolerance, options.threads,
                                           options.touched);
    return true;
  }

  /// Solves one load by full Newton with all threads. Returns nullopt if cancelled; no electrodes if skipped as failed.
  std::optional<ElectrodeDisplacements> fullNewton(const LoadCase& load, std::size_t index, const std::stop_token& stop,
                                                   const TakeState& take = {}) {
    NewtonOptions newton;
    newton.threads = options.threads;
    newton.relativeTolerance = load.indenters.empty() ? fullNewtonResidual : fullContactResidual;
    if (engine) engine->releaseMemory(); // which the tangent needs
    newton.oneTangent = true;
    const Solution solution = problem.solve(load, newton, {.step = {}, .stop = stop});
    ++fullSolves;
    if (solution.cancelled) return {};
    if (!solution.converged) {
      const std::string why = number(index) + ": " + solution.stopReason;
      if (!options.skipFailed) throw ConvergenceError("load " + why);
      failedLoads.push_back(why);
      return ElectrodeDisplacements{};
    }
    ElectrodeDisplacements moved = problem.electrodes(solution.state());
    if (take) take(index, moved, solution.state());
    return moved;
  }

  /// Compares answers of this call with full Newton: as many as are due, spread over the call. Returns false if
  /// cancelled.
  bool check(std::span<const LoadCase> loads, const std::vector<BatchEngine::Answer>& answers,
             const std::vector<Strategy>& strategies, const std::stop_token& stop) {
    loadsSeen += loads.size();
    const std::size_t due = (loadsSeen + loadsACheck - 1) / loadsACheck, count = due - std::min(due, checks);
    checks += count;
    for (std::size_t c = 0; c < count; ++c) {
      std::size_t i = (2 * c + 1) * loads.size() / (2 * count);
      for (std::size_t k = 0; k < loads.size() && strategies[i] == Strategy::FullNewton; ++k)
        i = (i + 1) % loads.size();
      if (strategies[i] == Strategy::FullNewton) continue;
      if (strategies[i] == Strategy::Surrogate && surrogatesChecked++ >= surrogateChecks) continue;
      const auto full = fullNewton(loads[i], i, stop);
      if (!full) return false;
      if (full->upper_mm.size() == 0) { // the answer stays: whether a load has one must not depend on which are checked
        nonUniqueLoads.push_back("load " + failedLoads.back() + ", though the batch found one");
        failedLoads.pop_back();
        continue;
      }
      const double error = relativeDifference(*answers[i], *full, problem.design());
      notice(error);
      if (error > largestError && strategies[i] == Strategy::Iteration)
        nonUniqueLoads.push_back("load " + number(i) + ": full Newton's method finds another equilibrium, " +
                                 text(std::round(1000 * error) / 10) + " % away");
    }
    return true;
  }
  void notice(double error) { measuredError = std::max(measuredError.value_or(0), error); }

  bool fitSurrogates(std::span<const int> areas, const std::stop_token& stop);
  bool fromSurrogates(std::span<const LoadCase> loads, std::vector<BatchEngine::Answer>& answers,
                      const std::stop_token& stop);
};

/// Fits the missing surrogates of these areas. An area remains without one where a load of its fit has no solution.
/// Returns false if cancelled.
bool BatchSolver::State::fitSurrogates(std::span<const int> areas, const std::stop_token& stop) {
  std::vector<int> open;
  for (const int area : areas)
    if (!surrogates[area]) open.push_back(area);
  auto fits = AreaSurrogate::fit(*engine, problem.design(), open, options.relativeTolerance, stop);
  if (stop.stop_requested()) return false;
  for (std::size_t k = 0; k < open.size(); ++k) {
    if (fits[k]) notice(fits[k]->error());
    surrogates[open[k]] = std::move(fits[k]);
  }
  return true;
}

/// Evaluates the surrogates for loads on one area within the force range. Returns false if cancelled.
bool BatchSolver::State::fromSurrogates(std::span<const LoadCase> loads, std::vector<BatchEngine::Answer>& answers,
                                        const std::stop_token& stop) {
  const SensorDesign& design = problem.design();
  std::vector<std::vector<std::size_t>> byArea(surrogates.size());
  for (std::size_t i = 0; i < loads.size(); ++i)
    if (onOneArea(loads[i], design.forceRange)) byArea[loads[i].areas[0].area].push_back(i);
  for (std::size_t area = 0; area < byArea.size(); ++area) {
    const std::vector<std::size_t>& indices = byArea[area];
    if (indices.empty()) continue;
    if (!fitSurrogates(std::array{static_cast<int>(area)}, stop)) return false;
    if (!surrogates[area]) continue;
    forChunks(static_cast<int>(indices.size()), lanes, options.threads, [&](int begin, int end) {
      if (stop.stop_requested()) return;
      std::vector<Eigen::Vector3d> forces;
      for (int k = begin; k < end; ++k) forces.push_back(loads[indices[k]].areas[0].force_N);
      std::vector<ElectrodeDisplacements> some = surrogates[area]->evaluate(forces);
      for (int k = begin; k < end; ++k) answers[indices[k]] = std::move(some[k - begin]);
    });
  }
  return !stop.stop_requested();
}

BatchSolver::BatchSolver(const HyperelasticProblem& problem, BatchOptions options)
    : state_(std::make_unique<State>(problem, options)) {}
BatchSolver::~BatchSolver() = default;

std::vector<ElectrodeDisplacements> BatchSolver::solve(std::span<const LoadCase> loads,
                                                       const std::function<void(std::size_t)>& progress,
                                                       std::stop_token stop, std::size_t firstNumber) {
  return answer(loads, progress, stop, firstNumber, {});
}

std::vector<ElectrodeDisplacements> BatchSolver::solveStates(std::span<const LoadCase> loads, const TakeState& take,
                                                             const std::function<void(std::size_t)>& progress,
                                                             std::stop_token stop, std::size_t firstNumber) {
  return answer(loads, progress, stop, firstNumber, take);
}

std::vector<ElectrodeDisplacements> BatchSolver::answer(std::span<const LoadCase> loads,
                                                        const std::function<void(std::size_t)>& progress,
                                                        const std::stop_token& stop, std::size_t firstNumber,
                                                        const TakeState& take) {
  State& s = *state_;
  assert((s.numbers.empty() || s.numbers.size() == loads.size()) && "one number for each load");
  s.firstNumber = firstNumber;
  s.failedLoads.clear();
  s.requireLoads(loads);
  if (loads.empty() || !s.prepare(stop)) return {};
  std::vector<BatchEngine::Answer> answers(loads.size());
  if (s.options.surrogate && !take && !s.fromSurrogates(loads, answers, stop)) return {};
  std::vector<Strategy> strategies(loads.size(), Strategy::Surrogate);
  std::vector<LoadCase> remaining;
  std::vector<std::size_t> remainingIndices;
  for (std::size_t i = 0; i < loads.size(); ++i)
    if (!answers[i]) {
      strategies[i] = Strategy::Iteration;
      remaining.push_back(loads[i]);
      remainingIndices.push_back(i);
    }
  std::size_t done = loads.size() - remaining.size();
  const auto report = [&](std::size_t more) {
    done += more;
    if (progress) progress(done);
  };
  if (done > 0) report(0);
  // With states all loads remain, under their own numbers.
  std::vector<BatchEngine::Answer> solved = s.engine->solve(remaining, s.options.relativeTolerance, report, stop, take);
  if (stop.stop_requested()) return {};
  for (std::size_t k = 0; k < remaining.size(); ++k) answers[remainingIndices[k]] = std::move(solved[k]);
  for (std::size_t i = 0; i < loads.size(); ++i)
    if (!answers[i]) {
      strategies[i] = Strategy::FullNewton;
      answers[i] = s.fullNewton(loads[i], i, stop, take);
      if (!answers[i]) return {};
      ++s.leftToNewton;
    }
  if (!s.check(loads, answers, strategies, stop)) return {};
  std::vector<ElectrodeDisplacements> all;
  for (auto& answer : answers) all.push_back(std::move(*answer));
  return all;
}

bool BatchSolver::fitSurrogates(std::span<const int> areas, const std::stop_token& stop) {
  assert(std::all_of(areas.begin(), areas.end(),
                     [&](int area) { return area >= 0 && area < state_->problem.design().areas.count(); }));
  if (!state_->prepare(stop)) return false;
  return state_->fitSurrogates(areas, stop);
}

double BatchSolver::surrogateError() const {
  double error = 0;
  for (const auto& surrogate : state_->surrogates)
    if (surrogate) error = std::max(error, surrogate->error());
  return error;
}

void BatchSolver::releaseMemory() {
  if (state_->engine) state_->engine->releaseMemory();
}

void BatchSolver::nameLoads(std::vector<std::size_t> numbers) {
  state_->numbers = std::move(numbers);
}

const std::vector<std::string>& BatchSolver::failedLoads() const {
  return state_->failedLoads;
}

std::size_t BatchSolver::solves() const {
  return (state_->engine ? state_->engine->solves() : 0) + state_->fullSolves;
}
std::size_t BatchSolver::leftToNewton() const {
  return state_->leftToNewton;
}

std::optional<double> BatchSolver::measuredError() const {
  return state_->measuredError;
}

const std::vector<std::string>& BatchSolver::nonUniqueLoads() const {
  return state_->nonUniqueLoads;
}

} // namespace palp
