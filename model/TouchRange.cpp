#include "model/TouchRange.h"

#include "model/base/CounterRandom.h"
#include "model/base/GotExpected.h"
#include "model/base/NumberText.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace palp {

namespace {

constexpr std::uint64_t kStream = 0x746F756368; // apart from the streams of load areas, which are small numbers
constexpr int kDrawsOfTheOther = 1000;          // then the corner furthest from the first
constexpr std::uint64_t kDrawsATouch = 16;      // more than one takes
constexpr double kMarginShare = 0.1;            // of the shorter side
constexpr double kSmallestOfSide = 10, kLargestOfSide = 5; // radii in the shorter side
constexpr double kLeastShare = 1. / 12;                    // of the largest press
constexpr double kCone = 0.7;

double between(double low, double high, double share) {
  return low + (high - low) * share;
}

std::string span(double low, double high) {
  return low == high ? text(low) : text(low) + ".." + text(high);
}

} // namespace

TouchRange touchesOf(const SensorDesign& design) {
  TouchRange range;
  const double shorter_mm = design.block_mm.head<2>().minCoeff(), margin_mm = kMarginShare * shorter_mm;
  range.smallest_mm = shorter_mm / kSmallestOfSide;
  range.largest_mm = shorter_mm / kLargestOfSide;
  range.low_mm.setConstant(margin_mm);
  range.high_mm = design.block_mm.head<2>().array() - margin_mm;
  range.mostPress_N = -design.forceRange.low_N.z();
  range.leastPress_N = kLeastShare * range.mostPress_N;
  range.cone = kCone;
  return range;
}

namespace {

Indenter touchOf(const TouchRange& range, std::uint64_t seed, std::uint64_t stream, std::size_t i,
                 std::uint64_t redrawn) {
  std::uint64_t axis = redrawn * kDrawsATouch;
  const auto draw = [&] { return uniformAt(seed, stream, i, axis++); };
  Indenter indenter;
  indenter.shape = range.shape;
  indenter.rim_mm = range.rim_mm;
  indenter.radius_mm = between(range.smallest_mm, range.largest_mm, draw());
  indenter.friction = between(range.leastFriction, range.mostFriction, draw());
  Eigen::Array2d share(draw(), draw());
  if (range.grid[0] > 0) {
    const auto columns = static_cast<std::size_t>(range.grid[0]), rows = static_cast<std::size_t>(range.grid[1]);
    const std::size_t cell = i % (columns * rows);
    share = (Eigen::Array2d(static_cast<double>(cell % columns), static_cast<double>(cell / columns)) + 0.5) /
            Eigen::Array2d(range.grid[0], range.grid[1]);
  }
  indenter.place_mm = range.low_mm.array() + share * (range.high_mm - range.low_mm).array();
  const double press_N = between(range.leastPress_N, range.mostPress_N, draw());
  const double aside_N = std::sqrt(draw()) * range.cone * indenter.friction * press_N;
  const double angle = 2 * std::numbers::pi * draw();
  indenter.control = Press{{0, 0, -press_N}};
  if (aside_N > 0) indenter.control = Press{{aside_N * std::cos(angle), aside_N * std::sin(angle), -press_N}};
  return indenter;
}

/// Of two places, as far as bodies of this shape can meet there.
double distanceApart_mm(IndenterShape shape, const Eigen::Vector2d& apart_mm) {
  if (shape == IndenterShape::CylinderX) return std::abs(apart_mm.y());
  if (shape == IndenterShape::CylinderY) return std::abs(apart_mm.x());
  return apart_mm.norm();
}

} // namespace

Indenter touchAt(const TouchRange& range, std::uint64_t seed, std::size_t i, int redrawn) {
  return touchOf(range, seed, kStream, i, std::uint64_t(redrawn));
}

std::vector<Indenter> touchesAt(const TouchRange& range, std::uint64_t seed, std::size_t i, int redrawn) {
  std::vector<Indenter> touches{touchAt(range, seed, i, redrawn)};
  if (range.atOnce < 2) return touches;
  const Indenter& first = touches.front();
  Indenter other;
  for (int draw = 0; draw < kDrawsOfTheOther; ++draw) {
    other = touchOf(range, seed, kStream + 1, i, std::uint64_t(redrawn) * kDrawsOfTheOther + std::uint64_t(draw));
    if (distanceApart_mm(range.shape, other.place_mm - first.place_mm) < first.radius_mm + other.radius_mm) continue;
    touches.push_back(other);
    return touches;
  }
  const Eigen::Vector2d middle_mm = (range.low_mm + range.high_mm) / 2;
  other.place_mm = (first.place_mm.array() < middle_mm.array()).select(range.high_mm, range.low_mm);
  touches.push_back(other);
  return touches;
}

namespace {

/// "sphere:3..6@3,3,27,27".
std::string bodyAndPlaces(const TouchRange& range) {
  std::string words = shapeName(range.shape);
  if (range.shape != IndenterShape::Plane) words += ":" + span(range.smallest_mm, range.largest_mm);
  if (range.shape == IndenterShape::Flat) words += "," + text(range.rim_mm);
  return words + "@" + text(range.low_mm.x()) + "," + text(range.low_mm.y()) + "," + text(range.high_mm.x()) + "," +
         text(range.high_mm.y());
}

std::string gridInWords(const TouchRange& range) {
  return std::to_string(range.grid[0]) + "x" + std::to_string(range.grid[1]);
}

} // namespace

std::string inWords(const TouchRange& range) {
  std::string words = bodyAndPlaces(range);
  if (range.grid[0] > 0) words += " grid " + gridInWords(range);
  if (range.atOnce > 1) words += " at once " + std::to_string(range.atOnce); // words: ok (in sample files)
  words += " press " + span(range.leastPress_N, range.mostPress_N);
  if (range.mostFriction > 0)
    words += " friction " + span(range.leastFriction, range.mostFriction) + " cone " + text(range.cone);
  return words;
}

std::string asCommand(const TouchRange& range) {
  std::string words = " --touch " + bodyAndPlaces(range);
  if (range.grid[0] > 0) words += " --grid " + gridInWords(range);
  if (range.atOnce > 1) words += " --at-once " + std::to_string(range.atOnce);
  words += " --force-range " + span(range.leastPress_N, range.mostPress_N);
  if (range.mostFriction > 0)
    words += "," + text(range.cone) + " --friction " + span(range.leastFriction, range.mostFriction);
  return words;
}

std::optional<Indenter> indenterInWords(const std::string& words) {
  const std::string body = words.substr(0, words.find('@'));
  const std::size_t colon = body.find(':');
  const auto shape = indenterShape(body.substr(0, colon));
  if (!shape) return {};
  Indenter indenter;
  indenter.shape = *shape;
  indenter.radius_mm = 0;
  if (*shape == IndenterShape::Plane) return indenter;
  if (colon == std::string::npos) return {};
  std::string sizes = body.substr(colon + 1);
  if (const std::size_t comma = sizes.find(','); comma != std::string::npos) {
    const auto rim_mm = numberIn(sizes.substr(comma + 1));
    if (!rim_mm) return {};
    indenter.rim_mm = *rim_mm;
    sizes.resize(comma);
  }
  const std::size_t dots = sizes.find("..");
  const auto from_mm = numberIn(sizes.substr(0, dots));
  const auto to_mm = dots == std::string::npos ? from_mm : numberIn(sizes.substr(dots + 2));
  if (!from_mm || !to_mm) return {};
  indenter.radius_mm = (*from_mm + *to_mm) / 2;
  if (!(indenter.radius_mm > 0)) return {};
  return indenter;
}

namespace {

std::optional<std::string> whyNotAtOnce(const TouchRange& range) {
  const auto wrong = [&](const std::string& expected) {
    return "at once: " + gotExpected(std::to_string(range.atOnce), expected); // words: ok (the option's name)
  };
  if (range.atOnce == 1) return {};
  if (range.atOnce != 2) return wrong("1 or 2 touches");
  if (range.shape == IndenterShape::Plane) return wrong("1 with a plane, which covers the face");
  if (range.grid[0] > 0) return wrong("1 on a grid of positions");
  // From the middle a corner is half of it away.
  const double across_mm = distanceApart_mm(range.shape, range.high_mm - range.low_mm);
  if (!(across_mm >= 4 * range.largest_mm))
    return wrong("1, because two of size " + shortText(range.largest_mm) + " mm need a region " +
                 shortText(4 * range.largest_mm) + " mm wide and this one is " + shortText(across_mm) + " mm");
  return {};
}

} // namespace

std::optional<std::string> whyInvalid(const TouchRange& range, const SensorDesign& design) {
  const auto wrong = [](const char* what, double low, double high, const char* expected) {
    return std::string(what) + ": " + gotExpected(shortText(low) + ".." + shortText(high), expected);
  };
  const bool plane = range.shape == IndenterShape::Plane;
  if (!plane && !(range.smallest_mm > 0 && range.largest_mm >= range.smallest_mm && std::isfinite(range.largest_mm)))
    return wrong("sizes", range.smallest_mm, range.largest_mm, "a range above 0 mm, the smaller first");
  if (!(range.leastPress_N > 0 && range.mostPress_N >= range.leastPress_N && std::isfinite(range.mostPress_N)))
    return wrong("presses", range.leastPress_N, range.mostPress_N, "a range above 0 N, the smaller first");
  if (!(range.leastFriction >= 0 && range.mostFriction >= range.leastFriction && range.mostFriction <= 2))
    return wrong("friction", range.leastFriction, range.mostFriction, "a range from 0 to 2, the smaller first");
  if (!(range.cone >= 0 && range.cone <= 0.95))
    return "cone: " + gotExpected(range.cone, "", "0 to 0.95 of the limit of friction");
  if (!(range.high_mm.array() >= range.low_mm.array()).all() || !(range.low_mm + range.high_mm).allFinite())
    return "region: " + gotExpected(shortText(range.low_mm.x()) + "," + shortText(range.low_mm.y()) + "," +
                                        shortText(range.high_mm.x()) + "," + shortText(range.high_mm.y()),
                                    "X0,Y0,X1,Y1 [mm] with the lower corner first");
  if (range.grid[0] < 0 || range.grid[1] < 0 || (range.grid[0] == 0) != (range.grid[1] == 0))
    return "grid: " + gotExpected(std::to_string(range.grid[0]) + "x" + std::to_string(range.grid[1]), "1x1 or more");
  if (const auto why = whyNotAtOnce(range)) return why;
  for (const Eigen::Vector2d& corner : {range.low_mm, range.high_mm})
    for (const double radius_mm : {range.smallest_mm, range.largest_mm}) {
      Indenter indenter{range.shape, radius_mm,          range.rim_mm,
                        corner,      range.mostFriction, Press{{0, 0, -range.mostPress_N}}};
      if (auto why = whyInvalid(indenter, design)) return why;
    }
  return {};
}

int areaUnder(const SensorDesign& design, const Eigen::Vector2d& place_mm) {
  const auto index = [](double at, double length, int count) {
    return std::clamp(static_cast<int>(at / length * count), 0, count - 1);
  };
  return index(place_mm.y(), design.block_mm.y(), design.areas.rows) * design.areas.columns +
         index(place_mm.x(), design.block_mm.x(), design.areas.columns);
}

} // namespace palp
