#pragma once

#include "nn/linear/RandomNumbers.h"

#include <Eigen/Core>

#include <cmath>

namespace palp::test {

/// A smooth, slightly nonlinear map that looks like the sensor's: six places, each with its own linear answer to three
/// parameters (a smooth bump around the place) and 2 % of quadratic terms.
struct Touches {
  Eigen::MatrixXd samples; ///< inputs x samples
  Eigen::MatrixXd targets; ///< 3 x samples
  Eigen::VectorXi places;
};

inline Touches touches(int perPlace, int inputs, std::uint64_t seed) {
  RandomNumbers random(seed);
  Touches set{Eigen::MatrixXd(inputs, 6 * perPlace), Eigen::MatrixXd(3, 6 * perPlace), Eigen::VectorXi(6 * perPlace)};
  for (Eigen::Index i = 0; i < set.samples.cols(); ++i) {
    const int place = static_cast<int>(i % 6);
    const Eigen::Vector3d parameter(2 * random.uniform() - 1, 2 * random.uniform() - 1, -6 * random.uniform());
    set.places(i) = place;
    set.targets.col(i) = parameter;
    for (int d = 0; d < inputs; ++d) {
      const double distance = (d + 0.5) / inputs * 6 - place - 0.5;
      const double bump = std::exp(-distance * distance), slope = distance * bump;
      const double linear = bump * parameter.z() / 6 + slope * parameter.x() + std::cos(1.3 * d) * bump * parameter.y();
      set.samples(d, i) = 100 + linear + 0.02 * linear * linear + 0.02 * slope * parameter.x() * parameter.z();
    }
  }
  return set;
}

/// Root mean square error of each target over its standard deviation, the largest.
inline double worstRelativeError(const Eigen::MatrixXd& predicted, const Eigen::MatrixXd& truth) {
  const Eigen::VectorXd mean = truth.rowwise().mean();
  const Eigen::ArrayXd error = (predicted - truth).array().square().rowwise().mean().sqrt();
  return (error / (truth.colwise() - mean).array().square().rowwise().mean().sqrt()).maxCoeff();
}

} // namespace palp::test
