#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <stop_token>

namespace palp {

/// `copies` adjacent columns for each sample: x (1 + relative * standard normal) for each input. One copy with noise 0
/// is the sample itself. The same for the same seed. Throws Cancelled between samples.
Eigen::MatrixXd noisyCopies(const Eigen::Ref<const Eigen::MatrixXd>& samples, double relative, int copies,
                            std::uint64_t seed, const std::stop_token& stop = {});

} // namespace palp
