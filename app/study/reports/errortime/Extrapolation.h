#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace palp {

/// What three meshes say of the answer of an endlessly fine one.
struct Extrapolation {
  Eigen::VectorXd value;
  double order = 0;       ///< of the error in the mesh size, as the meshes show it; taken as 0.5 at least and 4 at most
  double uncertainty = 0; ///< relative: the value against that of the finest mesh
};

/// Richardson's extrapolation from the answers of meshes whose sizes fall by `refinement`.
inline Extrapolation extrapolated(const Eigen::VectorXd& coarse, const Eigen::VectorXd& middle,
                                  const Eigen::VectorXd& fine, double refinement) {
  Extrapolation result;
  const double ratio = (coarse - middle).norm() / (middle - fine).norm();
  result.order = std::clamp(std::log(ratio) / std::log(refinement), 0.5, 4.0);
  result.value = fine + (fine - middle) / (std::pow(refinement, result.order) - 1);
  result.uncertainty = (result.value - fine).norm() / result.value.norm();
  return result;
}

/// From the finest three neighbours that have an answer (the others are empty), the finest last; none where there are
/// no such three.
inline std::optional<Extrapolation> extrapolated(const std::vector<Eigen::VectorXd>& answers, double refinement) {
  for (std::size_t fine = answers.size(); fine-- > 2;) {
    const Eigen::VectorXd &coarse = answers[fine - 2], &middle = answers[fine - 1];
    if (coarse.size() > 0 && middle.size() > 0 && answers[fine].size() > 0)
      return extrapolated(coarse, middle, answers[fine], refinement);
  }
  return {};
}

/// The same from two meshes where their sizes differ too little for an order to be seen, with one that is known.
inline Extrapolation extrapolated(const Eigen::VectorXd& coarse, const Eigen::VectorXd& fine, double refinement,
                                  double order) {
  Extrapolation result;
  result.order = order;
  result.value = fine + (fine - coarse) / (std::pow(refinement, order) - 1);
  result.uncertainty = (result.value - fine).norm() / result.value.norm();
  return result;
}

} // namespace palp
