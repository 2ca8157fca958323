#include "model/Indenter.h"

#include "model/SensorDesign.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr double kSmallestIndenter_mm = 0.05, kLargestIndenter_mm = 1e5;
constexpr double kLargestFriction = 2;
constexpr double kLargestPress_N = 1e6;
constexpr double kDeepestShare = 0.9; // of the block's height

/// The distance to a round surface about the centre that r points from; `bending` is the unit matrix without the
/// directions along which it is straight.
IndenterDistance roundDistance(const Eigen::Vector3d& r, double radius, const Eigen::Matrix3d& bending) {
  const double length = r.norm();
  if (!(length > 0)) return {-radius, -Eigen::Vector3d::UnitZ(), Eigen::Matrix3d::Zero()};
  const Eigen::Vector3d n = r / length;
  return {length - radius, n, (bending - n * n.transpose()) / length};
}

/// Flat end, rim (part of a torus) and side of an upright punch.
IndenterDistance punchDistance(const Indenter& punch, const Eigen::Vector3d& x) {
  const double across = std::hypot(x.x(), x.y()), flat = punch.radius_mm - punch.rim_mm;
  if (across <= flat) return {.gap_mm = -x.z()};
  const Eigen::Vector3d outward(x.x() / across, x.y() / across, 0), around(-outward.y(), outward.x(), 0);
  const double r = across - flat, z = x.z() - punch.rim_mm;
  if (z > 0) return {across - punch.radius_mm, outward, around * around.transpose() / across};
  const double length = std::hypot(r, z), nr = r / length, nz = z / length;
  const Eigen::Vector3d n = nr * outward + nz * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d along = -nz * outward + nr * Eigen::Vector3d::UnitZ();
  return {length - punch.rim_mm, n, along * along.transpose() / length + around * around.transpose() * (nr / across)};
}

std::string placeOf(const Indenter& indenter) {
  return shapeName(indenter.shape) + " at (" + text(indenter.place_mm.x()) + ", " + text(indenter.place_mm.y()) +
         ") mm: ";
}

std::optional<std::string> sizeProblem(const Indenter& indenter) {
  const double radius = indenter.radius_mm, rim = indenter.rim_mm;
  if (indenter.shape != IndenterShape::Plane && !(radius >= kSmallestIndenter_mm && radius <= kLargestIndenter_mm))
    return "radius: " + gotExpected(radius, " mm",
                                    shortText(kSmallestIndenter_mm) + " to " + shortText(kLargestIndenter_mm) + " mm");
  if (indenter.shape == IndenterShape::Flat && !(rim >= 0 && rim <= radius))
    return "rim radius: " + gotExpected(rim, " mm", "0 to the punch's radius, " + shortText(radius) + " mm");
  if (!(indenter.friction >= 0 && indenter.friction <= kLargestFriction))
    return "friction: " + gotExpected(indenter.friction, "", "0 to " + shortText(kLargestFriction));
  return {};
}

bool isInside(const Indenter& indenter, const Eigen::Vector2d& place, const Eigen::Vector3d& block_mm) {
  const bool x = place.x() >= 0 && place.x() <= block_mm.x(), y = place.y() >= 0 && place.y() <= block_mm.y();
  switch (indenter.shape) {
  case IndenterShape::Plane:
    return place.allFinite();
  case IndenterShape::CylinderX:
    return y && place.allFinite();
  case IndenterShape::CylinderY:
    return x && place.allFinite();
  default:
    return x && y;
  }
}

std::optional<std::string> pressProblem(const Press& press, double friction) {
  const Eigen::Vector3d& f = press.force_N;
  const auto wrong = [&](const std::string& expected) {
    return "force: " + gotExpected(shortTexts(f) + " N", expected);
  };
  if (!(f.allFinite() && f.cwiseAbs().maxCoeff() <= kLargestPress_N))
    return wrong("a finite number up to 1e6 N in each direction");
  if (!(f.z() < 0)) return wrong("FZ below 0, because an indenter presses");
  const double sideways = f.head<2>().norm();
  if (sideways > 0 && friction == 0) return wrong("no tangential force without friction (mu)");
  if (sideways > 0 && !(sideways < friction * -f.z()))
    return wrong("a tangential force below friction " + shortText(friction) + " x " + shortText(-f.z()) +
                 " N = " + shortText(friction * -f.z()) + " N; an indenter that slides needs depth control or a path");
  return {};
}

std::optional<std::string> motionProblem(const Indenter& indenter, const Motion& motion,
                                         const Eigen::Vector3d& block_mm) {
  const double deepest = kDeepestShare * block_mm.z();
  if (!(motion.depth_mm > 0 && motion.depth_mm <= deepest))
    return "depth: " + gotExpected(motion.depth_mm, " mm",
                                   "above 0 up to " + shortText(deepest) + " mm in this block of " +
                                       shortText(block_mm.z()) + " mm");
  const bool closed = indenter.shape == IndenterShape::Sphere || indenter.shape == IndenterShape::CylinderX ||
                      indenter.shape == IndenterShape::CylinderY;
  if (closed && motion.depth_mm >= 2 * indenter.radius_mm)
    return "depth: " + gotExpected(motion.depth_mm, " mm",
                                   "less than the diameter of the " + shapeName(indenter.shape) + ", " +
                                       shortText(2 * indenter.radius_mm) + " mm; a pin may press deeper");
  if (!isInside(indenter, indenter.place_mm + motion.shift_mm, block_mm) || !motion.shift_mm.allFinite())
    return "shift: " + gotExpected(shortTexts(motion.shift_mm) + " mm", "one that stays on the top face of " +
                                                                            shortText(block_mm.x()) + " x " +
                                                                            shortText(block_mm.y()) + " mm");
  return {};
}

} // namespace

bool Indenter::hasTwoParts() const {
  const Eigen::Vector2d sideways = press() ? Eigen::Vector2d(press()->force_N.head<2>()) : motion()->shift_mm;
  return friction > 0 && !sideways.isZero(0);
}

Indenter Indenter::at(double loadFraction) const {
  const double down = hasTwoParts() ? std::min(1., loadFraction / pressShare) : loadFraction;
  const double sideways = hasTwoParts() ? std::max(0., (loadFraction - pressShare) / (1 - pressShare)) : loadFraction;
  Indenter part = *this;
  if (const Press* whole = press())
    part.control = Press{{sideways * whole->force_N.x(), sideways * whole->force_N.y(), down * whole->force_N.z()}};
  else
    part.control = Motion{down * motion()->depth_mm, sideways * motion()->shift_mm};
  return part;
}

std::string shapeName(IndenterShape shape) {
  return kIndenterShapes.name(shape);
}

std::optional<IndenterShape> indenterShape(const std::string& name) {
  return kIndenterShapes.find(name);
}

std::string indenterShapes() {
  return kIndenterShapes.allowed();
}

IndenterDistance distance(const Indenter& indenter, const Eigen::Vector3d& fromTip_mm) {
  Eigen::Vector3d r = fromTip_mm - indenter.radius_mm * Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d bending = Eigen::Matrix3d::Identity();
  switch (indenter.shape) {
  case IndenterShape::Plane:
    return {.gap_mm = -fromTip_mm.z()};
  case IndenterShape::Flat:
    return punchDistance(indenter, fromTip_mm);
  case IndenterShape::CylinderX:
    r.x() = bending(0, 0) = 0;
    break;
  case IndenterShape::CylinderY:
    r.y() = bending(1, 1) = 0;
    break;
  case IndenterShape::Pin:
    if (r.z() > 0) r.z() = bending(2, 2) = 0;
    break;
  case IndenterShape::Sphere:
    break;
  }
  return roundDistance(r, indenter.radius_mm, bending);
}

std::string asCommand(const Indenter& indenter) {
  std::string command = "--indenter " + shapeName(indenter.shape);
  if (indenter.shape != IndenterShape::Plane) command += ":" + text(indenter.radius_mm);
  if (indenter.shape == IndenterShape::Flat) command += "," + text(indenter.rim_mm);
  command += "@" + text(indenter.place_mm.x()) + "," + text(indenter.place_mm.y());
  if (const Press* press = indenter.press()) {
    const Eigen::Vector3d& force_N = press->force_N;
    command += ":press=" + text(force_N.x()) + "," + text(force_N.y()) + "," + text(force_N.z());
  } else {
    const Motion& motion = *indenter.motion();
    command += ":depth=" + text(motion.depth_mm);
    if (!motion.shift_mm.isZero(0)) command += "," + text(motion.shift_mm.x()) + "," + text(motion.shift_mm.y());
  }
  return indenter.friction > 0 ? command + ":mu=" + text(indenter.friction) : command;
}

std::optional<std::string> whyInvalid(const Indenter& indenter, const SensorDesign& design) {
  const Eigen::Vector3d& block = design.block_mm;
  if (!isInside(indenter, indenter.place_mm, block))
    return placeOf(indenter) + "position: " +
           gotExpected(shortTexts(indenter.place_mm) + " mm",
                       "a position on the top face of " + shortText(block.x()) + " x " + shortText(block.y()) + " mm");
  if (auto wrong = sizeProblem(indenter)) return placeOf(indenter) + *wrong;
  const Press* press = indenter.press();
  auto wrong = press ? pressProblem(*press, indenter.friction) : motionProblem(indenter, *indenter.motion(), block);
  if (wrong) return placeOf(indenter) + *wrong;
  return {};
}

} // namespace palp
