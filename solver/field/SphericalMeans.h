#pragma once

#include "solver/field/FieldFunctions.h"
#include "solver/field/FieldMesh.h"

#include <Eigen/Core>

namespace palp {

/// l = ln(k) / 2 at an electrode, a sphere of radius a. Inside of it k has no effect, so l may be replaced there by the
/// harmonic function with its values on the sphere: where k has a kink in the sphere or near it, the value and slope of
/// l at the centre alone are not representative.
struct AtElectrode {
  double value = 0;                                ///< mean of l over the sphere
  Eigen::Vector3d slope = Eigen::Vector3d::Zero(); ///< gradient of that function in the centre [1/mm]
  int element = 0;                                 ///< host element of the centre, and its functions there
  FieldFunctions::Point there{};
  /// Integrals of grad l . grad(s) chi [1/mm] and grad l . grad(s^2) chi [1/mm2] over a < r < cutoff, with s = 1/(4 pi
  /// r) and chi = cutOff((r / cutoff)^2).
  double simple = 0, square = 0;

  /// From 1 in the centre to 0 at the cutoff radius: (1 - square)^2, with the square of the distance over that radius.
  static double cutOff(double square) { return square < 1 ? (1 - square) * (1 - square) : 0; }
};

/// Computes these from the means L(r) of l over spheres around the electrode in the deformed block: with L alone
///   integral grad l . grad(s) chi = integral (L - L(a)) chi' dr,
///   integral grad l . grad(s^2) chi = 1 / (2 pi) integral (L - L(a)) (chi / r)' dr,
/// whose poles of second and third order are gone. The mean is taken of l itself, by 50 points a sphere (V. I. Lebedev,
/// Quadratures on a sphere, 1976, exact to degree 11), so a kink of the law may lie anywhere.
class SphericalMeans {
public:
  explicit SphericalMeans(const FieldMesh& mesh) : mesh_(&mesh) {}

  /// An electrode at `point_mm` in the deformed block, with its location in its host element.
  struct Electrode {
    int element = 0;
    Eigen::Vector4d barycentric;
    Eigen::Vector3d point_mm;
    double radius_mm = 0, cutoff_mm = 0; ///< a ball of the cutoff radius lies in the block
  };
  [[nodiscard]] AtElectrode around(const Eigen::Matrix3Xd& nodes_mm, const FieldFunctions& functions,
                                   const Electrode& electrode) const;

private:
  /// Where a point of the block at rest lies, from an element near by.
  struct Place {
    int element = 0;
    Eigen::Vector4d barycentric;
  };
  [[nodiscard]] Place find(const Eigen::Vector3d& atRest_mm, int from) const;

  const FieldMesh* mesh_;
};

} // namespace palp
