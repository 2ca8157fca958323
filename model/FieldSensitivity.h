#pragma once

#include "model/FieldAtRest.h"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

namespace palp {

struct BoxGreen;
struct ElectrodeSources;
struct FaceGrid;

/// A small motion of the sensor: what its resistances follow.
struct SensorMotion {
  Eigen::Matrix3Xd electrodes_mm; ///< displacements 3 x electrodes in the order of WireCounts; 0 where one is held
  Eigen::VectorXd faces_mm;       ///< outward along the normal, at each of FieldSensitivity::facePoints_mm
};

/// What each reading (row-wire + row-wires * column-wire) makes of such motions: d ln R per mm of an electrode's
/// displacement (readings x 3 electrodes, x, y, z of the first one first), and per mm of the outward motion of each
/// point of the faces (readings x points; the points' shares of the faces are in it).
struct ReadingGradient {
  Eigen::MatrixXd electrodes_per_mm;
  Eigen::MatrixXd faces_per_mm;
};

/// How the resistances of a sensor at rest follow small motions of its electrodes and of its insulated faces, exactly
/// to first order and without a mesh (resources/docs/numerics/field-at-rest.md).
class FieldSensitivity {
public:
  /// `fineness` divides the panels of the quadrature over the faces; 1 leaves about 1e-4 of d ln R, 2 about 1e-6.
  /// `threads` 0: all cores, the same bytes at any number.
  FieldSensitivity(const SensorDesign& design, const FieldLaw& law, SphereModel model = SphereModel::Dipoles,
                   double fineness = 1, int threads = 1);
  ~FieldSensitivity();
  FieldSensitivity(FieldSensitivity&&) noexcept;

  [[nodiscard]] const TerminalNetwork& network() const { return network_; }
  /// 3 x points on all faces but the bottom, which is fixed, and the outward normal at each.
  [[nodiscard]] const Eigen::Matrix3Xd& facePoints_mm() const { return facePoints_mm_; }
  [[nodiscard]] const Eigen::Matrix3Xd& faceNormals() const { return faceNormals_; }

  /// dY [1/ohm] of the network (wires x wires) for each motion; `threads` 0: all cores, the same bytes at any number.
  /// Throws Cancelled where it was stopped.
  [[nodiscard]] std::vector<Eigen::MatrixXd> conductanceChanges(std::span<const SensorMotion> motions, int threads = 0,
                                                                const std::stop_token& stop = {}) const;
  /// The same the other way round: what each reading makes of any motion, without one. Throws Cancelled.
  [[nodiscard]] ReadingGradient readingGradient(Readout readout, int threads = 0,
                                                const std::stop_token& stop = {}) const;

private:
  FieldSensitivity(SensorDesign design, const FieldLaw& law, SphereModel model, double fineness, const BoxGreen& green);
  [[nodiscard]] ElectrodeSources sources() const;
  [[nodiscard]] Eigen::MatrixXd ofElectrodes(const Eigen::Matrix3Xd& motion_mm) const;

  SensorDesign design_;
  FieldLaw law_;
  TerminalNetwork network_;
  double dipole_;                           ///< 4 pi a^3, or 0
  std::array<Eigen::MatrixXd, 3> gradient_; ///< at each electrode, of all others and of its own images; a wire a column
  std::array<Eigen::MatrixXd, 3>
      totalGradient_; ///< factor of an electrode's current as it is displaced: with the induced dipoles
  std::array<Eigen::MatrixXd, 6> curvature_; ///< second derivatives at each electrode of the potential of all others
  std::vector<FaceGrid> faces_;
  Eigen::Matrix3Xd facePoints_mm_, faceNormals_;
};

} // namespace palp
