#pragma once

#include "model/LoadCase.h"
#include "model/SensorDesign.h"

#include <optional>
#include <string>
#include <vector>

namespace palp {

/// Cramer-Rao bounds of Fx, Fy, Fz of a design in % of the force range, root mean square over the areas; infinite where
/// the resistances do not determine the force.
struct BoundSummary {
  Eigen::Vector3d centreWithPrior = Eigen::Vector3d::Zero(); ///< of the row-wire in the middle alone
  Eigen::Vector3d centreWithoutPrior = Eigen::Vector3d::Zero();
  Eigen::Vector3d allWithPrior = Eigen::Vector3d::Zero(); ///< of all row-wires
  Eigen::Vector3d allWithoutPrior = Eigen::Vector3d::Zero();

  bool operator==(const BoundSummary&) const = default;
};

/// A better layout that was found.
struct FoundLayout {
  SensorDesign from;
  SensorDesign layout;
  BoundSummary before, after;
  int tried = 0;

  bool operator==(const FoundLayout&) const = default;
};

/// Which number of the design is swept.
struct DesignSweepSettings {
  std::string number = "block_mm[0]"; ///< key of the design file
  double from = 0, to = 0;
  int values = 7;
  bool proposed = true; ///< the range follows the design until somebody sets it

  bool operator==(const DesignSweepSettings&) const = default;
};

/// What came out of a sweep.
struct DesignSweepCurve {
  struct Point {
    double at = 0;
    BoundSummary bounds;
    bool operator==(const Point&) const = default;
  };
  SensorDesign design; ///< whose number was swept
  std::string number;
  double noise = 0; ///< relative, of the resistances
  std::vector<Point> points;
  int left = 0; ///< values that make no design

  bool operator==(const DesignSweepCurve&) const = default;
};

/// Two designs beside each other.
struct DesignsCompared {
  SensorDesign earlier, now;
  std::string name; ///< of the earlier one
  LoadCase load;    ///< on `now`
  double noise = 0;
  BoundSummary earlierBounds, nowBounds;
  std::string words; ///< on their answers to the load
  int rows = 0, columns = 0;
  std::vector<double> difference_percent; ///< dR / R less the earlier one's, row by row; empty where not comparable

  bool operator==(const DesignsCompared&) const = default;
};

/// What the studies of the Design scene are set to and what they have found; a project keeps it.
struct DesignStudies {
  bool scaleWires = false; ///< another size of the block takes the wires with it
  DesignSweepSettings sweep;
  std::optional<FoundLayout> found;
  std::optional<DesignSweepCurve> curve;
  std::optional<DesignsCompared> compared;

  bool operator==(const DesignStudies&) const = default;
};

} // namespace palp
