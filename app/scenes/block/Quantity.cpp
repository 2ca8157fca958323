#include "app/scenes/block/Quantity.h"

namespace palp {

const std::vector<Quantity>& allQuantities() {
  static const std::vector<Quantity> all = [] {
    std::vector<Quantity> quantities;
    for (const auto& [quantity, name] : kQuantities.all()) quantities.push_back(quantity);
    return quantities;
  }();
  return all;
}

std::string quantityName(Quantity quantity) {
  return kQuantities.name(quantity);
}

std::string quantityUnit(Quantity quantity) {
  switch (quantity) {
  case Quantity::Displacement:
  case Quantity::DisplacementX:
  case Quantity::DisplacementY:
  case Quantity::DisplacementZ:
    return "mm";
  case Quantity::Pressure:
  case Quantity::VonMises:
  case Quantity::StressXX:
  case Quantity::StressYY:
  case Quantity::StressZZ:
  case Quantity::StressXY:
  case Quantity::StressYZ:
  case Quantity::StressXZ:
  case Quantity::ContactPressure:
  case Quantity::ContactShear:
    return "MPa";
  case Quantity::VolumeChange:
  case Quantity::LargestStretch:
  case Quantity::MiddleStretch:
  case Quantity::SmallestStretch:
  case Quantity::FrictionUsed:
    return "";
  }
  return "";
}

} // namespace palp
