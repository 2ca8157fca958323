#include "solver/contact/ContactEstimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace palp {

namespace {

constexpr double elementsARadius = 4;     // of the contact
constexpr double rimElementsARadius = 24; // of a punch, where its rim leaves the flat
constexpr double finestShare = 0.004;     // of the block's height

/// Frictionless indentation of a layer of thickness h and Poisson's ratio 0.5, bonded to a rigid base, by a contact of
/// half width a: solutions of the integral equation.
///   punch P = 8 G a d kappa;  sphere d = chi a^2 / R, P = 16/3 G a^3 / R eta;
///   cylinder, a unit length: d = depth a^2 / R, P = 2 force G a^2 / R.
struct LayerRow {
  double ratio, kappa, chi, eta; ///< ratio a / h
};
constexpr std::array layerRows{
    LayerRow{0, 1, 1, 1},
    LayerRow{0.1, 1.12599, 0.92577, 1.00080},
    LayerRow{0.2, 1.28064, 0.85631, 1.00618},
    LayerRow{0.4, 1.68372, 0.74121, 1.04365},
    LayerRow{0.6, 2.21289, 0.65864, 1.12548},
    LayerRow{0.8, 2.86024, 0.60083, 1.25002},
    LayerRow{1, 3.61874, 0.55942, 1.41050},
    LayerRow{1.5, 6.00301, 0.49415, 1.93248},
    LayerRow{2, 9.14945, 0.45490, 2.59812},
    LayerRow{3, 18.15740, 0.40748, 4.35990},
    LayerRow{5, 50.13974, 0.35912, 9.94630},
    LayerRow{10, 252.89814, 0.31226, 41.11014},
};
struct StripRow {
  double ratio, depth, force;
};
constexpr std::array stripRows{
    StripRow{0, 1.8, 1.5708},        StripRow{0.1, 1.27382, 1.58686}, StripRow{0.2, 0.95567, 1.63479},
    StripRow{0.4, 0.68196, 1.82268}, StripRow{0.6, 0.55608, 2.12226}, StripRow{0.8, 0.48455, 2.51639},
    StripRow{1, 0.43834, 2.98970},   StripRow{1.5, 0.37069, 4.46871}, StripRow{2, 0.33230, 6.35830},
    StripRow{3, 0.28846, 11.51524},
};

/// Linear between the rows, constant beyond the last.
template <class Rows, class Value> double between(const Rows& rows, double ratio, Value value) {
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (ratio <= rows[i].ratio) {
      const double part = (ratio - rows[i - 1].ratio) / (rows[i].ratio - rows[i - 1].ratio);
      return (1 - part) * rows[i - 1].*value + part * rows[i].*value;
    }
  return rows.back().*value;
}

/// The argument in (0, most) at which an increasing function reaches the value.
template <class Function> double argumentOf(double value, double most, Function function) {
  double low = 0, high = most;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (function(middle) < value ? low : high) = middle;
  }
  return high;
}

/// How far two of a round indenter's radii reach: no contact is wider.
ContactEstimate roundContact(const Indenter& indenter, double h, double modulus, bool sphere, double length) {
  const double R = indenter.radius_mm;
  const auto depth = [&](double a) {
    const double rate =
        sphere ? between(layerRows, a / h, &LayerRow::chi) : between(stripRows, a / h, &StripRow::depth);
    return rate * a * a / R;
  };
  const auto force = [&](double a) {
    return sphere ? 16. / 3 * modulus * a * a * a / R * between(layerRows, a / h, &LayerRow::eta)
                  : 2 * modulus * a * a / R * between(stripRows, a / h, &StripRow::force) * length;
  };
  const double a = indenter.press() ? argumentOf(-indenter.press()->force_N.z(), 2 * R, force)
                                    : argumentOf(indenter.motion()->depth_mm, 2 * R, depth);
  return {depth(a), Eigen::Vector2d::Constant(std::min(a, R))};
}

} // namespace

ContactEstimate contactEstimate(const Indenter& indenter, const SensorDesign& design) {
  const double h = design.block_mm.z(), G = design.material.shearModulus_MPa();
  const Eigen::Vector2d halfFace = design.block_mm.head<2>() / 2;
  const double pressed = indenter.press() ? -indenter.press()->force_N.z() : 0;
  ContactEstimate estimate;
  double stiffness = 0; // of an end that touches over its full area
  switch (indenter.shape) {
  case IndenterShape::Sphere:
  case IndenterShape::Pin:
    estimate = roundContact(indenter, h, G, true, 0);
    break;
  case IndenterShape::CylinderX:
    estimate = roundContact(indenter, h, G, false, design.block_mm.x());
    estimate.half_mm.x() = halfFace.x();
    break;
  case IndenterShape::CylinderY:
    estimate = roundContact(indenter, h, G, false, design.block_mm.y());
    estimate.half_mm.y() = halfFace.y();
    break;
  case IndenterShape::Flat: {
    const double a = indenter.radius_mm;
    estimate.half_mm.setConstant(a);
    stiffness = 8 * G * a * between(layerRows, a / h, &LayerRow::kappa);
    break;
  }
  case IndenterShape::Plane: {
    const double shapeFactor = halfFace.prod() * 4 / (2 * h * 2 * (halfFace.sum() * 2));
    estimate.half_mm = halfFace;
    stiffness = 3 * G * (1 + 2 * shapeFactor * shapeFactor) * 4 * halfFace.prod() / h; // Gent and Lindley 1959
    break;
  }
  }
  if (stiffness > 0) estimate.depth_mm = indenter.press() ? pressed / stiffness : indenter.motion()->depth_mm;
  estimate.depth_mm = std::min(estimate.depth_mm, 0.9 * h);
  estimate.half_mm = estimate.half_mm.cwiseMin(halfFace);
  return estimate;
}

std::vector<FineZone> fineZones(const SensorDesign& design, const LoadCase& load) {
  std::vector<FineZone> zones;
  for (const Indenter& indenter : load.indenters) {
    if (indenter.shape == IndenterShape::Plane) continue; // nothing ends under it
    const ContactEstimate contact = contactEstimate(indenter, design);
    const Eigen::Vector2d shift = indenter.motion() ? indenter.motion()->shift_mm : Eigen::Vector2d::Zero();
    const double finest = finestShare * design.block_mm.z();
    FineZone zone{indenter.place_mm + shift / 2, contact.half_mm + shift.cwiseAbs() / 2,
                  (contact.half_mm / elementsARadius).cwiseMax(finest)};
    if (indenter.shape == IndenterShape::CylinderX) {
      zone.half_mm.x() = 0;
      zone.size_mm.x() = design.block_mm.x();
    }
    if (indenter.shape == IndenterShape::CylinderY) {
      zone.half_mm.y() = 0;
      zone.size_mm.y() = design.block_mm.y();
    }
    zones.push_back(zone);
    if (indenter.shape != IndenterShape::Flat) continue;
    // Pressure peaks where the rim leaves the flat, and a circle on a grid is a staircase.
    const double flat = indenter.radius_mm - indenter.rim_mm;
    const double fine = std::max(indenter.radius_mm / rimElementsARadius, finest);
    for (const double side : {-1., 1.})
      zones.push_back({zone.centre_mm + Eigen::Vector2d::Constant(side * flat), shift.cwiseAbs() / 2,
                       Eigen::Vector2d::Constant(fine)});
  }
  return zones;
}

} // namespace palp
