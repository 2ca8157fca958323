#include "solver/BatchSolver.h"

#include "model/Error.h"
#include "solver/Parallel.h"

#include <atomic>
#include <mutex>

namespace palp {

struct BatchSolver::State {
  const HyperelasticProblem& problem;
  BatchOptions options;
  std::size_t solves = 0;
};

BatchSolver::BatchSolver(const HyperelasticProblem& problem, BatchOptions options)
    : state_(std::make_unique<State>(State{problem, options})) {}
BatchSolver::~BatchSolver() = default;

std::vector<ElectrodeDisplacements> BatchSolver::solve(std::span<const LoadCase> loads,
                                                       const std::function<void(std::size_t)>& progress,
                                                       std::stop_token stop) {
  for (std::size_t i = 0; i < loads.size(); ++i)
    if (const auto why = problem(loads[i], state_->problem.design()))
      throw DesignError("load " + std::to_string(i) + ": " + *why);
  std::vector<ElectrodeDisplacements> answers(loads.size());
  std::vector<std::string> reasons(loads.size());
  std::mutex progressMutex;
  std::size_t done = 0;
  NewtonOptions newton;
  newton.threads = 1;
  forChunks(static_cast<int>(loads.size()), 1, state_->options.threads, [&](int begin, int) {
    if (stop.stop_requested()) return;
    const Solution solution = state_->problem.solve(loads[begin], newton, {.step = {}, .stop = stop});
    if (!solution.converged) reasons[begin] = solution.stopReason;
    answers[begin] = state_->problem.electrodes(solution.state());
    const std::lock_guard lock(progressMutex);
    if (progress) progress(++done);
  });
  if (stop.stop_requested()) return {};
  for (std::size_t i = 0; i < loads.size(); ++i)
    if (!reasons[i].empty()) throw ConvergenceError("load " + std::to_string(i) + ": " + reasons[i]);
  state_->solves += loads.size();
  return answers;
}

std::size_t BatchSolver::solves() const {
  return state_->solves;
}
double BatchSolver::measuredError() const {
  return 0;
}

} // namespace palp
