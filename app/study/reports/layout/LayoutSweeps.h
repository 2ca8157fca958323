#pragma once

#include "app/study/reports/layout/LayoutBound.h"

#include <string>
#include <vector>

namespace palp {

/// One property of the layout changed alone; the others stay as they are.
struct LayoutSweep {
  struct Point {
    double at = 0;
    Eigen::Vector3d withoutPrior_percent; ///< bound, root mean square over the areas
  };
  std::string file, title, caption, xLabel;
  std::vector<Point> points;
};

/// Depth and pitch of both layers, of a row-wire or all with row-wire -1. Under the field fewer points, and Cancelled
/// is thrown where it was stopped.
std::vector<LayoutSweep> layoutSweeps(const SensorDesign& design, const AreaResponse& response, int rowWire,
                                      double relativeNoise, int threads, const ReportProgress& progress = {},
                                      const std::stop_token& stop = {});

} // namespace palp
