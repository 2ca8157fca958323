#pragma once

#include "model/base/Error.h"
#include "solver/HyperelasticProblem.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

namespace palp {

struct BatchOptions {
  double relativeTolerance = 1e-6; ///< of the electrode displacements against full Newton's method
  bool surrogate = false;          ///< use one polynomial in the force per area, whose error is measured
  int threads = 0;                 ///< 0: all cores; changes the time, never the result
  /// Part of the top face that indenters will touch, if not all of it: the compliance is computed there only, and
  /// touches that extend beyond it are solved by full Newton.
  std::optional<Rectangle> touched{};
  /// Skips loads that do not converge (they have no electrodes) instead of throwing ConvergenceError.
  bool skipFailed = false;
  bool checkFirst = true; ///< compare the first load with full Newton; false if another BatchSolver does so
};

/// Solves many loads on one mesh by modified Newton iterations with one factorisation, that of the tangent at rest, for
/// 32 right-hand sides together (LoadBatch), from predictors fitted to a fixed set of loads. A load that does not
/// converge this way is solved by full Newton. The first of these strategies that succeeds gives the result of a load:
///
///   Surrogate     a polynomial in the force on one area (AreaSurrogate), if requested
///   Iteration     modified Newton; contact of indenters is solved on the compliance of the top face in each iteration,
///                 with friction in the load increments that full Newton would take (ColumnContact)
///   FullNewton    HyperelasticProblem::solve; always for friction together with loaded areas or discs
///
/// A fixed fraction of the results is compared with full Newton. The result of a load has the same bytes whichever
/// other loads are solved with it, in any order and on any number of threads. Method:
/// resources/docs/numerics/many-loads.md.
class BatchSolver {
public:
  explicit BatchSolver(const HyperelasticProblem& problem, BatchOptions options = {});
  ~BatchSolver();

  /// Returns the electrode displacements of each load, in the order of the loads; empty if cancelled. `progress` is
  /// called with the number of loads done, by any thread, one call at a time. Throws DesignError if a load cannot act,
  /// and ConvergenceError if one has no solution (unless BatchOptions::skipFailed); both name the load by its number,
  /// counted from `firstNumber`.
  [[nodiscard]] std::vector<ElectrodeDisplacements> solve(std::span<const LoadCase> loads,
                                                          const std::function<void(std::size_t)>& progress = {},
                                                          std::stop_token stop = {}, std::size_t firstNumber = 0);

  /// Receives a load's number in the call, its electrodes and its state (all nodes; the elements' unknowns only if
  /// the design has a pressure law). Called from any thread, also concurrently.
  using TakeState = std::function<void(std::size_t, const ElectrodeDisplacements&, const LoadIncrement&)>;
  /// As `solve`, but passes each state to `take` and does not use surrogates.
  [[nodiscard]] std::vector<ElectrodeDisplacements> solveStates(std::span<const LoadCase> loads, const TakeState& take,
                                                                const std::function<void(std::size_t)>& progress = {},
                                                                std::stop_token stop = {}, std::size_t firstNumber = 0);

  /// Sets the numbers by which messages name the next call's loads, instead of counting from its first.
  void nameLoads(std::vector<std::size_t> numbers);

  /// Fits the surrogates of these areas now instead of at their first load. Returns false if cancelled.
  bool fitSurrogates(std::span<const int> areas, const std::stop_token& stop = {});
  /// Largest error of the surrogates fitted so far, on loads held out of their fits.
  [[nodiscard]] double surrogateError() const;

  /// Frees the buffers kept for the next call.
  void releaseMemory();

  /// Loads of the last call that were skipped because they did not converge, in their order: "NUMBER: reason".
  [[nodiscard]] const std::vector<std::string>& failedLoads() const;

  /// Number of nonlinear solves so far (for predictors, corrections and fallbacks).
  [[nodiscard]] std::size_t solves() const;
  /// Number of loads solved by full Newton's method so far, not counting checks.
  [[nodiscard]] std::size_t leftToNewton() const;
  /// Largest relative error against full Newton's method over the loads checked so far, of all quantities that
  /// determine the readings (electrodes of both layers, pressures, resistances); nullopt if no load was checked.
  [[nodiscard]] std::optional<double> measuredError() const;
  /// Checked loads for which full Newton's method finds another equilibrium (with the distance) or does not converge:
  /// with friction, on a mesh too coarse for the contact, the equilibrium is not unique.
  [[nodiscard]] const std::vector<std::string>& nonUniqueLoads() const;

private:
  std::vector<ElectrodeDisplacements> answer(std::span<const LoadCase> loads,
                                             const std::function<void(std::size_t)>& progress,
                                             const std::stop_token& stop, std::size_t firstNumber,
                                             const TakeState& take);
  struct State;
  std::unique_ptr<State> state_;
};

/// Thrown for a load of a batch that does not converge. It is an Error, since a design or a load can cause it; catch it
/// before Error to distinguish it from invalid input.
struct ConvergenceError : Error {
  using Error::Error;
};

} // namespace palp
