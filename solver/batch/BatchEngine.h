#pragma once

#include "solver/BatchSolver.h"
#include "solver/batch/ContactColumns.h"
#include "solver/batch/ConvergenceMonitor.h"
#include "solver/batch/ForcePolynomial.h"
#include "solver/batch/LoadBatch.h"
#include "solver/contact/TopCompliance.h"
#include "solver/contact/TouchedTangent.h"

#include <atomic>
#include <mutex>
#include <optional>

namespace palp {

/// Initial guess for loads on one area: a cubic polynomial in the force for the complete state, fitted to 32 solves,
/// and the contraction of the iteration there.
struct AreaPredictor {
  std::vector<double> displacements; ///< [3 nodes][terms]
  std::vector<double> unknowns;      ///< [elements][unknowns][terms]
  double contraction = 1;
};

/// Iterates loads in batches: the work of BatchSolver without its strategies and checks. Threads take blocks of loads
/// and touches from a queue, each with a LoadBatch of its own; a finished block or column is refilled from the queue.
class BatchEngine {
public:
  /// `tolerance` is that of the predictors; a solve may have another. `touched` as in BatchOptions.
  BatchEngine(const HyperelasticProblem& problem, std::shared_ptr<const InitialTangent> rest, double tolerance,
              int threads, std::optional<Rectangle> touched = {});
  /// The same with the tangent that belongs to `touched`.
  BatchEngine(const HyperelasticProblem& problem, TouchedTangent tangent, double tolerance, int threads,
              const Rectangle& touched);

  /// Answer of one load; nullopt: to be solved by full Newton.
  using Answer = std::optional<ElectrodeDisplacements>;
  /// Iterates each load to the tolerance. Returns an empty vector if cancelled. `state` receives each load's state as
  /// it converges, by any thread, several at a time.
  [[nodiscard]] std::vector<Answer> solve(std::span<const LoadCase> loads, double tolerance,
                                          const std::function<void(std::size_t)>& done, const std::stop_token& stop,
                                          const BatchSolver::TakeState& state = {});
  [[nodiscard]] std::size_t solves() const { return solves_; }

  /// Frees the batches kept for the next call.
  void releaseMemory();

private:
  /// A load with the forces on each of its areas summed, and the areas that have a predictor.
  struct Job {
    std::size_t index = 0;
    std::vector<AreaLoad> areas;
    std::vector<int> predicted;
    std::vector<TractionShares> patchShares;
    const LoadCase* load = nullptr;
  };
  using Block = std::vector<Job>; ///< up to 8 with the same predictors
  /// Work for the threads; null: none remains.
  struct Queue {
    std::vector<Block> blocks;
    std::vector<Job> touches;
    std::atomic<std::size_t> blocksTaken{0}, touchesTaken{0};

    const Block* nextBlock() { return next(blocks, blocksTaken); }
    const Job* nextTouch() { return next(touches, touchesTaken); }
    void abandon() {
      blocksTaken = blocks.size();
      touchesTaken = touches.size();
    }

  private:
    template <class Work> static const Work* next(const std::vector<Work>& of, std::atomic<std::size_t>& taken) {
      const std::size_t i = taken++;
      return i < of.size() ? &of[i] : nullptr;
    }
  };

  [[nodiscard]] Job job(const LoadCase& load, std::size_t index) const;
  [[nodiscard]] bool findCompliance(const std::vector<Job>& jobs, const std::stop_token& stop);
  [[nodiscard]] bool makePredictors(const std::vector<Job>& jobs, const std::stop_token& stop);
  [[nodiscard]] std::optional<AreaPredictor> fitPredictor(int area, const std::stop_token& stop);
  [[nodiscard]] AreaPredictor fitted(const LoadBatch& batch, const std::vector<Eigen::Vector3d>& forces,
                                     const std::array<int, batchColumns>& inColumn) const;
  using Touching = std::array<const Job*, batchColumns>;
  static std::optional<std::pair<int, int>> gapOf(const Touching& touching);
  void arrange(std::vector<Job> jobs, Queue& queue) const;
  template <class Report>
  void process(Queue& queue, double tolerance, const Report& report, const std::stop_token& stop);
  void addForces(LoadBatch& batch, int column, const Job& job) const;
  void start(LoadBatch& batch, ConvergenceMonitor& watch, int block, const Block& jobs) const;
  [[nodiscard]] double assumedContraction(const Job& job) const;
  [[nodiscard]] std::unique_ptr<LoadBatch> acquireBatch();
  void releaseBatch(std::unique_ptr<LoadBatch> batch);

  HyperelasticProblem problem_;
  std::shared_ptr<const InitialTangent> rest_;
  ElementwiseTangent model_;
  ForcePolynomial polynomial_;
  int terms_; ///< of the polynomial, padded to a multiple of 8
  double predictorTolerance_;
  int threads_;
  std::optional<Rectangle> touched_;
  std::vector<TractionShares> areaShares_;
  std::vector<std::optional<AreaPredictor>> predictors_;
  std::vector<char> tried_;                  ///< areas whose predictor was fitted or failed
  std::shared_ptr<const TopCompliance> top_; ///< found at the first load with an indenter
  std::mutex mutex_;
  std::vector<std::unique_ptr<LoadBatch>> idle_;
  std::atomic<std::size_t> solves_{0};
};

} // namespace palp
