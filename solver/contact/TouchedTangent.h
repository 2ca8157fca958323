#pragma once

#include "solver/statics/ProblemParts.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <stop_token>

namespace palp {

/// The tangent at rest for touches in a part of the top face: the nodes that may be touched are eliminated last, so
/// that their compliance comes with the factor, and contact is answered between the two ways of one substitution.
struct TouchedTangent {
  std::shared_ptr<InitialTangent> rest; ///< its factor substitutes alone: what refines a solution is given back
  Eigen::MatrixXf compliance;           ///< blocks of TopCompliance
};

/// Whether so many nodes may be eliminated last: of more, the full matrix between them is the larger part of the
/// factor.
[[nodiscard]] bool canBeLast(const Mesh& mesh, const Rectangle& touched);
/// Empty: stopped.
[[nodiscard]] std::optional<TouchedTangent> touchedTangent(const HyperelasticProblem::Parts& parts,
                                                           const Rectangle& touched, int threads,
                                                           const std::stop_token& stop);

} // namespace palp
