#pragma once

#include "model/base/NamedEnum.h"

#include <array>
#include <variant>

namespace palp {

/// Eq. (1): every pair of an upper and a lower electrode is a resistor of its own, R = rate x distance.
struct PairsLaw {
  double rate_ohm_per_mm = 1000;
  bool operator==(const PairsLaw&) const = default;
};

/// Which wires carry which voltage while the resistance of a row-wire and a column-wire is read.
enum class Readout {
  Floating,      ///< the two alone are driven, no other wire carries a current
  VirtualGround, ///< the row-wire is driven, all else is at 0 V, the column-wire's current is read
  RowsGrounded,  ///< as VirtualGround, but the other column-wires float
  OthersAtHalf   ///< all other wires are at half of the drive voltage
};

inline constexpr NamedEnum kReadouts("readout", std::array{std::pair{Readout::Floating, "floating"},
                                                           std::pair{Readout::VirtualGround, "virtual_ground"},
                                                           std::pair{Readout::RowsGrounded, "rows_grounded"},
                                                           std::pair{Readout::OthersAtHalf, "others_at_half"}});

/// The conduction field of the complete block between small spherical electrodes, of which all of a wire have one
/// potential; the rubber's conductivity is the same in all directions, also where it is deformed.
struct FieldLaw {
  double resistivity_ohm_mm = 2000;
  double electrodeRadius_mm = 0.2;
  double contact_ohm_mm2 = 0; ///< between an electrode and the rubber
  double wire_ohm = 0;        ///< of a wire and its switch, outside of the block
  Readout readout = Readout::Floating;
  bool operator==(const FieldLaw&) const = default;
};

/// The law from the electrodes' positions to resistances.
using ResistanceLaw = std::variant<PairsLaw, FieldLaw>;

} // namespace palp
