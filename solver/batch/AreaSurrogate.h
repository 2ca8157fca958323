#pragma once

#include "solver/batch/BatchEngine.h"

namespace palp {

/// Polynomial in the force on one area for what the electrodes feel, fitted to full solves; its degree is the smallest
/// whose error on forces it has not seen is below the tolerance, or the best up to 6.
class AreaSurrogate {
public:
  /// Of each of these areas, solved together so that there is work for all threads. None: stopped, or one of the fit's
  /// loads has no solution.
  static std::vector<std::optional<AreaSurrogate>> fit(BatchEngine& engine, const SensorDesign& design,
                                                       std::span<const int> areas, double tolerance,
                                                       const std::stop_token& stop);

  /// Answers to up to 8 forces.
  [[nodiscard]] std::vector<ElectrodeDisplacements> evaluate(std::span<const Eigen::Vector3d> forces_N) const;
  /// Largest relative error of the electrode displacements on the forces kept from the fit.
  [[nodiscard]] double error() const { return error_; }
  [[nodiscard]] int degree() const { return degree_; }

private:
  AreaSurrogate(const ForceRange& range, int degree, const std::vector<Eigen::Vector3d>& forces_N,
                const std::vector<ElectrodeDisplacements>& answers);

  ForcePolynomial polynomial_;
  int degree_;
  double error_ = 0;
  Eigen::Index upper_, lower_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> coefficients_; ///< one row a number
};

/// Relative difference of the upper electrodes' displacements.
double relativeDifference(const ElectrodeDisplacements& a, const ElectrodeDisplacements& reference);

} // namespace palp
