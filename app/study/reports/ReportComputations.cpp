#include "app/study/reports/ReportComputations.h"

#include "app/study/reports/errortime/ErrorTimeReport.h"
#include "app/study/reports/layout/LayoutReport.h"
#include "app/study/reports/networks/NetworksReport.h"
#include "app/study/reports/networks/NoiseReport.h"
#include "app/study/reports/scenes/ScenesReport.h"
#include "app/study/reports/stability/StabilityReport.h"
#include "model/base/Cancelled.h"

#include <chrono>

namespace palp {

const std::vector<ReportComputation>& reportComputations() {
  static const std::vector<ReportComputation> all{
      {"error-time", "error against run time: solver, networks, samples and the whole chain", errorTimeReport},
      {"stability", "extreme cases of the solver, the networks and Eq. (1), and how each came out", stabilityReport},
      {"networks", "what is asked of the networks, line by line, on fresh forces and all areas", networksReport},
      {"noise", "force error against resistance noise, between the Cramer-Rao bounds", noiseReport},
      {"layout", "what the layout of the electrodes resolves, and a better one", layoutReport},
      {"scenes", "what each scene and each command costs, and that nothing is computed that is not shown",
       scenesReport},
  };
  return all;
}

ReportOutcome runReport(const ReportComputation& kind, const ReportRequest& request, const ReportProgress& progress,
                        const std::stop_token& stop, const ChartDrawer& draw) {
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
