#pragma once

#include "solver/contact/ContactEstimate.h"
#include "solver/contact/ReducedContact.h"

#include <span>
#include <vector>

namespace palp {

/// Load increments for contact: friction is path-dependent, so a load with friction is applied in increments.
/// ContactSolver and the batch use the same ones, so that they find the same equilibrium.
inline constexpr double touchableMargin = 1.3; ///< times the expected depth, for the candidate points
inline constexpr double marginGrowth = 1.6;    ///< times the previous margin, where other points were touched
inline constexpr int mostMargins = 5;
inline constexpr double penetrationOfHeight =
    5e6; ///< block height / this: another point that penetrates deeper counts as touched

/// Tangential control of force-controlled indenters with friction: their force is prescribed; their translation is
/// held, as a fallback where they slide away or find no equilibrium while they come down; released again after that.
enum class TangentialControl { Force, Displacement, Free };

/// Returns the largest load increment. `fromRest`: the first load of a path, in which normal loading may precede
/// tangential loading.
double largestContactStep(const std::vector<Indenter>& indenters, bool fromRest);

/// Estimates for each indenter.
std::vector<ContactEstimate> contactEstimates(const std::vector<Indenter>& indenters, const SensorDesign& design);

/// Prescribed forces and translations of indenters at `parts` of their load; `expected` is of their complete load.
std::vector<ContactTarget> contactTargets(const std::vector<Indenter>& parts,
                                          std::span<const ContactEstimate> expected);

/// Holds the tangentially free indenters of `targets` at their translations in `state`; false if there are none.
bool constrainTangentially(std::vector<ContactTarget>& targets, const ContactState& state);

/// Whether a position is deeper than `allowed_mm` inside an indenter; tips 3 x indenters.
bool penetrates(const std::vector<Indenter>& indenters, const Eigen::Matrix3Xd& tips_mm,
                const Eigen::Vector3d& position_mm, double allowed_mm);

/// Whether a force-controlled indenter with friction has slid off its position (gross slip).
bool slidAway(const std::vector<Indenter>& indenters, std::span<const ContactEstimate> expected,
              const ContactState& from, const ContactState& to);

/// State without contact, for these numbers of points and indenters.
ContactState untouched(std::size_t points, std::size_t indenters);

} // namespace palp
