#pragma once

#include "solver/InfluenceSurfaces.h"

namespace palp {

/// Displacement of the complete block under round indenters with force control, to first order at rest.
/// InfluenceSurfaces serves any touches for one set of readings, this class any readings for one set of touches: seven
/// right-hand sides per touch for any number of electrode layouts.
class TouchFields {
public:
  /// Empty: stopped. `threads` 0: all cores, the same bytes at any number.
  static std::optional<TouchFields> find(const HyperelasticProblem& problem, std::span<const Indenter> touches,
                                         int threads, const std::stop_token& stop = {});

  /// As InfluenceSurfaces::of gives them, one a touch. Throws DesignError where a point lies outside the block, and
  /// Cancelled.
  [[nodiscard]] std::vector<TouchInfluence> of(const LinearReadings& readings, int threads,
                                               const std::stop_token& stop = {}) const;

private:
  explicit TouchFields(HyperelasticProblem problem) : problem_(std::move(problem)) {}

  HyperelasticProblem problem_;
  std::vector<double> radii_mm_;
  double shift_mm_ = 0;
  Eigen::MatrixXd moved_; ///< 3 nodes x (7 a touch: by Fx, Fy, Fz, then Fz to the right, left, back, front) [mm/N]
};

} // namespace palp
