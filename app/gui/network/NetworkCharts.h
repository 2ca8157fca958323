#pragma once

#include "app/gui/jobs/NetworkSession.h"
#include "app/scenes/charts/Chart.h"

#include <optional>

namespace palp {

class ChartView;

/// A chart of the Network scene.
ChartView* networkChart(const char* name);

/// The spread of the smallest errors that the paper prints for this input.
double paperSpread(InputKind input);

/// Test error (Eq. 13) against spread, with the paper's points for the same input.
ChartSpec sweepErrorChart(const std::vector<SweepPoint>& points, const NetworkFit* fit, InputKind input);
/// Leave-one-out error and condition of the system against spread.
ChartSpec sweepLeaveOneOutChart(const std::vector<SweepPoint>& points);
ChartSpec sweepConditionChart(const std::vector<SweepPoint>& points);
/// Error against training time over a sweep.
ChartSpec errorTimeChart(const std::vector<SweepPoint>& points);
/// Decoupled against true force of one direction (0, 1, 2), all test samples of one area (Figs. 8-10, 13-15).
ChartSpec decoupledChart(const NetworkSamples& samples, const NetworkFit& fit, int direction, int area);
/// Relative error by sample of one area (Figs. 11, 16).
ChartSpec relativeErrorChart(const NetworkSamples& samples, const NetworkFit& fit, int area);

/// How far off the decoupled places are, where there are such.
ChartSpec placeErrorChart(const NetworkSamples& samples, const NetworkFit& fit);

/// Mean error of each decoder (Eq. 13, over Fx, Fy, Fz) on the axes of the sweep: a sweep as a curve, one that was
/// trained at a spread as a point there, and those that have none as a line across the width.
ChartSpec trialsErrorChart(const std::vector<DecoderTrial>& trials, const std::vector<SweepPoint>& sweep,
                           InputKind input);
/// The same errors against the time of training.
ChartSpec trialsTimeChart(const std::vector<DecoderTrial>& trials);

} // namespace palp
