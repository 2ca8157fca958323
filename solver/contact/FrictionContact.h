#pragma once

#include "solver/contact/ContactSteps.h"
#include "solver/contact/LaneContact.h"
#include "solver/contact/ReducedContact.h"
#include "solver/contact/TopCompliance.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace palp {

/// Contact with friction of one load of a batch (ReducedContact), with the compliance of the nodes by the tangent at
/// rest: in the same steps of the load as ContactSolver, each from the equilibrium of the one before.
class FrictionContact final : public LaneContact {
public:
  FrictionContact(std::vector<Indenter> indenters, std::shared_ptr<const TopCompliance> top, const Mesh& mesh,
                  const SensorDesign& design);

  [[nodiscard]] bool solve(const Eigen::Matrix3Xd& motion_mm, const std::stop_token& stop) override;
  [[nodiscard]] std::vector<NodeForce> forces() const override;
  [[nodiscard]] Way settled(const Eigen::Matrix3Xd& motion_mm) override;
  [[nodiscard]] bool turned() override { return std::exchange(turned_, false); }
  [[nodiscard]] bool straightOn() const override;

private:
  void choosePoints(double margin);
  void beginStep(const Eigen::Matrix3Xd& motion_mm);
  void widen();
  [[nodiscard]] bool slid() const { return slidAway(indenters_, expected_, start_, state_); }
  [[nodiscard]] bool hold();
  void letGo(const Eigen::Matrix3Xd& motion_mm);
  [[nodiscard]] std::vector<Indenter> partsAt(double fraction) const;
  [[nodiscard]] Eigen::Matrix3Xd positions(const Eigen::Matrix3Xd& motion_mm) const;
  [[nodiscard]] bool reachesBeyond(const Eigen::Matrix3Xd& motion_mm) const;

  std::vector<Indenter> indenters_;
  std::shared_ptr<const TopCompliance> top_;
  const Mesh& mesh_;
  const SensorDesign& design_;
  std::vector<ContactPoint> points_; ///< that may be touched
  std::vector<int> numbers_;         ///< of the points' nodes in the compliance
  Eigen::Matrix3Xd tips_mm_;
  std::vector<ContactEstimate> expected_;
  Eigen::MatrixXd compliance_; ///< between the points
  std::optional<ReducedContact> contact_;
  std::vector<ContactTarget> targets_; ///< of the step in work
  int step_ = 1, steps_ = 1;
  /// As ContactSolver, where indenters that are free to go aside slide away or find no place.
  enum class Sideways { AsLoaded, Held, LetGo };
  Sideways sideways_ = Sideways::AsLoaded;
  bool turned_ = false;
  int widened_ = 0; ///< times that there were more points than had been foreseen
  double margin_ = touchableMargin;
  Eigen::Matrix3Xd startMotion_mm_;        ///< of all nodes of the compliance, where slip is counted from
  ContactState start_, slipStart_, state_; ///< at the start of the step, where slip is counted from, and now
};

} // namespace palp
