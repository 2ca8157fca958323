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

/// Many loads on one mesh: one factorisation of the initial tangent, many right-hand sides at once, starting values
/// from polynomials fitted to solves of its own, full Newton for loads that do not converge so. A load's answer does
/// not depend on other loads, on threads or on the order, to the last byte (resources/docs/numerics.md).
class BatchSolver {
public:
  explicit BatchSolver(const HyperelasticProblem& problem, BatchOptions options = {});
  ~BatchSolver();

  /// Electrode displacements, one per load, in the loads' order. `progress` gets the number of loads done, from any
  /// thread, one call at a time. Empty if cancelled. Throws DesignError if a load cannot be applied, and
  /// ConvergenceError (which load, and why) if one has no solution.
  [[nodiscard]] std::vector<ElectrodeDisplacements> solve(std::span<const LoadCase> loads,
                                                          const std::function<void(std::size_t)>& progress = {},
                                                          std::stop_token stop = {});

  /// Fits the surrogates of these areas now instead of at their first load; false if stopped.
  bool fitSurrogates(std::span<const int> areas, const std::stop_token& stop = {});
  /// Largest error of the surrogates fitted so far, on loads held out from their fits.
  [[nodiscard]] double surrogateError() const;

  /// Nonlinear solves done so far (predictor fits, corrections and fallbacks).
  [[nodiscard]] std::size_t solves() const;
  /// Largest relative error of the electrode displacements against full Newton, among the loads checked so far.
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
