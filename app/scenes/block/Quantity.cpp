#include "app/scenes/block/Quantity.h"

#include <array>

namespace palp {

namespace {

struct Label {
  const char* name;
  const char* unit;
};

/// In the enumeration's order.
constexpr std::array<Label, 7> kLabels{{{"|u|", "mm"},
                                        {"ux", "mm"},
                                        {"uy", "mm"},
                                        {"uz", "mm"},
                                        {"pressure", "MPa"},
                                        {"J - 1", ""},
                                        {"von Mises stress", "MPa"}}};

} // namespace

const std::vector<Quantity>& allQuantities() {
  static const std::vector<Quantity> all{Quantity::Displacement,  Quantity::DisplacementX, Quantity::DisplacementY,
                                         Quantity::DisplacementZ, Quantity::Pressure,      Quantity::VolumeChange,
                                         Quantity::VonMises};
  return all;
}

std::string quantityName(Quantity quantity) {
  return kLabels[static_cast<std::size_t>(quantity)].name;
}

std::string quantityUnit(Quantity quantity) {
  return kLabels[static_cast<std::size_t>(quantity)].unit;
}

} // namespace palp
