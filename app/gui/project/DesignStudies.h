#pragma once

#include "model/LoadCase.h"
#include "model/SensorDesign.h"

#include <array>
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

/// Two designs compared.
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

constexpr int kMostMapPlaces = 101;

/// What is mapped over the top face.
struct MapSettings {
  IndenterShape shape = IndenterShape::Sphere; ///< of those that have a place along x and y
  double radius_mm = 0;                        ///< 0: the middle of the design's usual touches
  double force_N = 0;                          ///< downwards; 0: the same
  int places = 31;                             ///< along the shorter side of the face, were it all covered
  std::string law;                             ///< empty: the design's; "pairs", or the name of a read-out of the field

  bool operator==(const MapSettings&) const = default;
};

/// What the design resolves of a touch at each place of its top face (app/study/reports/map/TouchMap.h).
struct MappedResolution {
  SensorDesign design; ///< with the law that was mapped
  Indenter touch;      ///< its place does not matter
  double noise = 0;    ///< relative, of the resistances
  Eigen::Vector2d low_mm{0, 0}, high_mm{0, 0};
  std::array<int, 2> places{2, 2};
  double contactRadius_mm = 0;
  std::vector<std::vector<double>> values; ///< a list a quantity, x first; to six digits; -1: nowhere

  bool operator==(const MappedResolution&) const = default;
};

/// What the studies of the Design scene are set to and what they have found; a project keeps it.
struct DesignStudies {
  bool scaleWires = false; ///< another size of the block takes the wires with it
  DesignSweepSettings sweep;
  std::optional<FoundLayout> found;
  std::optional<DesignSweepCurve> curve;
  std::optional<DesignsCompared> compared;
  MapSettings map;
  std::optional<MappedResolution> mapped;

  bool operator==(const DesignStudies&) const = default;
};

} // namespace palp
