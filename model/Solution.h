#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <string>
#include <vector>

namespace palp {

/// The residual's norm over the load's norm at this load fraction after a Newton iteration; iteration 0 is the start of
/// a load step.
struct NewtonStep {
  double loadFraction = 0;
  int iteration = 0;
  double relativeResidual = 0;
};

/// Number of touching nodes below which an indenter's depth and contact are not reliable.
constexpr int kFewTouchingNodes = 10;

/// What an indenter does.
struct IndenterState {
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();        ///< of it on the rubber
  Eigen::Vector3d translation_mm = Eigen::Vector3d::Zero(); ///< from first touch of the body at rest
  int touchingNodes = 0;                                    ///< of the mesh; with few of them the rest is wrong
  double contactArea_mm2 = 0;                               ///< of the surface at rest that touches
  double contactRadius_mm = 0;                              ///< of a circle with as wide a spread of the pressure
  double centrePressure_MPa = 0;                            ///< force per area at rest, around the deepest point
  double slipShare = 0;                                     ///< of the contact area
};

/// Equilibrium at a load fraction on the way to the full load.
struct LoadIncrement {
  double loadFraction = 0;
  Eigen::Matrix3Xd displacements_mm;      ///< 3 x nodes
  Eigen::MatrixXd elementUnknowns;        ///< the element's own unknowns (bubble, pressures) x elements
  std::vector<IndenterState> indenters{}; ///< of the load's indenters
  Eigen::Matrix3Xd contactTraction_MPa{}; ///< 3 x nodes, on the surface at rest; empty without indenters
};

/// Result of one nonlinear solve. If Newton's method failed: the last converged state, and the reason. A solve has also
/// converged if its residual, below 1e-6, stagnates at round-off level, which stopReason reports.
struct Solution {
  bool converged = false;
  bool cancelled = false;
  double reachedLoadFraction = 0;
  std::string stopReason; ///< a sentence; empty if converged below the tolerance
  std::vector<NewtonStep> newton;
  std::vector<LoadIncrement> increments;                ///< the state at rest first (load fraction 0), the answer last
  double maxVolumeError = 0;                            ///< largest |J - 1| over the quadrature points
  Eigen::Vector3d reaction_N = Eigen::Vector3d::Zero(); ///< of the clamped face on the block, in the last state

  /// The last converged state.
  [[nodiscard]] const LoadIncrement& state() const { return increments.back(); }
  /// Newton iterations of all load steps, including steps that were given up.
  [[nodiscard]] int iterations() const {
    return static_cast<int>(
        std::count_if(newton.begin(), newton.end(), [](const NewtonStep& step) { return step.iteration > 0; }));
  }
};

/// Fields to be drawn or written, at the nodes (averaged over the elements around a node).
struct NodalFields {
  Eigen::Matrix3Xd displacement_mm;                    ///< 3 x nodes
  Eigen::Matrix<double, 6, Eigen::Dynamic> cauchy_MPa; ///< xx, yy, zz, xy, yz, xz (VTK's order) x nodes
  Eigen::VectorXd pressure_MPa;                        ///< hydrostatic, compression positive
  Eigen::VectorXd vonMises_MPa;
  Eigen::VectorXd volumeRatio;            ///< J = det F
  Eigen::Matrix3Xd principalStretches;    ///< singular values of F, largest first; x nodes
  Eigen::Matrix3Xd contactTraction_MPa{}; ///< as in LoadIncrement
};

} // namespace palp
