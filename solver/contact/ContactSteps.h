#pragma once

#include "solver/contact/ContactEstimate.h"
#include "solver/contact/ReducedContact.h"

#include <span>
#include <vector>

namespace palp {

/// How a load with indenters is taken: in parts where there is friction, which depends on the way. ContactSolver and
/// the batch go the same way, so that they find the same.
inline constexpr double touchableMargin = 1.3; ///< of the expected depth, for the points that may be touched
inline constexpr double widerMargin = 1.6;     ///< times the one before, where others were met
inline constexpr int mostMargins = 5;
inline constexpr double beyondReachOfHeight = 5e6; ///< a height over it: deeper a point not foreseen is touched

/// Largest part of the load in one step. `fromRest`: the first of a path, which may go down first and then aside.
double largestContactStep(const std::vector<Indenter>& indenters, bool fromRest);

/// What is expected of each.
std::vector<ContactEstimate> contactEstimates(const std::vector<Indenter>& indenters, const SensorDesign& design);

/// What the indenters are made to do in `parts` of their load; `expected` is of their whole load.
std::vector<ContactTarget> contactTargets(const std::vector<Indenter>& parts,
                                          std::span<const ContactEstimate> expected);

/// Whether an indenter that friction is to hold has left the place that it presses on.
bool slidAway(const std::vector<Indenter>& indenters, std::span<const ContactEstimate> expected,
              const ContactState& from, const ContactState& to);

/// Nothing pressed yet, of so many points.
ContactState untouched(std::size_t points, std::size_t indenters);

} // namespace palp
