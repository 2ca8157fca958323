#pragma once

#include "model/LoadCase.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace palp {

struct SensorDesign;

/// Steps that an indenter of the load takes one after another, once the load is reached. Prescribed as in the load: by
/// forces, or by depths and shifts from its place.
struct IndenterPath {
  int indenter = 0;
  std::vector<std::variant<Press, Motion>> steps;

  bool operator==(const IndenterPath&) const = default;
};

constexpr std::size_t kMostPathSteps = 100;

/// The loads after `load` as a Touch follows them; empty without a path, and where it cannot be followed.
std::vector<LoadCase> loadsAfter(const LoadCase& load, const std::optional<IndenterPath>& path,
                                 const SensorDesign& design);
/// Why it cannot be followed; empty where it can.
std::optional<std::string> whyInvalid(const LoadCase& load, const IndenterPath& path, const SensorDesign& design);
/// Returns nullopt where the load has changed so that the path no longer fits: its indenter was removed, or is
/// controlled in another way than the steps.
std::optional<IndenterPath> pathKept(const std::optional<IndenterPath>& path, const LoadCase& before,
                                     const LoadCase& after);

/// Places of the indenter's lowest point as it is moved, 2 x (1 + steps); empty where forces tell it.
Eigen::Matrix2Xd wayOf(const LoadCase& load, const std::optional<IndenterPath>& path);

/// Steps along a line that was drawn over the top face, from where the indenter is by this motion: at
/// equal distances, at most `most`, all at its depth. Corners of the line do not become steps.
std::vector<std::variant<Press, Motion>> stepsAlong(const Eigen::Matrix2Xd& drawn_mm, const Motion& from, int most);

/// The load and its path as `palp solve --loads` reads them (formats.md); without areas and discs.
std::string loadFile(const LoadCase& load, const IndenterPath& path, const SensorDesign& design);

} // namespace palp
