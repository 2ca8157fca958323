#pragma once

#include "app/scenes/block/Quantity.h"
#include "model/Solution.h"

#include <vector>

namespace palp {

/// The quantity at the nodes.
std::vector<double> quantityValues(Quantity quantity, const NodalFields& fields);
/// Less that of other fields at the same nodes.
std::vector<double> quantityValues(Quantity quantity, const NodalFields& fields, const NodalFields& less);

} // namespace palp
