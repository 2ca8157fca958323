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

/// A virtual board, and the design of the samples that drive it.
struct SimulatedSensor {
  std::unique_ptr<ReportSource> source;
  std::string designFingerprint;
};

/// Opens the virtual board; `design` (a file, or empty for the paper's) is what a held touch is on. Throws Error.
SimulatedSensor openSimulated(const SimulationArguments& arguments, const std::string& design);

/// From 0 to `most`. Throws UsageError.
double numberUpTo(const std::string& option, const std::string& value, double most);

} // namespace palp
