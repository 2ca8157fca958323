#pragma once

#include "app/gui/project/LiveSettings.h"
#include "app/gui/views/StripChart.h"
#include "app/scenes/block/LiveScene.h"
#include "app/scenes/charts/Heatmap.h"
#include "app/study/live/LiveHistory.h"
#include "app/study/live/SimulatedTouch.h"

#include <optional>

namespace palp {

/// dR/R of all cells [%] on a fixed scale; cells of broken wires are not numbers.
HeatmapSpec changeHeatmap(const LiveFrame& frame, const std::string& restName, const LiveSettings& settings,
                          const std::optional<std::array<int, 2>>& selected);

/// Forces of the touched area, or of the most loaded one where the network gives the forces on all areas together;
/// those components alone that the network gives, and hatched times where forces can hardly be true. The alarm's limit
/// is drawn across.
StripSpec forceCurves(const LiveHistory& history, const LiveSettings& settings, const Decoder* decoder);

/// dR/R of some cells (row, column) over time.
StripSpec changeCurves(const LiveHistory& history, const LiveSettings& settings,
                       const std::vector<std::array<int, 2>>& cells);

/// The cell that lies nearest to the middle of each load area.
std::vector<std::array<int, 2>> areaCells(const SensorDesign& design, Eigen::Index rows, Eigen::Index columns);

/// The arrows of a frame: forces above the noise.
std::vector<LiveArrow> arrowsOf(const DecodedForces& forces);
/// What truly touches the simulated board, and how far off the decoded place is.
std::string truthLine(const SimulatedTouch::Truth& truth, const DecodedForces& forces);
/// The forces as text, with their deviations and what these do not include (deviationNote); the first is the scale.
std::vector<std::string> forceLines(const LiveFrame& frame, const LiveSettings& settings, const std::string& note = {});

} // namespace palp
