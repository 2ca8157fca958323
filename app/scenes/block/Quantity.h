#pragma once

#include "model/base/NamedEnum.h"

#include <string>
#include <vector>

namespace palp {

/// What the block's surface is coloured by.
enum class Quantity {
  Displacement,
  DisplacementX,
  DisplacementY,
  DisplacementZ,
  Pressure,
  VolumeChange,
  VonMises,
  StressXX, ///< Cauchy stress, in the order of NodalFields
  StressYY,
  StressZZ,
  StressXY,
  StressYZ,
  StressXZ,
  LargestStretch, ///< principal stretches
  MiddleStretch,
  SmallestStretch,
  ContactPressure, ///< of indenters: force per area at rest, along -z
  ContactShear,    ///< the same across z
  FrictionUsed     ///< shear over pressure: what slips is at the coefficient of friction, what sticks below it
};
inline constexpr NamedEnum kQuantities(
    "quantity",
    std::array{
        std::pair{Quantity::Displacement, "|u|"}, std::pair{Quantity::DisplacementX, "ux"},
        std::pair{Quantity::DisplacementY, "uy"}, std::pair{Quantity::DisplacementZ, "uz"},
        std::pair{Quantity::Pressure, "pressure"}, std::pair{Quantity::VolumeChange, "J - 1"},
        std::pair{Quantity::VonMises, "von Mises stress"}, std::pair{Quantity::StressXX, "stress xx"},
        std::pair{Quantity::StressYY, "stress yy"}, std::pair{Quantity::StressZZ, "stress zz"},
        std::pair{Quantity::StressXY, "stress xy"}, std::pair{Quantity::StressYZ, "stress yz"},
        std::pair{Quantity::StressXZ, "stress xz"}, std::pair{Quantity::LargestStretch, "largest stretch"},
        std::pair{Quantity::MiddleStretch, "middle stretch"}, std::pair{Quantity::SmallestStretch, "smallest stretch"},
        std::pair{Quantity::ContactPressure, "contact pressure"}, std::pair{Quantity::ContactShear, "contact shear"},
        std::pair{Quantity::FrictionUsed, "contact shear / pressure"}});

/// Of indenters alone: 0 without them.
inline bool isOfContact(Quantity quantity) {
  return quantity == Quantity::ContactPressure || quantity == Quantity::ContactShear ||
         quantity == Quantity::FrictionUsed;
}
/// All of them, in the order of a list to choose from.
const std::vector<Quantity>& allQuantities();
/// "|u|", "ux", ..., "J - 1", "von Mises stress", "stress xx", ..., without the unit.
std::string quantityName(Quantity quantity);
std::string quantityUnit(Quantity quantity);

} // namespace palp
