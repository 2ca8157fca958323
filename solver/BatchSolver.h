#pragma once

#include "solver/HyperelasticProblem.h"

#include <functional>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

namespace palp {

struct BatchOptions {
  double relativeTolerance = 1e-6; ///< of the electrode displacements against full Newton
  bool surrogate = false;          ///< per-area polynomial in the force alone, labelled with its measured error
  int threads = 0;                 ///< 0: all cores; changes the time, never the result
};

/// Many loads on one mesh: one factorisation of the tangent at rest, many right sides at once, predictors from solves
/// of its own on fixed loads, full Newton where that does not converge. A load's answer depends neither on the loads
/// beside it nor on threads or order, to the last byte.
class BatchSolver {
public:
  explicit BatchSolver(const HyperelasticProblem& problem, BatchOptions options = {});
  ~BatchSolver();

  /// Electrode displacements, one a load, in the loads' order. `progress` gets the number of loads done, from any
  /// thread, one call at a time. An empty result: cancelled. Throws DesignError where a load cannot act, and
  /// ConvergenceError (with the load's number and why) where one has no solution; loads count from `firstNumber`.
  [[nodiscard]] std::vector<ElectrodeDisplacements> solve(std::span<const LoadCase> loads,
                                                          const std::function<void(std::size_t)>& progress = {},
                                                          std::stop_token stop = {}, std::size_t firstNumber = 0);

  /// Fits the surrogates of these areas now instead of at their first load; false: stopped.
  bool fitSurrogates(std::span<const int> areas, const std::stop_token& stop = {});
  /// Largest error of the surrogates fitted so far, on loads kept from their fits.
  [[nodiscard]] double surrogateError() const;

  /// Nonlinear solves done so far (predictor fits, corrections and fallbacks).
  [[nodiscard]] std::size_t solves() const;
  /// Largest relative error of the electrode displacements against full Newton, on the share of loads checked so far.
  [[nodiscard]] double measuredError() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A load of a batch that has no converged solution.
struct ConvergenceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

} // namespace palp
