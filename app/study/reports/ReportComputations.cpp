#include "app/study/reports/ReportComputations.h"

#include "app/study/reports/errortime/ErrorTimeReport.h"
#include "app/study/reports/layout/LayoutReport.h"
#include "app/study/reports/networks/NetworksReport.h"
#include "app/study/reports/networks/NoiseReport.h"
#include "app/study/reports/readout/ReadoutReport.h"
#include "app/study/reports/scenes/ScenesReport.h"
#include "app/study/reports/stability/StabilityReport.h"
#include "model/base/Cancelled.h"

#include <chrono>

namespace palp {

const std::vector<ReportComputation>& reportComputations() {
  static const std::vector<ReportComputation> all{
      {"error-time",
       "error against run time: solver, networks, samples and the whole chain",
       errorTimeReport,
       {{"solver on its meshes", 0.2, 140},
        {"solver, finer meshes and CalculiX", 0.45, 12},
        {"samples", 0.55, 3},
        {"decoders", 0.75, 20},
        {"samples a second", 0.85, 16},
        {"the whole chain", 1, 70}}},
      {"stability",
       "extreme cases of the solver, the networks and Eq. (1), and how each came out",
       stabilityReport,
       {{"solver, extreme designs", 0.32, 4},
        {"solver, extreme loads and materials", 0.49, 7},
        {"solver, default mesh", 0.575, 30},
        {"Eq. (1)", 0.655, 0.1},
        {"networks", 1, 5}}},
      {"networks",
       "what is asked of the networks, line by line, on fresh forces and all areas; under the field what a decoder "
       "trained on one law does on another",
       networksReport,
       {{"samples", 0.2, 15},
        {"samples for testing", 0.4, 15},
        {"networks, five sets of samples", 0.9, 60},
        {"all areas at once", 1, 12}},
       true},
      {"noise",
       "force error against resistance noise, between the Cramer-Rao bounds",
       noiseReport,
       {{"samples", 0.25, 20},
        {"decoders over the noise, row-wire 4", 0.416, 12},
        {"decoders over the noise, three row-wires", 0.583, 29},
        {"decoders over the noise, all row-wires", 0.75, 49},
        {"noise of the training", 1, 10}},
       true},
      {"layout",
       "what the layout of the electrodes resolves, and a better one",
       layoutReport,
       {{"the block's response", 0.25, 40},
        {"search for a better layout", 0.55, 2},
        {"depth, pitch and laws", 0.65, 3},
        {"confirmed by full samples", 1, 90}},
       true},
      {"readout",
       "what the circuit decides under the field: read-out, electrode radius, contact, switches and noise",
       readoutReport,
       {{"the block's response", 0.3, 2}, {"the read-outs of the design", 0.4, 1}, {"radius, contact, switches", 1, 6}},
       true},
      {"scenes",
       "what each scene and each command costs, and that nothing is computed that is not shown",
       scenesReport,
       {{"the chain", 0.15, 30}, {"the window", 0.55, 60}, {"the commands", 1, 65}}},
  };
  return all;
}

ReportOutcome runReport(const ReportComputation& kind, const ReportRequest& request, const ReportProgress& progress,
                        const std::stop_token& stop, const ChartDrawer& draw) {
  if (!kind.underField) requirePairs(request.design, "report " + kind.name);
  const auto start = std::chrono::steady_clock::now();
  try {
    const std::optional<ReportContent> content = kind.compute(request, progress, stop);
    if (!content) return {};
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return writeReport(*content, request, seconds, draw, stop);
  } catch (const Cancelled&) { // from deep within a computation, or between two pictures
    return {};
  }
}

} // namespace palp
