#pragma once

#include "app/cli/Command.h"
#include "model/TouchRange.h"

#include <string>

namespace palp {

/// --touch and what goes with it: random touches of an indenter in place of forces on areas.
struct TouchArguments {
  std::string touch, count, friction, forceRange, region, grid, atOnce;
  /// After this either --count or `perArea` is given.
  void declare(Command command, Option perArea);
  /// The same for a map of touches: shape, force, region and grid.
  void declareForMap(Command command);
  /// As they were given, with a space before each option.
  [[nodiscard]] std::string asCommand() const;
  [[nodiscard]] bool given() const { return !touch.empty(); }
  /// Throws UsageError.
  [[nodiscard]] TouchRange range(const SensorDesign& design) const;

private:
  void declareRegion(Command command, Option on);
};

} // namespace palp
