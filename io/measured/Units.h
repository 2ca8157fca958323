#pragma once

// Private to io: units of measured tables.

#include <optional>
#include <string>
#include <string_view>

namespace palp {

enum class Quantity { Resistance, Conductance, Force, Length, Time };

/// Factor to ohm, siemens, newton, millimetre or second, and what it is a unit of. Loggers' spellings are known:
/// "kOhm", "kΩ", "msec", "Newton". Nothing for any other text.
struct KnownUnit {
  Quantity quantity;
  double factor;
  const char* name; ///< as maps write it: "kohm"
};
std::optional<KnownUnit> knownUnit(std::string_view text);

/// The unit at the end of a column's name: "Fx [N]", "time (ms)", "t_ms". Nothing where there is no known one.
std::optional<KnownUnit> unitInName(std::string_view name);

/// The units of a quantity, for refusals: "N, mN, gf or kgf".
std::string unitsOf(Quantity quantity);

} // namespace palp
