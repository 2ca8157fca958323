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
  bool surrogate = false;          ///< answer by a polynomial in the force, one for each area, whose error is measured
  int threads = 0;                 ///< 0: all cores; changes the time, never the result
  /// Where indenters will touch the top face, if not anywhere: the compliance is found there only, and touches that
  /// reach further are left to full Newton.
  std::optional<Rectangle> touched{};
  /// Loads without a solution have no electrodes, where they would else be an exception.
  bool leaveOut = false;
  bool checkFirst = true; ///< against full Newton; false: another solver of the same loads has done it
};

/// Solves many loads on one mesh: modified Newton's method with one factorisation, that of the tangent at rest, for
/// many right sides at once, from predictors fitted to a fixed set of loads; full Newton's method where that does not
/// converge. Indenters are iterated along, their contact solved on the compliance of the top face, those with friction
/// in the steps that full Newton would take; beside loaded areas these are left to full Newton. The answer to a load is
/// the same to the last byte whatever loads stand beside it, in any order and on any number of threads.
class BatchSolver {
public:
  explicit BatchSolver(const HyperelasticProblem& problem, BatchOptions options = {});
  ~BatchSolver();

  /// Electrode displacements of each load, in the order of the loads; empty if cancelled. `progress` is given the
  /// number of loads done, by any thread, one call at a time. Throws DesignError if a load cannot act, and
  /// ConvergenceError if one has no solution (but for BatchOptions::leaveOut); both name the load by its number,
  /// counted from `firstNumber`.
  [[nodiscard]] std::vector<ElectrodeDisplacements> solve(std::span<const LoadCase> loads,
                                                          const std::function<void(std::size_t)>& progress = {},
                                                          std::stop_token stop = {}, std::size_t firstNumber = 0);

  /// What else is made of a load's state (its number in the call, its electrodes, all nodes), by any thread, several at
  /// a time. The elements' unknowns are there where the design has a pressure law.
  using TakeState = std::function<void(std::size_t, const ElectrodeDisplacements&, const LoadIncrement&)>;
  /// The same with the states, and never by a surrogate.
  [[nodiscard]] std::vector<ElectrodeDisplacements> solveStates(std::span<const LoadCase> loads, const TakeState& take,
                                                                const std::function<void(std::size_t)>& progress = {},
                                                                std::stop_token stop = {}, std::size_t firstNumber = 0);

  /// Numbers that the next call's loads are named by, instead of counted from its first.
  void nameLoads(std::vector<std::size_t> numbers);

  /// Fits the surrogates of these areas now rather than at their first load; false if stopped.
  bool fitSurrogates(std::span<const int> areas, const std::stop_token& stop = {});
  /// Largest error of the surrogates fitted so far, on loads that were kept out of their fits.
  [[nodiscard]] double surrogateError() const;

  /// Gives back the memory that waits for the next call.
  void rest();

  /// Why loads of the last call were left out, in their order: "NUMBER: why".
  [[nodiscard]] const std::vector<std::string>& leftOut() const;

  /// Number of nonlinear solves so far (for predictors, corrections and fallbacks).
  [[nodiscard]] std::size_t solves() const;
  /// Number of loads that were left to full Newton's method so far.
  [[nodiscard]] std::size_t leftToNewton() const;
  /// Largest relative error of what the readings follow (electrodes of both layers, pressures, resistances) against
  /// full Newton's method, over the loads checked so far. None: none was checked.
  [[nodiscard]] std::optional<double> measuredError() const;
  /// Of the loads checked so far, those for which full Newton's method finds another equilibrium or none, and how far
  /// away: friction on a mesh too coarse for its contact has several.
  [[nodiscard]] const std::vector<std::string>& doubts() const;

private:
  std::vector<ElectrodeDisplacements> answer(std::span<const LoadCase> loads,
                                             const std::function<void(std::size_t)>& progress,
                                             const std::stop_token& stop, std::size_t firstNumber,
                                             const TakeState& take);
  struct State;
  std::unique_ptr<State> state_;
};

/// A load of a batch for which no solution was found. An Error, as a design or a load can cause it; who tells outcomes
/// from refusals catches it first.
struct ConvergenceError : Error {
  using Error::Error;
};

} // namespace palp
