#pragma once

#include "solver/BatchSolver.h"
#include "solver/ConductionField.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace palp {

/// The resistances of many loads under the law of the field: each from its own solved state, or, where the batch
/// answers by surrogates, by a polynomial of the force for d ln R of each area, fitted to such states.
class ConductionBatch {
public:
  /// `batch` solves loads on the problem's mesh and outlives this. Throws DesignError as ConductionField does.
  ConductionBatch(const HyperelasticProblem& problem, BatchSolver& batch, const BatchOptions& options);
  ~ConductionBatch();

  struct Answers {
    std::vector<ElectrodeDisplacements> displacements;
    std::vector<Eigen::MatrixXd> resistances_ohm; ///< row-wires x column-wires
  };
  /// In the order of the loads; empty if stopped. Throws as BatchSolver::solve does.
  [[nodiscard]] Answers solve(std::span<const LoadCase> loads, const std::function<void(std::size_t)>& progress,
                              const std::stop_token& stop, std::size_t firstNumber = 0);

  /// Fits the polynomials of these areas now rather than at their first load; false if stopped.
  bool fitSurrogates(std::span<const int> areas, const std::stop_token& stop);
  /// Largest error of their d ln R on states that were kept out of their fits: rms over all readings, relative.
  [[nodiscard]] double surrogateError() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace palp
