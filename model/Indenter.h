#pragma once

#include "model/base/NamedEnum.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <variant>

namespace palp {

struct SensorDesign;

/// Rigid bodies that press from above, the axis of pin and punch upright.
enum class IndenterShape {
  Sphere,
  Pin,       ///< upright round rod that ends in half a sphere
  Flat,      ///< upright round punch, its flat end rounded at the rim
  CylinderX, ///< lies along x, across the complete block
  CylinderY, ///< lies along y
  Plane
};

inline constexpr NamedEnum kIndenterShapes(
    "shape", std::array{std::pair{IndenterShape::Sphere, "sphere"}, std::pair{IndenterShape::Pin, "pin"},
                        std::pair{IndenterShape::Flat, "flat"}, std::pair{IndenterShape::CylinderX, "cylinder-x"},
                        std::pair{IndenterShape::CylinderY, "cylinder-y"}, std::pair{IndenterShape::Plane, "plane"}});

/// Presses with a force on the rubber [N]; free to move along x and y only with friction, which holds it.
struct Press {
  Eigen::Vector3d force_N{0, 0, -1};
  bool operator==(const Press&) const = default;
};

/// Moves down by a depth from the first touch of the top face at rest, then tangentially.
struct Motion {
  double depth_mm = 0.1;
  Eigen::Vector2d shift_mm = Eigen::Vector2d::Zero();
  bool operator==(const Motion&) const = default;
};

/// Load fraction at which normal loading is complete and tangential loading starts, for a load that has both.
inline constexpr double pressShare = 2. / 3;

/// A rigid body that presses on the top face, with Coulomb friction.
struct Indenter {
  IndenterShape shape = IndenterShape::Sphere;
  double radius_mm = 5;                               ///< of sphere, pin, cylinder and punch; a plane has none
  double rim_mm = 0;                                  ///< radius of a punch's rim
  Eigen::Vector2d place_mm = Eigen::Vector2d::Zero(); ///< of its axis or lowest point, before any shift
  double friction = 0;                                ///< Coulomb's coefficient
  std::variant<Press, Motion> control;
  bool operator==(const Indenter&) const = default;

  /// The indenter at a fraction of its load. A normal load grows in proportion; a tangential one with friction is
  /// preceded by the normal one, which takes the first two thirds.
  [[nodiscard]] Indenter at(double loadFraction) const;
  [[nodiscard]] bool hasTwoParts() const; ///< normal, then tangential loading
  [[nodiscard]] const Press* press() const { return std::get_if<Press>(&control); }
  [[nodiscard]] const Motion* motion() const { return std::get_if<Motion>(&control); }
};

/// An indenter's surface near a point x: signed distance g (positive outside), its gradient n (a unit vector out of
/// the indenter) and its second derivative H.
struct IndenterDistance {
  double gap_mm = 0;
  Eigen::Vector3d normal = -Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d curvature_per_mm = Eigen::Matrix3d::Zero();
};

/// Distance of a point given from the indenter's lowest point (of a punch or plane: where its axis meets its end).
IndenterDistance distance(const Indenter& indenter, const Eigen::Vector3d& fromTip_mm);

/// As on the command line: "sphere", "cylinder-x".
std::string shapeName(IndenterShape shape);
std::optional<IndenterShape> indenterShape(const std::string& name);
/// "sphere, pin, flat, cylinder-x, cylinder-y or plane".
std::string indenterShapes();

/// As the option of the command line that makes it: "--indenter sphere:5@15,15:press=0,0,-3:mu=0.5".
std::string asCommand(const Indenter& indenter);

/// Why the indenter cannot press on the design (off the body, a rim wider than the punch, friction below 0 or above 2,
/// a pull, a tangential force above the friction limit, a number that is not finite); empty if it can.
std::optional<std::string> whyInvalid(const Indenter& indenter, const SensorDesign& design);

} // namespace palp
