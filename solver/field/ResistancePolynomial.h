#pragma once

#include "model/SensorDesign.h"
#include "solver/batch/ForcePolynomial.h"

#include <Eigen/Core>

#include <vector>

namespace palp {

/// Polynomial in the force on one area for d ln R of all readings. The last few of the states that it is made of are
/// kept from its fit and measure its error.
class ResistancePolynomial {
public:
  /// How many states a degree takes, those that are kept among them.
  static int statesFor(int degree);
  static constexpr int lowestDegree = 2, highestDegree = 4;

  /// `changes`: d ln R (readings) x forces.
  ResistancePolynomial(const ForceRange& range, int degree, const std::vector<Eigen::Vector3d>& forces_N,
                       const Eigen::MatrixXd& changes);

  [[nodiscard]] Eigen::VectorXd at(const Eigen::Vector3d& force_N) const {
    return coefficients_ * polynomial_.monomials(force_N);
  }
  /// Largest relative error, rms over all readings.
  [[nodiscard]] double error() const { return error_; }

private:
  ForcePolynomial polynomial_;
  Eigen::MatrixXd coefficients_;
  double error_ = 0;
};

} // namespace palp
