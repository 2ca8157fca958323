#include "app/study/reports/ReportComputations.h"

#include "app/study/reports/LayoutReport.h"
#include "app/study/reports/StabilityReport.h"

#include <chrono>

namespace palp {

const std::vector<ReportComputation>& reportComputations() {
  static const std::vector<ReportComputation> all{
      {"stability", "extreme cases of the solver, the networks and Eq. (1), and how each came out", stabilityReport},
      {"layout", "what the layout of the electrodes resolves, and a better one", layoutReport},
  };
  return all;
}

ReportOutcome runReport(const ReportComputation& kind, const ReportRequest& request, const ReportProgress& progress,
                        std::stop_token stop, const ChartDrawer& draw) {
  const auto start = std::chrono::steady_clock::now();
  const std::optional<ReportContent> content = kind.compute(request, progress, std::move(stop));
  if (!content) return {};
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return writeReport(*content, request, seconds, draw);
}

} // namespace palp
