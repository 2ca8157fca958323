#pragma once

#include "model/Indenter.h"
#include "solver/HyperelasticProblem.h"

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

namespace palp {

/// Readings that follow small motions of points of the block: d reading = sum over the points of gradient . u.
struct LinearReadings {
  Eigen::Matrix3Xd points_mm;
  Eigen::MatrixXd gradient_per_mm; ///< readings x 3 points: x, y, z of the first point first
};

/// How readings follow a round indenter of one place and force, to first order.
struct TouchInfluence {
  double radius_mm = 0;             ///< of the contact, as linear elasticity expects it
  Eigen::MatrixX3d perNewton;       ///< readings x (Fx, Fy, Fz) [1/N]; tangentially the indenter sticks
  Eigen::MatrixX2d byPlace_per_Nmm; ///< readings x (x, y): change of the column of Fz with the position [1/(N mm)]
};

/// Influence surfaces of readings: the change of each reading under a force anywhere on the top face of the block, to
/// first order at rest. By reciprocity (E. Betti, Teoria della elasticita, 1872, section 6) it is the displacement of
/// the top face under the reading's gradient as a load: one right-hand side per reading for any number of positions.
class InfluenceSurfaces {
public:
  /// Returns nullopt if cancelled. `threads` 0: all cores, the same bytes at any number. `progress` is called with the
  /// number of further readings done. Throws DesignError where a point lies outside the block.
  static std::optional<InfluenceSurfaces> find(const HyperelasticProblem& problem, const LinearReadings& readings,
                                               int threads, const std::stop_token& stop = {},
                                               const std::function<void(std::size_t more)>& progress = {});

  /// Of forces [N] at points (x, y) of the top face: readings x 3, one a point.
  [[nodiscard]] std::vector<Eigen::MatrixX3d> at(const Eigen::Ref<const Eigen::Matrix2Xd>& points_mm) const;

  /// For spheres, pins and punches under force control: Hertz's pressure (a punch: that under a flat end) over the
  /// contact, and tangentially the traction that displaces it uniformly, which is that under a flat end too (K. L.
  /// Johnson, Contact Mechanics, 1985, sections 3.4, 3.7, 4.2). Parts beyond the face act at its edge.
  [[nodiscard]] std::vector<TouchInfluence> of(std::span<const Indenter> touches, int threads,
                                               const std::stop_token& stop = {}) const;

  /// What such touches that press with their forces make of the readings: readings x touches.
  [[nodiscard]] Eigen::MatrixXd under(std::span<const Indenter> touches, int threads,
                                      const std::stop_token& stop = {}) const;

private:
  explicit InfluenceSurfaces(HyperelasticProblem problem) : problem_(std::move(problem)) {}
  /// Weights of points of the top face among its nodes: points x nodes.
  [[nodiscard]] Eigen::MatrixXd influence(const Eigen::Ref<const Eigen::Matrix2Xd>& points_mm,
                                          const Eigen::Ref<const Eigen::MatrixXd>& sums) const;

  HyperelasticProblem problem_;
  Mesh top_;                 ///< the elements at the top face alone: points of it lie in no other
  std::vector<int> topNode_; ///< of each node of the mesh among those of the top face, or -1
  Eigen::MatrixXd surfaces_; ///< 3 readings (x of all, then y, z) x nodes of the top face [1/N]
};

} // namespace palp
