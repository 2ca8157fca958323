#pragma once

#include "solver/HyperelasticProblem.h"
#include "solver/contact/ContactSteps.h"
#include "solver/contact/ReducedContact.h"
#include "solver/statics/NewtonSolver.h"

namespace palp {

/// An equilibrium with indenters along the load path.
struct ContactIncrement {
  EquilibriumState equilibrium;
  ContactState contact;
};

struct ContactResult {
  NewtonResult newton; ///< its increments are empty
  std::vector<ContactPoint> points;
  std::vector<ContactIncrement> increments; ///< at rest first
};

/// Newton's method for one load path with indenters. In each iteration the rubber is linear and the contact is not: the
/// tangent is factorised with the candidate points' unknowns last, so that the factor contains their exact compliance,
/// and contact and friction are solved with it to convergence (ReducedContact). So changes of contact and slip cost no
/// factorisation, and the iteration converges like Newton's method without contact.
///
/// Nesting: solve (candidate points, enlarged until they suffice) > follow (load increments, halved on failure; with
/// the tangential translation held as a fallback, TangentialControl) > step (iterations, with a new tangent where the
/// old one contracts too slowly). Where to read more: resources/docs/numerics/contact.md.
class ContactSolver {
public:
  /// A path of loads of the same indenters (whyInvalid of a path in model/LoadCase.h).
  ContactSolver(const Assembler& assembler, const Mesh& mesh, const SensorDesign& design,
                const std::vector<LoadCase>& path, NewtonOptions options, NewtonObserver observer);
  /// Returns one result per load, up to the first that fails; the increments of each start at the end of the previous
  /// one. Throws DesignError where an indenter meets no point of the mesh.
  [[nodiscard]] std::vector<ContactResult> solve();

private:
  using Outcome = StepOutcome;
  struct State {
    ElementState rubber;
    ContactState contact;
  };

  void choosePoints(double margin);
  [[nodiscard]] ContactIncrement atRest() const;
  void beginLoad(std::size_t load);
  [[nodiscard]] ContactResult follow(const ContactIncrement& start);
  [[nodiscard]] Outcome step(double from, double to, State& state, TangentialControl control);
  [[nodiscard]] std::string whyHard(const ContactState& reached) const;
  [[nodiscard]] bool anyForceWithFriction() const;
  [[nodiscard]] Outcome newTangent(double fraction, const State& state);
  void setResidual(double fraction, const State& state);
  [[nodiscard]] Indenter partOf(std::size_t indenter, double fraction) const;
  [[nodiscard]] std::vector<ContactTarget> targets(double fraction) const;
  [[nodiscard]] Eigen::Matrix3Xd positions(const Eigen::VectorXd& displacements) const;
  [[nodiscard]] Eigen::VectorXd onFreeComponents(const Eigen::Matrix3Xd& forces) const;
  [[nodiscard]] bool touchesBeyond(const State& state) const;
  [[nodiscard]] bool tangentWillDo(double previous) const;
  void record(double fraction, int iteration);
  [[nodiscard]] bool stopped() const { return observer_.stop.stop_requested(); }

  const Assembler& assembler_;
  const Mesh& mesh_;
  const SensorDesign& design_;
  const std::vector<LoadCase>& path_;
  const std::vector<Indenter>& indenters_; ///< the first load's; those of the others differ only in their control
  NewtonOptions options_;
  NewtonObserver observer_;
  std::vector<ContactPoint> points_;
  Eigen::Matrix3Xd tips_mm_;
  std::optional<ReducedContact> contact_;
  std::optional<SparseCholesky> cholesky_;
  Eigen::MatrixXd compliance_; ///< between the points
  bool tangentServes_ = false; ///< whether the next step starts with the tangent of the previous one
  int charged_ = 0;            ///< iterations that a newer tangent would have saved
  ElementTangents tangents_;
  ElementForces forces_;
  Eigen::VectorXd internal_; ///< raw forces of all components
  Eigen::VectorXd residual_; ///< free components, condensed
  double relative_ = 1;
  std::vector<NewtonStep> steps_;
  std::size_t now_ = 0;                   ///< number of the load in the path
  std::vector<ContactEstimate> expected_; ///< for this load
  Eigen::VectorXd before_, forces_N_; ///< of areas and discs on all components: at the start of this load, and of it
};

} // namespace palp
