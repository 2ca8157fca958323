#pragma once

#include "io/Decoder.h"

#include <Eigen/Core>

#include <string>

namespace palp {

/// A sentence that names the inputs that stay the same over all samples: broken wires, dead channels. Empty where all
/// vary.
std::string constantInputs(const DecoderInput& input, const Eigen::Ref<const Eigen::MatrixXd>& inputs);

} // namespace palp
