#pragma once

#include "model/field/FaceGrid.h"

#include <Eigen/Core>

#include <array>
#include <stop_token>
#include <vector>

namespace palp {

/// Point sources and dipoles at the electrodes: column w of each is an excitation (1 V on wire w).
struct ElectrodeSources {
  Eigen::Matrix3Xd electrodes_mm;
  Eigen::MatrixXd currents;               ///< electrodes x wires
  std::array<Eigen::MatrixXd, 3> dipoles; ///< moments along x, y, z, electrodes x wires; empty: none
};

/// For each motion n of the face along its outward normal (points x motions, points as FaceGrid's):
///   - oint (grad phi_a . grad phi_b + grad phi_a . grad psi_b + grad psi_a . grad phi_b) n dS,
/// phi the potential of the currents and psi that of the dipoles in the insulated box of conductivity 1; wires x wires,
/// symmetric. Along an insulated face gradients lie in the face. (J. Hadamard, Memoire sur le probleme d'analyse
/// relatif a l'equilibre des plaques elastiques encastrees, 1908: how Green's function follows the boundary.)
/// Throws Cancelled where it was stopped.
std::vector<Eigen::MatrixXd> faceChanges(const Eigen::Vector3d& block_mm, const FaceGrid& face,
                                         const ElectrodeSources& sources,
                                         const Eigen::Ref<const Eigen::MatrixXd>& motions, int threads,
                                         const std::stop_token& stop);

/// For motions that are not known yet: what multiplies the motion of each point of the face in sums of those changes'
/// entries. `sums` has the coefficients of each sum in a column, a row for each pair of wires a <= b (by b; an entry
/// and its mirror count as one); points x sums. Throws Cancelled where it was stopped.
Eigen::MatrixXd faceWeights(const Eigen::Vector3d& block_mm, const FaceGrid& face, const ElectrodeSources& sources,
                            const Eigen::Ref<const Eigen::MatrixXd>& sums, int threads, const std::stop_token& stop);

} // namespace palp
