#include "solver/ConductionBatch.h"

#include "model/FieldAtRest.h"
#include "model/base/Parallel.h"
#include "model/base/ProgressRelay.h"
#include "solver/field/ResistancePolynomial.h"

#include <algorithm>
#include <mutex>
#include <set>

namespace palp {

namespace {

/// Of d ln R: far below the mesh's own error, and what a cubic reaches for the paper's forces.
constexpr double largestFitError = 1e-4;

/// States of a batch, of a megabyte or two each.
constexpr std::size_t mostWaiting = 32;

} // namespace

struct ConductionBatch::State {
  SensorDesign design;
  BatchSolver& batch;
  BatchOptions options;
  ConductionField field;
  Eigen::MatrixXd logAtRest;
  std::vector<std::optional<ResistancePolynomial>> polynomials; ///< one an area

  State(const HyperelasticProblem& problem, BatchSolver& b, const BatchOptions& o)
      : design(problem.design()), batch(b), options(o), field(problem),
        logAtRest(resistancesAtRest_ohm(design).array().log()), polynomials(std::size_t(design.areas.count())) {}

  /// Every load by its own state.
  Answers bySolves(std::span<const LoadCase> loads, const std::function<void(std::size_t)>& progress,
                   const std::stop_token& stop, std::size_t firstNumber);
  bool fit(const std::vector<int>& areas, const std::stop_token& stop);
};

/// States wait for their fields, a few of them: what the batch has solved comes in blocks, and its last ones would
/// leave all threads but one without work.
ConductionBatch::Answers ConductionBatch::State::bySolves(std::span<const LoadCase> loads,
                                                          const std::function<void(std::size_t)>& progress,
                                                          const std::stop_token& stop, std::size_t firstNumber) {
  struct Solved {
    std::size_t index;
    ElectrodeDisplacements electrodes;
    LoadIncrement state;
  };
  std::vector<Solved> waiting;
  std::mutex guard; // of those
  Answers answers;
  answers.resistances_ohm.resize(loads.size());
  std::size_t done = 0;
  ProgressRelay relay(progress ? [&](std::size_t more) { progress(done += more); }
                               : std::function<void(std::size_t)>());
  const auto resistances = [&](const Solved& solved) { // by one thread: all are at work on some state
    if (const auto network = field.network(solved.state, solved.electrodes, 1, stop)) {
      answers.resistances_ohm[solved.index] = NetworkReading(*network, design.field()->readout).resistances_ohm();
      relay.add(1);
    }
  };
  const auto take = [&](std::size_t i, const ElectrodeDisplacements& electrodes, const LoadIncrement& state) {
    std::optional<Solved> next;
    {
      const std::lock_guard lock(guard);
      waiting.push_back({i, electrodes, state});
      if (waiting.size() <= mostWaiting) return;
      next = std::move(waiting.back());
      waiting.pop_back();
    }
    resistances(*next);
  };
  answers.displacements = batch.solveStates(loads, take, {}, stop, firstNumber);
  inParallel(stop.stop_requested() ? 0 : waiting.size(), options.threads,
             [&](std::size_t i) { resistances(waiting[i]); });
  if (stop.stop_requested()) return {};
  return answers;
}

/// Of these areas together, so that there is work for all threads: each the smallest degree that meets the tolerance,
/// or the best. False: stopped.
bool ConductionBatch::State::fit(const std::vector<int>& areas, const std::stop_token& stop) {
  struct Fit {
    int area;
    Eigen::MatrixXd changes; ///< of d ln R, readings x forces
    std::optional<ResistancePolynomial> best;
  };
  std::vector<Fit> open;
  for (const int area : areas)
    if (!polynomials[std::size_t(area)]) open.push_back({area, Eigen::MatrixXd(logAtRest.size(), 0), {}});
  std::vector<Eigen::Vector3d> forces;
  for (int degree = ResistancePolynomial::lowestDegree; degree <= ResistancePolynomial::highestDegree && !open.empty();
       ++degree) {
    const std::size_t before = forces.size();
    while (static_cast<int>(forces.size()) < ResistancePolynomial::statesFor(degree))
      forces.push_back(coveringForce(design.forceRange, static_cast<int>(forces.size())));
    std::vector<LoadCase> loads;
    for (const Fit& each : open)
      for (std::size_t i = before; i < forces.size(); ++i) loads.push_back({{{each.area, forces[i]}}, {}});
    const Answers answers = bySolves(loads, {}, stop, 0);
    if (answers.resistances_ohm.empty()) return false;
    auto answer = answers.resistances_ohm.begin();
    for (Fit& each : open) {
      each.changes.conservativeResize(Eigen::NoChange, static_cast<Eigen::Index>(forces.size()));
      for (std::size_t i = before; i < forces.size(); ++i, ++answer)
        each.changes.col(static_cast<Eigen::Index>(i)) =
            (answer->array().log() - logAtRest.array()).matrix().reshaped();
      ResistancePolynomial trial(design.forceRange, degree, forces, each.changes);
      if (!each.best || trial.error() < each.best->error()) each.best = std::move(trial);
      if (degree == ResistancePolynomial::highestDegree || each.best->error() <= largestFitError)
        polynomials[std::size_t(each.area)] = std::move(each.best);
    }
    std::erase_if(open, [&](const Fit& each) { return polynomials[std::size_t(each.area)].has_value(); });
  }
  return true;
}

ConductionBatch::ConductionBatch(const HyperelasticProblem& problem, BatchSolver& batch, const BatchOptions& options)
    : state_(std::make_unique<State>(problem, batch, options)) {}
ConductionBatch::~ConductionBatch() = default;

ConductionBatch::Answers ConductionBatch::solve(std::span<const LoadCase> loads,
                                                const std::function<void(std::size_t)>& progress,
                                                const std::stop_token& stop, std::size_t firstNumber) {
  State& s = *state_;
  const auto one = [&](const LoadCase& load) { return onOneArea(load, s.design.forceRange); };
  if (!s.options.surrogate || !std::all_of(loads.begin(), loads.end(), one))
    return s.bySolves(loads, progress, stop, firstNumber);
  std::set<int> areas;
  for (const LoadCase& load : loads) areas.insert(load.areas[0].area);
  if (!s.fit({areas.begin(), areas.end()}, stop)) return {};
  Answers answers{s.batch.solve(loads, progress, stop, firstNumber), {}};
  if (answers.displacements.size() < loads.size()) return {};
  for (const LoadCase& load : loads) {
    const Eigen::VectorXd change = s.polynomials[std::size_t(load.areas[0].area)]->at(load.areas[0].force_N);
    answers.resistances_ohm.emplace_back(
        (s.logAtRest.array() + change.reshaped(s.logAtRest.rows(), s.logAtRest.cols()).array()).exp());
  }
  return answers;
}

bool ConductionBatch::fitSurrogates(std::span<const int> areas, const std::stop_token& stop) {
  return state_->fit({areas.begin(), areas.end()}, stop);
}

double ConductionBatch::surrogateError() const {
  double error = 0;
  for (const auto& polynomial : state_->polynomials)
    if (polynomial) error = std::max(error, polynomial->error());
  return error;
}

} // namespace palp
