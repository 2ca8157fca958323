#pragma once

#include "model/Indenter.h"
#include "solver/contact/ContactPoints.h"

#include <Eigen/Core>

#include <stop_token>
#include <vector>

namespace palp {

enum class Grip { Free, Slides, Sticks };

/// What indenters and points do to one another: forces on the rubber [N], 3 x points, and how far each indenter has
/// moved from first touch [mm], 3 x indenters.
struct ContactState {
  Eigen::Matrix3Xd forces_N;
  Eigen::Matrix3Xd translations_mm;
  std::vector<Grip> grips;
};

/// What an indenter is made to do: in each direction a translation, or a force where it is free.
struct ContactTarget {
  Eigen::Array<bool, 3, 1> free;
  Eigen::Vector3d force_N, translation_mm;
  double longestMove_mm = 1; ///< of one iteration
};

/// Contact of points of a body that answers linearly, x = x0 + C (f - f0), with rigid indenters at tips t + d:
///   g(x_i - t - d) = 0, p_i = f_i . n >= 0 where they touch, f_i = 0 elsewhere,
///   Coulomb: |f_t| <= mu p_i; less: no slip, s_t = 0; equal: f_t opposes the slip s since the start of the load step;
///   sum f_i = F in the directions in which an indenter is free.
/// Solved to rounding by a semismooth Newton method on the forces of the points that touch (primal-dual active sets:
/// Alart and Curnier 1991; Hueeber and Wohlmuth 2005).
class ReducedContact {
public:
  /// Tips at rest [mm]; `start` is the state in which the load step begins with the points' positions there.
  ReducedContact(const std::vector<Indenter>& indenters, const std::vector<ContactPoint>& points,
                 Eigen::Matrix3Xd tips_mm);
  void startStep(const Eigen::Matrix3Xd& positions_mm, const ContactState& start);

  /// `positions_mm` are the points' under the state's forces; C is 3 points x 3 points [mm / N]. False: no solution.
  [[nodiscard]] bool solve(const Eigen::MatrixXd& compliance, const Eigen::Matrix3Xd& positions_mm,
                           const std::vector<ContactTarget>& targets, ContactState& state,
                           const std::stop_token& stop) const;

  /// How deep the deepest of the points lies inside its indenter.
  [[nodiscard]] double penetration_mm(const Eigen::Matrix3Xd& positions_mm, const ContactState& state) const;

private:
  /// The conditions of one point, R(f, x - t - d) = 0 [mm], and their derivatives.
  struct Conditions {
    Eigen::Vector3d residual;
    Eigen::Matrix3d byForce, byPlace;
    Grip grip = Grip::Free;
  };
  [[nodiscard]] IndenterDistance distanceOf(int point, const Eigen::Vector3d& position_mm,
                                            const Eigen::Matrix3Xd& translations_mm) const;
  [[nodiscard]] Conditions conditions(int point, const Eigen::Vector3d& force, const Eigen::Vector3d& position,
                                      const Eigen::Matrix3Xd& translations, double stiffness, double bySlip) const;
  /// With a share of the stiffness by which slip is weighed; the state is no solution where there was none.
  [[nodiscard]] bool solve(const Eigen::MatrixXd& compliance, const Eigen::Matrix3Xd& positions_mm,
                           const std::vector<ContactTarget>& targets, double slipShare, ContactState& state,
                           const std::stop_token& stop) const;

  const std::vector<Indenter>& indenters_;
  const std::vector<ContactPoint>& points_;
  Eigen::Matrix3Xd tips_mm_;
  Eigen::Matrix3Xd startPlaces_mm_; ///< of the points, from their indenters' tips
  std::vector<bool> touchedAtStart_;
};

} // namespace palp
