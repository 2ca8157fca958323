#pragma once

#include "model/Indenter.h"
#include "model/SensorDesign.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace palp {

/// Uniform dead traction force / area on one of the design's load areas.
struct AreaLoad {
  int area = 0;
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
  bool operator==(const AreaLoad&) const = default;
};

/// Uniform dead traction on a disc of the top face; the disc lies inside the face.
struct PatchLoad {
  Eigen::Vector2d centre_mm = Eigen::Vector2d::Zero();
  double radius_mm = 1;
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
  bool operator==(const PatchLoad&) const = default;
};

/// Forces and indenters that act together.
struct LoadCase {
  std::vector<AreaLoad> areas;
  std::vector<PatchLoad> patches;
  std::vector<Indenter> indenters{};

  /// Of areas and patches; what indenters press with is found by the solve.
  [[nodiscard]] Eigen::Vector3d totalForce_N() const;
  bool operator==(const LoadCase&) const = default;
};

/// Why the load cannot act on the design (no such area, a disc outside the face or smaller than 0.01 mm in radius, a
/// force that is not finite, an indenter that cannot press); empty if it can.
std::optional<std::string> whyInvalid(const LoadCase& load, const SensorDesign& design);

/// Why the loads cannot act one after another (none, one without indenters, one that cannot act, indenters that are not
/// the first's in number, shape, size, position, friction and control (force or displacement)); empty if they can.
std::optional<std::string> whyInvalid(const std::vector<LoadCase>& path, const SensorDesign& design);

} // namespace palp
