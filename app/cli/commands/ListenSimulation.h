#pragma once

#include "app/cli/Command.h"
#include "io/board/ReportSource.h"

#include <memory>
#include <string>

namespace palp {

/// --simulate and what goes with it, as given.
struct SimulationArguments {
  bool on = false;
  std::string samples, hold, noise = "5e-6", warming = "0", hysteresis = "0", rate = "1000", seed = "1";
  std::string openRow, openColumn, dropEvery = "0";
  void declare(Command command);
};

/// The virtual board; `design` (a file, or empty for the paper's) is what a held touch is on. Throws Error.
std::unique_ptr<ReportSource> openSimulated(const SimulationArguments& arguments, const std::string& design);

/// From 0 to `most`. Throws UsageError.
double numberUpTo(const std::string& option, const std::string& value, double most);

} // namespace palp
