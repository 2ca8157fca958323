#pragma once

#include "model/Indenter.h"
#include "model/SensorDesign.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace palp {

/// What random touches are drawn from, each number uniformly: one indenter of this shape, or two, that presses
/// somewhere in a rectangle of the top face.
struct TouchRange {
  IndenterShape shape = IndenterShape::Sphere;
  double smallest_mm = 3, largest_mm = 6;                                              ///< radius; both 0 for a plane
  double rim_mm = 0;                                                                   ///< of a punch
  Eigen::Vector2d low_mm = Eigen::Vector2d::Zero(), high_mm = Eigen::Vector2d::Zero(); ///< rectangle of the place
  std::array<int, 2> grid{0,
                          0}; ///< positions in turn at the middles of this number of cells along x and y; 0: anywhere
  double leastFriction = 0, mostFriction = 0;
  double leastPress_N = 0.5, mostPress_N = 6; ///< downwards
  double cone = 0; ///< largest tangential force, as a share of friction times press; uniform over the disc
  int atOnce = 1;  ///< touches of one load: 1, or 2 that lie the sum of their radii or more apart, so that they fit
  bool operator==(const TouchRange&) const = default;
};

/// The top face without a border of a tenth of its shorter side; presses from a twelfth of the design's force range up;
/// tangential forces up to 0.7 of the friction limit.
TouchRange touchesOf(const SensorDesign& design);

/// Touch number `i`, from seed and number alone. `redrawn`: number of the replacement that is drawn in its place.
Indenter touchAt(const TouchRange& range, std::uint64_t seed, std::size_t i, int redrawn = 0);

/// All touches of load `i`: that one, and where two press together a second one, drawn likewise until it has room.
std::vector<Indenter> touchesAt(const TouchRange& range, std::uint64_t seed, std::size_t i, int redrawn = 0);

/// As the options of the command line that make it: "sphere:3..6@3,3,27,27 press 0.5..6 friction 0.3..0.8 cone 0.7".
std::string inWords(const TouchRange& range);

/// As the options of palp sample: " --touch sphere:3..6@3,3,27,27 --force-range 0.5..6".
std::string asCommand(const TouchRange& range);

/// The indenter of such words, of the middle of its sizes; none where they are others.
std::optional<Indenter> indenterInWords(const std::string& words);

/// Why no touches can be drawn (a range that is empty or not finite, a rectangle off the face, ...): the first of its
/// corners that cannot press; empty if they can.
std::optional<std::string> whyInvalid(const TouchRange& range, const SensorDesign& design);

/// Load area under a place of the top face.
int areaUnder(const SensorDesign& design, const Eigen::Vector2d& place_mm);

} // namespace palp
