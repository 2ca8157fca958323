#pragma once

#include <string>
#include <vector>

namespace palp {

/// What the block's surface is coloured by.
enum class Quantity { Displacement, DisplacementX, DisplacementY, DisplacementZ, Pressure, VolumeChange, VonMises };

/// All of them, in the order of a list to choose from.
const std::vector<Quantity>& allQuantities();
/// "|u|", "ux", ..., "J - 1", "von Mises stress", without the unit.
std::string quantityName(Quantity quantity);
std::string quantityUnit(Quantity quantity);

} // namespace palp
