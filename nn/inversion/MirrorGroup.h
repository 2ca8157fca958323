#pragma once

// Private to nn: the action of a body's mirrors on its measurements.

#include "nn/inversion/KernelInversion.h"

#include <Eigen/Core>

#include <bit>
#include <vector>

namespace palp {

/// All products of mirrors, which commute and undo themselves. An element is the set of the mirrors in it, as bits. Any
/// function of the parameters is a sum of parts with a parity each, one part per element: under an element a part
/// keeps or changes its sign (J.-P. Serre, Linear Representations of Finite Groups, 1977, 2.6, 3.1).
class MirrorGroup {
public:
  /// Throws NetworkError where a mirror does not fit these numbers of measurements and parameters.
  MirrorGroup(const std::vector<KernelMirror>& mirrors, Eigen::Index measurements, Eigen::Index parameters);

  [[nodiscard]] int size() const { return static_cast<int>(order_.size()); }
  static double sign(int parity, int element) {
    return std::popcount(static_cast<unsigned>(parity & element)) % 2 == 0 ? 1 : -1;
  }
  /// The part of measurements (a row each) that has the parity.
  [[nodiscard]] Eigen::MatrixXd part(const Eigen::MatrixXd& measurements, int parity) const;
  /// Parameters (a row each) of the images.
  [[nodiscard]] Eigen::MatrixXd image(Eigen::MatrixXd parameters, int element) const;

private:
  std::vector<std::vector<Eigen::Index>> order_; ///< of each element: the measurement whose value each one takes
  std::vector<KernelMirror> mirrors_;
};

} // namespace palp
