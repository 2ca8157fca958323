#pragma once

#include "solver/statics/LinearisedBlock.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <stop_token>

namespace palp {

/// The tangent at rest for touches in a part of the top face: the nodes that may be touched are eliminated last, so
/// that the factor contains their compliance, and contact is solved between the forward and the backward sweep.
struct TouchedTangent {
  std::shared_ptr<InitialTangent>
      rest;                   ///< with the factor alone: the matrix, which only refines solutions, is released
  Eigen::MatrixXf compliance; ///< blocks of TopCompliance
};

/// Whether the nodes in `touched` are few enough to be eliminated last: beyond that their dense matrix is the larger
/// part of the factor.
[[nodiscard]] bool canBeLast(const Mesh& mesh, const Rectangle& touched);
/// Returns nullopt if cancelled.
[[nodiscard]] std::optional<TouchedTangent> touchedTangent(const LinearisedBlock& linearised, const Rectangle& touched,
                                                           int threads, const std::stop_token& stop);

} // namespace palp
