#pragma once

#include "solver/InfluenceSurfaces.h"

namespace palp {

/// How the whole block moves under round indenters that press with a force, to first order at rest. What
/// InfluenceSurfaces is for any touches of one set of readings, this is for any readings of one set of touches: seven
/// right sides a touch, however many layouts of electrodes are read.
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
