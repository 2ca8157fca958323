#pragma once

#include "model/Indenter.h"
#include "solver/contact/ContactPoints.h"

#include <Eigen/Core>

#include <stop_token>
#include <vector>

namespace palp {

enum class ContactStatus { Open, Slip, Stick };

/// Contact forces on the rubber [N], 3 x points, and translations of the indenters from first touch [mm], 3 x
/// indenters.
struct ContactState {
  Eigen::Matrix3Xd forces_N;
  Eigen::Matrix3Xd translations_mm;
  std::vector<ContactStatus> statuses;
};

/// An indenter's prescribed motion: in each direction a translation, or a force where it is free.
struct ContactTarget {
  Eigen::Array<bool, 3, 1> free;
  Eigen::Vector3d force_N, translation_mm;
  double longestMove_mm = 1; ///< in one iteration
};

/// Contact of points of a linear elastic body, x = x0 + C (f - f0), with rigid indenters at tips t + d:
///   g(x_i - t - d) = 0, p_i = f_i . n >= 0 where they touch, f_i = 0 elsewhere,
///   Coulomb: |f_t| <= mu p_i; less: no slip, s_t = 0; equal: f_t opposes the slip s since the start of the load step;
///   sum f_i = F in the directions in which an indenter is free.
/// Solved to rounding by a semismooth Newton method on the forces of the points in contact (primal-dual active sets:
/// Alart and Curnier 1991; Hueeber and Wohlmuth 2005). Why: C, from a factorised tangent, contains all of the body, so
/// the dense systems are as small as the contact. startStep once per load increment, then `solve` in each iteration.
class ReducedContact {
public:
  /// Tips at rest [mm]; `start` is the state at the start of the load step, `positions_mm` the points' positions then.
  ReducedContact(const std::vector<Indenter>& indenters, const std::vector<ContactPoint>& points,
                 Eigen::Matrix3Xd tips_mm);
  void startStep(const Eigen::Matrix3Xd& positions_mm, const ContactState& start);

  /// `positions_mm` are the points' under the state's forces; C is 3 points x 3 points [mm / N]. Returns false without
  /// a solution.
  [[nodiscard]] bool solve(const Eigen::MatrixXd& compliance, const Eigen::Matrix3Xd& positions_mm,
                           const std::vector<ContactTarget>& targets, ContactState& state,
                           const std::stop_token& stop) const;

  /// Largest penetration of a point into its indenter.
  [[nodiscard]] double penetration_mm(const Eigen::Matrix3Xd& positions_mm, const ContactState& state) const;

private:
  /// The conditions of one point, R(f, x - t - d) = 0 [mm], and their derivatives.
  struct Conditions {
    Eigen::Vector3d residual;
    Eigen::Matrix3d byForce, byPlace;
    ContactStatus status = ContactStatus::Open;
  };
  [[nodiscard]] IndenterDistance distanceOf(int point, const Eigen::Vector3d& position_mm,
                                            const Eigen::Matrix3Xd& translations_mm) const;
  [[nodiscard]] Conditions conditions(int point, const Eigen::Vector3d& force, const Eigen::Vector3d& position,
                                      const Eigen::Matrix3Xd& translations, double stiffness, double bySlip) const;
  /// With a factor on the stiffness that weighs slip. On failure the state is unspecified.
  [[nodiscard]] bool solve(const Eigen::MatrixXd& compliance, const Eigen::Matrix3Xd& positions_mm,
                           const std::vector<ContactTarget>& targets, double slipShare, ContactState& state,
                           const std::stop_token& stop) const;

  const std::vector<Indenter>& indenters_;
  const std::vector<ContactPoint>& points_;
  Eigen::Matrix3Xd tips_mm_;
  Eigen::Matrix3Xd startPlaces_mm_; ///< of the points, relative to their indenters' tips
  std::vector<bool> touchedAtStart_;
};

} // namespace palp
