#include "solver/contact/IndenterSurface.h"

#include "model/SensorDesign.h"
#include "solver/contact/ContactEstimate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp {

namespace {

constexpr double gridReach = 1.6;   // in half widths of the contact
constexpr int cellsAHalfWidth = 16; // of the contact
constexpr double steepest_deg = 80; // of a round surface: beyond it only the side is left
constexpr int cellsOfTheRim = 8;    // of a punch, along its quarter of a circle
constexpr double overhangs = 30;    // of cylinders and planes over the block's sides, in its length
constexpr int cellsAlong = 16;      // of cylinders and planes

/// Heights z over distances r from the axis; the first at r = 0.
using Profile = std::vector<Eigen::Vector2d>;

/// Of a ball, as wide as the contact's half width requires.
Profile roundProfile(double radius, double half) {
  const double steepest = steepest_deg * std::numbers::pi / 180;
  const double angle = std::min(steepest, std::asin(std::min(1., gridReach * half / radius)));
  const int cells = static_cast<int>(std::lround(gridReach * cellsAHalfWidth));
  Profile profile;
  for (int k = 0; k <= cells; ++k) {
    const double t = angle * k / cells;
    profile.emplace_back(radius * std::sin(t), radius * (1 - std::cos(t)));
  }
  return profile;
}

Profile punchProfile(double radius, double rim) {
  Profile profile;
  for (int k = 0; k <= cellsAHalfWidth; ++k) profile.emplace_back((radius - rim) * k / cellsAHalfWidth, 0);
  for (int k = 1; rim > 0 && k <= cellsOfTheRim; ++k) {
    const double t = std::numbers::pi / 2 * k / cellsOfTheRim;
    profile.emplace_back(radius - rim + rim * std::sin(t), rim * (1 - std::cos(t)));
  }
  if (rim == radius) profile.erase(profile.begin(), profile.end() - cellsOfTheRim - 1); // no flat end is left
  return profile;
}

/// Turned about the axis: ring k has 6 k corners.
IndenterSurface turned(const Profile& profile) {
  const auto rings = static_cast<int>(profile.size()) - 1;
  const auto first = [](int k) { return k == 0 ? 0 : 1 + 3 * k * (k - 1); };
  const auto at = [&](int k, int j) { return k == 0 ? 0 : first(k) + j % (6 * k); };
  IndenterSurface surface;
  surface.points_mm.resize(3, first(rings + 1));
  surface.points_mm.col(0) << 0, 0, profile[0].y();
  for (int k = 1; k <= rings; ++k)
    for (int j = 0; j < 6 * k; ++j) {
      const double t = 2 * std::numbers::pi * j / (6 * k);
      surface.points_mm.col(at(k, j)) << profile[k].x() * std::cos(t), profile[k].x() * std::sin(t), profile[k].y();
    }
  for (int k = 1; k <= rings; ++k)
    for (int part = 0; part < 6; ++part)
      for (int i = 0; i < k; ++i) {
        const int in = part * (k - 1) + i, out = part * k + i;
        surface.triangles.push_back({at(k - 1, in), at(k, out), at(k, out + 1)});
        if (i + 1 < k) surface.triangles.push_back({at(k - 1, in), at(k, out + 1), at(k - 1, in + 1)});
      }
  return surface;
}

/// A grid of points, x and y ascending, cut into triangles.
template <class Place> IndenterSurface gridded(int countX, int countY, const Place& place) {
  IndenterSurface surface;
  surface.points_mm.resize(3, Eigen::Index(countX) * countY);
  for (int j = 0; j < countY; ++j)
    for (int i = 0; i < countX; ++i) surface.points_mm.col(j * countX + i) = place(i, j);
  for (int j = 0; j + 1 < countY; ++j)
    for (int i = 0; i + 1 < countX; ++i) {
      const int a = j * countX + i, b = a + countX;
      surface.triangles.push_back({a, a + 1, b + 1});
      surface.triangles.push_back({a, b + 1, b});
    }
  return surface;
}

/// Places along a direction, from one side of the block to the other and a little beyond, from the indenter's place.
double along(int i, double length_mm, double place_mm) {
  const double overhang_mm = length_mm / overhangs;
  return -overhang_mm + (length_mm + 2 * overhang_mm) * i / cellsAlong - place_mm;
}

} // namespace

IndenterSurface indenterSurface(const Indenter& indenter, const SensorDesign& design) {
  const Eigen::Vector2d half_mm = contactEstimate(indenter, design).half_mm;
  const Eigen::Vector2d &at = indenter.place_mm, size(design.block_mm.head<2>());
  const auto onX = [&](int i) { return along(i, size.x(), at.x()); };
  const auto onY = [&](int j) { return along(j, size.y(), at.y()); };
  /// A profile and its mirror image, across a cylinder.
  const auto across = [](const Profile& profile, int i) {
    const auto middle = static_cast<int>(profile.size()) - 1, k = i - middle;
    const Eigen::Vector2d& p = profile[static_cast<std::size_t>(std::abs(k))];
    return Eigen::Vector2d(k < 0 ? -p.x() : p.x(), p.y());
  };
  switch (indenter.shape) {
  case IndenterShape::Flat:
    return turned(punchProfile(indenter.radius_mm, indenter.rim_mm));
  case IndenterShape::Plane:
    return gridded(cellsAlong + 1, cellsAlong + 1, [&](int i, int j) { return Eigen::Vector3d(onX(i), onY(j), 0); });
  case IndenterShape::CylinderX: {
    const Profile profile = roundProfile(indenter.radius_mm, half_mm.y());
    return gridded(cellsAlong + 1, 2 * static_cast<int>(profile.size()) - 1, [&](int i, int j) {
      const Eigen::Vector2d p = across(profile, j);
      return Eigen::Vector3d(onX(i), p.x(), p.y());
    });
  }
  case IndenterShape::CylinderY: {
    const Profile profile = roundProfile(indenter.radius_mm, half_mm.x());
    return gridded(2 * static_cast<int>(profile.size()) - 1, cellsAlong + 1, [&](int i, int j) {
      const Eigen::Vector2d p = across(profile, i);
      return Eigen::Vector3d(p.x(), onY(j), p.y());
    });
  }
  case IndenterShape::Sphere:
  case IndenterShape::Pin:
    break;
  }
  return turned(roundProfile(indenter.radius_mm, half_mm.maxCoeff()));
}

} // namespace palp
