#pragma once

#include "app/study/reports/Report.h"

#include <string>
#include <vector>

namespace palp {

/// A command of palp, run once in a process of its own, and what it cost.
struct CommandCost {
  std::string command; ///< as it would be typed
  double seconds = 0;
  double cpu_s = 0;
  double peak_MB = 0;
  std::string stages; ///< that ran, with how often
  int pictures = 0;   ///< files of pictures that it wrote
  std::string failed; ///< why it has no result; empty where it has one
};

/// Every command on the request's design, mesh and samples, with the palp of the request's programs. What was run
/// before a stop request is there.
std::vector<CommandCost> commandCosts(const ReportRequest& request, const ReportProgress& progress,
                                      const std::stop_token& stop);

/// The mesh as options of the command line; empty for the default.
std::vector<std::string> meshArguments(const MeshOptions& mesh);

} // namespace palp
