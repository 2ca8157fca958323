#pragma once

#include "model/Solution.h"
#include "solver/contact/ContactSolver.h"

namespace palp {

/// State of each indenter; `positions_mm` are the points' (3 x points).
std::vector<IndenterState> indenterStates(const LoadCase& load, const Mesh& mesh,
                                          const std::vector<ContactPoint>& points, const ContactState& state,
                                          const Eigen::Matrix3Xd& positions_mm);

/// Traction on the surface at rest at all nodes (3 x nodes): at a point its force over its area, at a face's other
/// nodes the mean of the neighbouring points'.
Eigen::Matrix3Xd contactTractions_MPa(const Mesh& mesh, const std::vector<ContactPoint>& points,
                                      const ContactState& state);

} // namespace palp
