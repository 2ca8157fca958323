#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <stop_token>

namespace palp {

/// `copies` columns for each sample, in a row: x (1 + relative * standard normal) for each input. One copy of relative
/// noise 0 is the sample itself. Repeats for equal seeds. Throws Cancelled between samples.
Eigen::MatrixXd noisyCopies(const Eigen::Ref<const Eigen::MatrixXd>& samples, double relative, int copies,
                            std::uint64_t seed, const std::stop_token& stop = {});

} // namespace palp
