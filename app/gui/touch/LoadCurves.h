#pragma once

#include "app/scenes/charts/Chart.h"
#include "app/study/touch/Touch.h"

namespace palp {

/// Reaction of the clamped bottom on the block against the place on the load path, at the equilibria that were
/// computed. By balance with the forces on the top: an equilibrium is none but for 1e-10 of them. Empty before a
/// solution.
ChartSpec reactionChart(const Touch& touch);

/// Force against displacement along the load path: of areas and discs the length of their total force against the
/// largest displacement, of each indenter its force against its depth. Empty before a solution.
ChartSpec forceDisplacementChart(const Touch& touch);

} // namespace palp
