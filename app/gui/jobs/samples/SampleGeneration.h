#pragma once

#include "app/gui/jobs/NetworkSession.h"
#include "app/gui/jobs/TimeLeft.h"

#include <QElapsedTimer>

namespace palp {

class SampleGenerator;

/// Samples on the way, for a job: training samples first, then those for testing. Sample i depends on the request and i
/// alone, so that a stopped generation continues to the same bytes.
class SampleGeneration {
public:
  SampleGeneration(const SampleSettings& settings, const MeshOptions& mesh, const SensorDesign& design)
      : settings_(settings), mesh_(mesh), design_(design) {}

  [[nodiscard]] bool is(const SampleSettings& settings, const MeshOptions& mesh) const {
    return settings_ == settings && mesh_ == mesh;
  }
  [[nodiscard]] const SensorDesign& design() const { return design_; }
  [[nodiscard]] const SampleSettings& settings() const { return settings_; }
  [[nodiscard]] const MeshOptions& mesh() const { return mesh_; }
  [[nodiscard]] bool inOneRun() const { return runs_ == 1; }
  /// Makes what is missing; false where it was stopped.
  bool make(StageLog& stages, const std::stop_token& stop, JobProgress& progress);
  /// Hands all of them over.
  std::shared_ptr<const NetworkSamples> samples();
  /// Samples done, of how many; {0, 0} before the first.
  [[nodiscard]] std::array<std::size_t, 2> state() const;

private:
  bool makeSet(std::size_t set, SampleGenerator& generator, const std::stop_token& stop, JobProgress& progress);
  void report(std::size_t set, std::size_t done, JobProgress& progress) const;
  void reportFits(std::size_t done, std::size_t all, JobProgress& progress) const;
  [[nodiscard]] double now_s() const { return 1e-3 * static_cast<double>(clock_.elapsed()); }

  SampleSettings settings_;
  MeshOptions mesh_;
  SensorDesign design_;
  std::array<SampleSet, 2> sets_;
  std::array<std::size_t, 2> made_{};
  std::array<std::size_t, 2> total_{};
  double batchError_ = 0;
  int redrawn_ = 0;
  std::string doubts_;
  QElapsedTimer clock_; ///< of this run
  TimeLeft left_;
  double fitsBegun_s_ = 0; ///< of the surrogates
  double took_s_ = 0;      ///< all runs together
  int runs_ = 0;
};

} // namespace palp
