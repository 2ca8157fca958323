#include "app/study/reports/ReportComputations.h"

#include "app/study/reports/errortime/ErrorTimeReport.h"
#include "app/study/reports/layout/LayoutReport.h"
#include "app/study/reports/map/MapReport.h"
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
       "error against run time: solver, networks, samples and the complete chain",
       errorTimeReport,
       {{"solver on coarse meshes", 0.127, 24},
        {"solver on its finest mesh", 0.159, 75},
        {"solver on the default mesh", 0.191, 11},
        {"solver on hexahedra, CalculiX", 0.35, 11},
        {"a sphere on four meshes", 0.425, 20},
        {"the same with friction", 0.5, 50},
        {"samples", 0.55, 5},
        {"decoders", 0.75, 30},
        {"samples per second", 0.85, 34},
        {"the complete chain, coarse meshes", 0.949, 28},
        {"the complete chain, finer meshes", 1, 30}}},
      {"stability",
       "extreme cases of the solver, the networks and Eq. (1), and how each came out",
       stabilityReport,
       {{"solver, extreme designs", 0.32, 4},
        {"solver, extreme loads and materials", 0.495, 6},
        {"default mesh, extreme designs", 0.53, 14},
        {"default mesh, strong pushes and pulls", 0.5565, 6.5},
        {"default mesh, the strongest push", 0.566, 10},
        {"default mesh, an oblique load", 0.575, 2},
        {"Eq. (1)", 0.655, 0.3},
        {"networks, spreads and solvers", 0.88, 1},
        {"networks, odd data", 1, 5}}},
      {"networks",
       "requirements on the networks, one by one, on fresh forces and all areas; under the field how a decoder "
       "trained on one law does on another",
       networksReport,
       {{"the paper's networks, set 1 of 5", 0.08, 9},
        {"the paper's networks, set 2 of 5", 0.16, 9},
        {"the paper's networks, set 3 of 5", 0.24, 9},
        {"the paper's networks, set 4 of 5", 0.32, 9},
        {"the paper's networks, set 5 of 5", 0.4, 9},
        {"spreads, noise and other decoders, set 1 of 5", 0.487, 5, 0.45},
        {"spreads, noise and other decoders, set 2 of 5", 0.587, 10, 0.45},
        {"spreads, noise and other decoders, set 3 of 5", 0.687, 10, 0.45},
        {"spreads, noise and other decoders, set 4 of 5", 0.787, 10, 0.45},
        {"spreads, noise and other decoders, set 5 of 5", 0.887, 10, 0.45},
        {"all areas together", 1, 12, 0.45}},
       true,
       // The total was measured with 5 samples per area (177 s of two cores); its parts are estimated.
       {{"samples by Eq. (1)", 0.16, 10, 0.05},
        {"samples by each read-out of the field", 0.8, 165, 0.05},
        {"decoders, each used on every law", 1, 30, 0.9}}},
      {"noise",
       "force error against resistance noise, between the Cramer-Rao bounds",
       noiseReport,
       {{"samples", 0.25, 6, 0.4},
        {"decoders over the noise, row-wire 4", 0.416, 16, 0.93},
        {"decoders over the noise, three row-wires", 0.583, 20, 0.93},
        {"all row-wires, rbf", 0.649, 11, 0.93},
        {"all row-wires, rbf trained clean", 0.683, 38, 0.93},
        {"all row-wires, linear and ml", 0.75, 19, 0.93},
        {"noise of the training", 0.99, 13, 0.93},
        {"other laws and read-outs", 1, 7}},
       true},
      {"layout",
       "what the layout of the electrodes resolves, and a better one",
       layoutReport,
       {{"the block's response", 0.43, 47},
        {"search for a better layout", 0.456, 3},
        {"depth, pitch and laws", 0.46, 0.5},
        {"full samples of this layout", 0.64, 20, 0.5},
        {"full samples, the same on every wire", 0.82, 20, 0.5},
        {"full samples, wire by wire", 1, 20, 0.5}},
       true},
      {"readout",
       "what the circuit decides under the field: read-out, electrode radius, contact, switches and noise",
       readoutReport,
       {{"the block's response", 0.3, 1.6},
        {"the read-outs of the design", 0.4, 0.6},
        {"radius, contact, switches", 1, 3}},
       true},
      {"map",
       "what is resolved of a touch at each place of the surface: smallest force, place, two touches apart",
       mapReport,
       {{"the readings at rest", 0.1, 1},
        {"mesh and factorisation", 0.3, 9},
        {"influence surfaces", 0.6, 6},
        {"maps", 0.75, 6},
        {"touches solved as they are", 1, 14}},
       true},
      {"scenes",
       "which stages of the chain run in each scene: none that is not shown",
       scenesReport,
       {{"the chain in each scene", 1, 30}}},
  };
  return all;
}

ReportOutcome runReport(const ReportComputation& kind, const ReportRequest& request, const ReportProgress& progress,
                        const std::stop_token& stop, const ReportDrawer& draw) {
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
