#pragma once

#include "solver/contact/ColumnContact.h"
#include "solver/contact/ContactSteps.h"
#include "solver/contact/ReducedContact.h"
#include "solver/contact/TopCompliance.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace palp {

/// Contact with friction of one load of a batch (ReducedContact), with the nodes' compliance from the tangent at rest,
/// in the same load increments as ContactSolver, each from the equilibrium of the previous one. ColumnContact.h has the
/// order of calls. Within an increment the control of force-controlled indenters is
///   Force --(no equilibrium, or gross slip)--> Displacement --(converged)--> Free --(converged)--> next increment
/// and converges directly from Force where friction holds them.
class FrictionContact final : public ColumnContact {
public:
  FrictionContact(std::vector<Indenter> indenters, std::shared_ptr<const TopCompliance> top, const Mesh& mesh,
                  const SensorDesign& design);

  [[nodiscard]] bool solve(const Eigen::Matrix3Xd& motion_mm, const std::stop_token& stop) override;
  [[nodiscard]] std::vector<NodeForce> forces() const override;
  [[nodiscard]] StepResult finishIncrement(const Eigen::Matrix3Xd& motion_mm) override;
  [[nodiscard]] bool modeChanged() override { return std::exchange(modeChanged_, false); }
  [[nodiscard]] bool extrapolates() const override;

private:
  void choosePoints(double margin);
  void beginStep(const Eigen::Matrix3Xd& motion_mm);
  void extendCandidates();
  [[nodiscard]] bool slid() const { return slidAway(indenters_, expected_, start_, state_); }
  [[nodiscard]] bool constrain();
  void release(const Eigen::Matrix3Xd& motion_mm);
  [[nodiscard]] std::vector<Indenter> partsAt(double fraction) const;
  [[nodiscard]] Eigen::Matrix3Xd positions(const Eigen::Matrix3Xd& motion_mm) const;
  [[nodiscard]] bool touchesBeyond(const Eigen::Matrix3Xd& motion_mm) const;

  std::vector<Indenter> indenters_;
  std::shared_ptr<const TopCompliance> top_;
  const Mesh& mesh_;
  const SensorDesign& design_;
  std::vector<ContactPoint> points_; ///< candidates
  std::vector<int> numbers_;         ///< numbers of the points' nodes in the compliance
  Eigen::Matrix3Xd tips_mm_;
  std::vector<ContactEstimate> expected_;
  Eigen::MatrixXd compliance_; ///< between the points
  std::optional<ReducedContact> contact_;
  std::vector<ContactTarget> targets_; ///< of the present increment
  int step_ = 1, steps_ = 1;
  TangentialControl tangential_ = TangentialControl::Force;
  bool modeChanged_ = false;
  int extensions_ = 0; ///< number of times that the candidates were extended
  double margin_ = touchableMargin;
  Eigen::Matrix3Xd startMotion_mm_;        ///< of all nodes of the compliance, at the reference of slip
  ContactState start_, slipStart_, state_; ///< at the start of the increment, at the reference of slip, and now
};

} // namespace palp
