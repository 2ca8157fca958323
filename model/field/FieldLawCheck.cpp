#include "model/field/FieldLawCheck.h"

#include "model/FieldAtRest.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>

namespace palp {

namespace {

constexpr Eigen::Index kMostElectrodes = 2000; // each pair of them has a potential
constexpr double kNear = 0.35;                 // radius over distance, above which a warning is due
/// Three digits, for sentences.
std::string digits(double value) {
  std::ostringstream words;
  words << std::setprecision(3) << value;
  return words.str();
}

/// An electrode and the nearest other one, or its mirror image in a face (second: -1); distance of the centres.
struct Neighbours {
  Eigen::Index first = 0;
  Eigen::Index second = -1;
  double distance_mm = 0;
};

Neighbours nearestToAFace(const SensorDesign& design) {
  const Eigen::Matrix3Xd points = electrodes_mm(design);
  Neighbours found{0, -1, 2 * design.block_mm.maxCoeff()};
  for (Eigen::Index p = 0; p < points.cols(); ++p) {
    const double depth = std::min(points.col(p).minCoeff(), (design.block_mm - points.col(p)).minCoeff());
    if (2 * depth < found.distance_mm) found = {p, -1, 2 * depth};
  }
  return found;
}

Neighbours nearestToEachOther(const SensorDesign& design) {
  const Eigen::Matrix3Xd points = electrodes_mm(design);
  Neighbours found{0, 1, 2 * design.block_mm.norm()};
  for (Eigen::Index p = 0; p < points.cols(); ++p)
    for (Eigen::Index q = p + 1; q < points.cols(); ++q) {
      const double distance = (points.col(p) - points.col(q)).norm();
      if (distance < found.distance_mm) found = {p, q, distance};
    }
  return found;
}

std::string electrodeName(const SensorDesign& design, Eigen::Index p) {
  const Eigen::Index upper = design.upper.electrodes();
  const Eigen::Index perWire = p < upper ? design.electrodesPerRowWire() : design.electrodesPerColumnWire();
  const Eigen::Index at = p < upper ? p : p - upper;
  return "electrode " + std::to_string(at % perWire) + " of " + (p < upper ? "row-wire " : "column-wire ") +
         std::to_string(at / perWire);
}

/// "electrode 0 of row-wire 1 and electrode 2 of row-wire 1, 1 mm apart".
std::string inWords(const SensorDesign& design, const Neighbours& near) {
  if (near.second < 0)
    return electrodeName(design, near.first) + ", " + digits(near.distance_mm / 2) + " mm from a face of the block";
  return electrodeName(design, near.first) + " and " + electrodeName(design, near.second) + ", " +
         digits(near.distance_mm) + " mm apart";
}

/// How far two spheres with dipoles are from the exact solution in bispherical coordinates, relative; a = radius over
/// distance. Of opposite currents, or of equal ones as in a mirror.
double errorOfDipoles(double a, bool mirror) {
  const double mu = std::acosh(1 / (2 * a)), sign = mirror ? -1 : 1;
  double sum = 0; // of the capacitance over 4 pi a sinh(mu)
  for (int n = 1; n * mu < 40; ++n) sum += (n % 2 == 1 ? 1 : sign) / std::sinh(n * mu);
  const double exact = 1 / (4 * std::numbers::pi * a * std::sinh(mu) * sum);
  const double model = (1 / a - sign - a * a * a) / (4 * std::numbers::pi);
  return std::abs(model / exact - 1);
}

} // namespace

std::optional<DesignFault> sphereFault(const SensorDesign& design) {
  const Eigen::Index count = design.upper.electrodes() + design.lower.electrodes();
  if (count > kMostElectrodes)
    return DesignFault{"resistance.law", gotExpected("field with " + std::to_string(count) + " electrodes",
                                                     "up to " + std::to_string(kMostElectrodes))};
  const double radius = design.field()->electrodeRadius_mm;
  const Neighbours pair = nearestToEachOther(design), face = nearestToAFace(design);
  const Neighbours& near = pair.distance_mm < face.distance_mm ? pair : face;
  if (radius < near.distance_mm / 2) return {};
  return DesignFault{"resistance.electrode_radius_mm",
                     "electrodes overlap (" + inWords(design, near) +
                         "): " + gotExpected(radius, " mm", "below " + digits(near.distance_mm / 2) + " mm")};
}

std::vector<std::string> designWarnings(const SensorDesign& design) {
  if (!design.field() || !check(design).empty()) return {};
  const double radius = design.field()->electrodeRadius_mm;
  std::string warning;
  double worst = 0;
  for (const Neighbours& near : {nearestToEachOther(design), nearestToAFace(design)}) {
    const bool mirror = near.second < 0;
    const double share = radius / near.distance_mm;
    if (!(share > kNear) || errorOfDipoles(share, mirror) < worst) continue;
    worst = errorOfDipoles(share, mirror);
    warning = "resistance.electrode_radius_mm: " + text(radius) + " mm is " + digits(share) + " of the gap of " +
              inWords(design, near) + (mirror ? ", counted to its mirror image" : "") +
              "; the model of small spheres with dipoles is accurate up to 0.35, here its error is about " +
              digits(100 * worst) + " % of " +
              (mirror ? "the electrode's resistance" : "the resistance between the two");
  }
  if (warning.empty()) return {};
  return {warning};
}

} // namespace palp
