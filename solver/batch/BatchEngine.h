#pragma once

#include "solver/BatchSolver.h"
#include "solver/batch/ForcePolynomial.h"
#include "solver/batch/LaneWatch.h"
#include "solver/batch/LoadBatch.h"
#include "solver/batch/TouchLanes.h"
#include "solver/contact/TopCompliance.h"
#include "solver/contact/TouchedTangent.h"

#include <atomic>
#include <mutex>
#include <optional>

namespace palp {

/// Where the iteration of a load on one area starts: a cubic polynomial in the force for the whole state, fitted to 32
/// solves of its own, and how fast the iteration contracts there.
struct AreaPredictor {
  std::vector<double> displacements; ///< [3 nodes][terms]
  std::vector<double> unknowns;      ///< [elements][unknowns][terms]
  double contraction = 1;
};

/// Iterates loads in batches; the machinery of BatchSolver without its policy.
class BatchEngine {
public:
  /// `tolerance` is what the predictors are made for; a solve may ask for another. `touched` as in BatchOptions.
  BatchEngine(const HyperelasticProblem& problem, std::shared_ptr<const InitialTangent> rest, double tolerance,
              int threads, std::optional<Rectangle> touched = {});
  /// The same with the tangent that goes with `touched`.
  BatchEngine(const HyperelasticProblem& problem, TouchedTangent tangent, double tolerance, int threads,
              const Rectangle& touched);

  /// Answer of one load; without one: full Newton must find it.
  using Answer = std::optional<ElectrodeDisplacements>;
  /// Iterates each load to the tolerance. Empty: stopped. `state` is given each load's number and displacements of all
  /// nodes as they are found, by any thread, several at a time.
  [[nodiscard]] std::vector<Answer> solve(std::span<const LoadCase> loads, double tolerance,
                                          const std::function<void(std::size_t)>& done, const std::stop_token& stop,
                                          const BatchSolver::TakeState& state = {});
  [[nodiscard]] std::size_t solves() const { return solves_; }

  /// Gives back what waits for the next call: the lanes' memory, which other work may need meanwhile.
  void rest();

private:
  /// A load as the engine sees it: the forces of its areas summed, those of them that have a predictor.
  struct Job {
    std::size_t index = 0;
    std::vector<AreaLoad> areas;
    std::vector<int> predicted;
    std::vector<TractionShares> patchShares;
    const LoadCase* load = nullptr;
  };
  using Block = std::vector<Job>; ///< up to 8 with the same predictors
  /// What threads take work from; null: there is no more.
  struct Queue {
    std::vector<Block> blocks;
    std::vector<Job> touches;
    std::atomic<std::size_t> blocksTaken{0}, touchesTaken{0};

    const Block* nextBlock() { return next(blocks, blocksTaken); }
    const Job* nextTouch() { return next(touches, touchesTaken); }
    void leave() {
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
                                     const std::array<int, batchLanes>& inLane) const;
  using Touching = std::array<const Job*, batchLanes>;
  static std::optional<std::pair<int, int>> gapOf(const Touching& touching);
  void arrange(std::vector<Job> jobs, Queue& queue) const;
  template <class Give> void workOff(Queue& queue, double tolerance, const Give& give, const std::stop_token& stop);
  void addForces(LoadBatch& batch, int lane, const Job& job) const;
  void start(LoadBatch& batch, LaneWatch& watch, int block, const Block& jobs) const;
  [[nodiscard]] double assumedContraction(const Job& job) const;
  [[nodiscard]] std::unique_ptr<LoadBatch> borrowBatch();
  void giveBack(std::unique_ptr<LoadBatch> batch);

  HyperelasticProblem problem_;
  std::shared_ptr<const InitialTangent> rest_;
  ElementwiseTangent model_;
  ForcePolynomial polynomial_;
  int terms_; ///< of the polynomial, filled up to whole lanes
  double predictorTolerance_;
  int threads_;
  std::optional<Rectangle> touched_;
  std::vector<TractionShares> areaShares_;
  std::vector<std::optional<AreaPredictor>> predictors_;
  std::vector<char> tried_;                  ///< areas whose predictor was sought
  std::shared_ptr<const TopCompliance> top_; ///< found at the first load with an indenter
  std::mutex mutex_;
  std::vector<std::unique_ptr<LoadBatch>> idle_;
  std::atomic<std::size_t> solves_{0};
};

} // namespace palp
