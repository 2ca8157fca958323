#pragma once

#include "io/Decoder.h"
#include "model/SampleSet.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace palp {

/// Cramer-Rao bound of the force for relative noise of the inputs, area known, as % of the force range: root mean
/// square over samples and areas, one entry an output. Without prior: what no unbiased method can beat. With prior: the
/// error of the best linear estimate of a force with the variance range^2 / 12 of one that is uniform over its range,
/// the sensor linear. A decoder that uses the limits of a force's range can be up to about 5 % below
/// (resources/docs/numerics/bounds.md).
struct NoiseBound {
  Eigen::VectorXd withoutPriorPercent; ///< infinite where the inputs do not determine the forces
  Eigen::VectorXd withPriorPercent;
};

/// From samples: J = d x / d F at each sample by a polynomial fit of the inputs in the forces of its area. NaN where an
/// area has fewer samples than a linear fit needs: 8 of three forces. A component that does not vary in the samples is
/// taken as known, and its own entries are NaN.
NoiseBound noiseBound(const SampleSet& samples, InputKind kind, const std::vector<int>& rows, double relativeNoise);

/// Both, one number for each component [% of range]; where there is none, why.
std::string inWords(const NoiseBound& bound);

} // namespace palp
