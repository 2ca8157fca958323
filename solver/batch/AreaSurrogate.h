#pragma once

#include "solver/batch/BatchEngine.h"

namespace palp {

/// Polynomial in the force on one area for displacements and pressures at the electrodes, fitted to full solves; its
/// degree is the smallest whose error on held-out forces is below the tolerance, or the best up to 6.
class AreaSurrogate {
public:
  /// Fits the surrogates of these areas together, so that all threads have work. nullopt: cancelled, or a load of the
  /// fit has no solution.
  static std::vector<std::optional<AreaSurrogate>> fit(BatchEngine& engine, const SensorDesign& design,
                                                       std::span<const int> areas, double tolerance,
                                                       const std::stop_token& stop);

  /// Answers to up to 8 forces.
  [[nodiscard]] std::vector<ElectrodeDisplacements> evaluate(std::span<const Eigen::Vector3d> forces_N) const;
  /// Largest relativeDifference on the held-out forces.
  [[nodiscard]] double error() const { return error_; }
  [[nodiscard]] int degree() const { return degree_; }

private:
  AreaSurrogate(const SensorDesign& design, int degree, const std::vector<Eigen::Vector3d>& forces_N,
                const std::vector<ElectrodeDisplacements>& answers);

  ForcePolynomial polynomial_;
  int degree_;
  double error_ = 0;
  Eigen::Index upper_, lower_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> coefficients_; ///< one row per output
};

/// Returns the largest relative difference of the quantities that a design's readings depend on: the upper electrodes'
/// displacements; those of the lower ones where they follow the rubber, relative to the upper ones'; pressures where
/// there is a pressure law, relative to theirs and its p0; and with either of these the resistances by Eq. (1), d ln R
/// against what the load changes.
double relativeDifference(const ElectrodeDisplacements& a, const ElectrodeDisplacements& reference,
                          const SensorDesign& design);

} // namespace palp
