#pragma once

#include "app/study/StageLog.h"
#include "app/study/touch/SymmetryReduction.h"
#include "model/LoadCase.h"
#include "model/SampleSet.h"
#include "model/SensorDesign.h"
#include "model/TouchRange.h"
#include "solver/BatchSolver.h"
#include "solver/ConductionBatch.h"
#include "solver/SensorMesh.h"

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

namespace palp {

class ProgressRelay;

/// Which samples: random forces on areas, uniform over the design's force range, or random touches.
struct SampleRequest {
  int perArea = 100; ///< on each area; `together`: in all
  std::uint64_t seed = 1;
  std::string areas = "each";          ///< each (one area loaded at a time), together, or the number of one area
  std::optional<TouchRange> touches{}; ///< indenters in place of areas: `perArea` of them in all
  bool surrogate = false;              ///< per-area polynomial instead of full solves
  double relativeTolerance = 1e-6;
  MeshOptions mesh;
  int threads = 0; ///< 0: all cores
};

/// Samples first..last-1 of a request.
struct SampleRange {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Shard `index` (from 1) of `count` equal parts of `total` samples.
SampleRange shard(std::size_t total, int index, int count);

/// Makes the samples of one request; sample i depends on the request and i alone, to the last byte, so that ranges can
/// be made anywhere, in any order. Meshes and factorises at the first call that needs it.
class SampleGenerator {
public:
  /// Throws DesignError where the design or the request cannot be.
  SampleGenerator(SensorDesign design, SampleRequest request);

  [[nodiscard]] std::size_t total() const;
  /// The mesh that its samples need; of touches that are solved in parts that of the first one. For its cost.
  [[nodiscard]] MeshOptions meshing();
  /// The load of sample i; a pure function of the request and i, but where a touch was drawn anew.
  [[nodiscard]] LoadCase load(std::size_t i) const;

  /// Hands blocks of samples, in order, to `take`; `progress` gets the number of samples done in this call. Stops after
  /// the request and returns the number handed out.
  std::size_t generate(SampleRange range, const std::function<void(const SampleSet&)>& take,
                       const std::function<void(std::size_t)>& progress = {}, const std::stop_token& stop = {});

  /// The same request with another seed from now on; what was prepared stays.
  void setSeed(std::uint64_t seed);
  /// Called between the fits of surrogates, with the number of areas that have theirs and of all; they take longer than
  /// the samples.
  void whileFitting(std::function<void(std::size_t done, std::size_t all)> progress) { fitting_ = std::move(progress); }

  /// The head of the file; needs the mesh (and for surrogates the fit).
  const SampleOrigin& origin();
  /// An empty set with this request's origin and sizes. Stopped: its origin lacks what was not computed.
  SampleSet emptySet(const std::stop_token& stop = {});

  [[nodiscard]] const StageLog& stages() const { return stages_; }
  [[nodiscard]] std::size_t solves() const;
  /// Samples so far that full Newton's method had to find.
  [[nodiscard]] std::size_t leftToNewton() const;
  /// How many touches had no equilibrium (a ball that is pushed off an edge) and were drawn anew, and why the first.
  [[nodiscard]] int redrawn() const { return redrawn_; }
  [[nodiscard]] const std::string& whyRedrawn() const { return whyRedrawn_; }
  /// Largest relative error of the electrode displacements on the share that was solved again by full Newton; that of
  /// the surrogates' d ln R under the law of the field where it is larger. 0 as well where nothing was measured.
  [[nodiscard]] double measuredError() const;
  [[nodiscard]] bool errorMeasured() const;
  /// Of that share, the samples for which full Newton finds another equilibrium or none (BatchSolver.h), in a sentence;
  /// empty where there is none.
  [[nodiscard]] std::string doubts() const;

private:
  /// Solver of the samples on one mesh: of all, or of touches in a part of their rectangle.
  struct Part {
    std::optional<TouchRange> touches;
    std::unique_ptr<HyperelasticProblem> problem;
    std::unique_ptr<BatchSolver> solver;
    std::unique_ptr<ConductionBatch> field;   ///< under the law of the field
    StageLog stages{};                        ///< not yet counted by the generator's
    std::size_t solves = 0, leftToNewton = 0; ///< of released solvers
    std::optional<double> measuredError;
    std::vector<std::string> doubts;

    void release(); ///< its memory; made again where it is needed again
  };
  void split();
  [[nodiscard]] MeshOptions meshOf(const Part& part) const;
  /// False: stopped.
  bool prepare(const std::stop_token& stop = {});
  bool prepare(Part& part, bool checked, const std::stop_token& stop);
  bool fitSurrogates(const std::stop_token& stop);
  [[nodiscard]] std::size_t partOf(const LoadCase& load) const;
  [[nodiscard]] std::size_t samplesABlock() const;
  ConductionBatch::Answers answers(Part& part, const std::vector<LoadCase>& loads,
                                   const std::vector<std::size_t>& numbers,
                                   const std::function<void(std::size_t)>& progress, const std::stop_token& stop);
  /// Empty displacements: stopped.
  ConductionBatch::Answers answers(const SampleRange& part, bool last, const std::function<void(std::size_t)>& progress,
                                   const std::stop_token& stop);
  /// Of loads with these numbers.
  ConductionBatch::Answers answers(const std::vector<LoadCase>& loads, const std::vector<std::size_t>& numbers,
                                   bool last, const std::function<void(std::size_t)>& progress,
                                   const std::stop_token& stop);
  [[nodiscard]] int redrawnTimes(std::size_t number) const;
  void redraw(std::size_t number);
  /// Those of these loads that lie in the part, side by side with other parts. False: stopped.
  bool answerPart(std::size_t index, bool checked, const std::vector<LoadCase>& loads,
                  const std::vector<std::size_t>& numbers, std::span<const std::size_t> own, ProgressRelay& progress,
                  const std::stop_token& stop, ConductionBatch::Answers& all);
  [[nodiscard]] int concurrentParts(std::size_t index) const;
  SampleSet block(SampleRange range, const ConductionBatch::Answers& answers) const;

  SensorDesign design_;
  SampleRequest request_;
  std::optional<int> onlyArea_;
  SampleOrigin origin_;
  SymmetryReduction symmetry_;         ///< where loads are solved
  TouchRange solved_;                  ///< touches there
  std::vector<Part> parts_;            ///< made at the first sample in each
  std::array<int, 2> cuts_{1, 1};      ///< of the rectangle of these into parts along x and y
  bool fitted_ = false;                ///< surrogates, where wanted
  std::map<std::size_t, int> redraws_; ///< of touches, by their numbers
  int redrawn_ = 0;
  std::mutex guard_; ///< of the next
  std::string whyRedrawn_;
  std::function<void(std::size_t, std::size_t)> fitting_;
  StageLog stages_;
};

} // namespace palp
