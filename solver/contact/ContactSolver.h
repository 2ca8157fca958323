#pragma once

#include "solver/HyperelasticProblem.h"
#include "solver/contact/ContactEstimate.h"
#include "solver/contact/ReducedContact.h"
#include "solver/statics/NewtonSolver.h"

namespace palp {

/// An equilibrium with indenters on the way.
struct ContactIncrement {
  EquilibriumState equilibrium;
  ContactState contact;
};

struct ContactResult {
  NewtonResult newton; ///< its increments are empty
  std::vector<ContactPoint> points;
  std::vector<ContactIncrement> increments; ///< at rest first
};

/// Newton's method with indenters. In each iteration the rubber is linear and the contact is not: the tangent is
/// factorised with the touchable points' unknowns last, so that their compliance is exact and comes for nothing, and
/// contact and friction are solved with it to the end (ReducedContact). So active points and slip cost no
/// factorisation, and it converges like Newton's method without contact.
class ContactSolver {
public:
  /// Loads of the same indenters, one after another (whyInvalid of a path in model/LoadCase.h).
  ContactSolver(const Assembler& assembler, const Mesh& mesh, const SensorDesign& design,
                const std::vector<LoadCase>& path, NewtonOptions options, NewtonObserver observer);
  /// A result a load, up to the first that is not reached; the increments of a later one begin with the end of the one
  /// before. Throws DesignError where an indenter meets no point of the mesh.
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
  /// Indenters that are free to go sideways are so, or stay for the moment where they are.
  enum class Sideways { AsLoaded, Held };
  [[nodiscard]] Outcome step(double from, double to, State& state, Sideways sideways);
  [[nodiscard]] std::string whyHard(const ContactState& reached) const;
  [[nodiscard]] bool frictionHoldsSome() const;
  [[nodiscard]] Outcome newTangent(double fraction, const State& state);
  void setResidual(double fraction, const State& state);
  [[nodiscard]] Indenter partOf(std::size_t indenter, double fraction) const;
  [[nodiscard]] std::vector<ContactTarget> targets(double fraction) const;
  [[nodiscard]] Eigen::Matrix3Xd positions(const Eigen::VectorXd& displacements) const;
  [[nodiscard]] Eigen::VectorXd onFreeComponents(const Eigen::Matrix3Xd& forces) const;
  [[nodiscard]] bool reachesBeyond(const State& state) const;
  [[nodiscard]] bool tangentWillDo(double previous) const;
  void record(double fraction, int iteration);
  [[nodiscard]] bool stopped() const { return observer_.stop.stop_requested(); }

  const Assembler& assembler_;
  const Mesh& mesh_;
  const SensorDesign& design_;
  const std::vector<LoadCase>& path_;
  const std::vector<Indenter>& indenters_; ///< the first load's; the others' are the same but for what they do
  NewtonOptions options_;
  NewtonObserver observer_;
  std::vector<ContactPoint> points_;
  Eigen::Matrix3Xd tips_mm_;
  std::optional<ReducedContact> contact_;
  std::optional<SparseCholesky> cholesky_;
  Eigen::MatrixXd compliance_; ///< between the points
  bool tangentServes_ = false; ///< that of the step before also the next
  int charged_ = 0;            ///< iterations of load steps that a newer tangent would have spared
  ElementTangents tangents_;
  ElementForces forces_;
  Eigen::VectorXd internal_; ///< raw forces of all components
  Eigen::VectorXd residual_; ///< free components, condensed
  double relative_ = 1;
  std::vector<NewtonStep> steps_;
  std::size_t now_ = 0;                   ///< the load of the path
  std::vector<ContactEstimate> expected_; ///< of it
  Eigen::VectorXd before_, forces_N_; ///< of areas and discs on all components: at the start of this load, and of it
};

} // namespace palp
