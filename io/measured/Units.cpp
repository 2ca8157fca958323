#include "io/measured/Units.h"

#include "io/measured/FieldNumber.h"

#include <array>
#include <cctype>

namespace palp {

namespace {

struct Spelling {
  const char* text; ///< in lower case, but for those that differ by case alone
  KnownUnit unit;
};

constexpr KnownUnit kOhm{Quantity::Resistance, 1, "ohm"}, kKilohm{Quantity::Resistance, 1e3, "kohm"},
    kMegohm{Quantity::Resistance, 1e6, "Mohm"}, kSiemens{Quantity::Conductance, 1, "S"},
    kMillisiemens{Quantity::Conductance, 1e-3, "mS"}, kMicrosiemens{Quantity::Conductance, 1e-6, "uS"},
    kNewton{Quantity::Force, 1, "N"}, kMillinewton{Quantity::Force, 1e-3, "mN"},
    kKilonewton{Quantity::Force, 1e3, "kN"}, kGramforce{Quantity::Force, 9.80665e-3, "gf"},
    kKilogramforce{Quantity::Force, 9.80665, "kgf"}, kPoundforce{Quantity::Force, 4.4482216152605, "lbf"},
    kMillimetre{Quantity::Length, 1, "mm"}, kCentimetre{Quantity::Length, 10, "cm"}, kMetre{Quantity::Length, 1e3, "m"},
    kMicrometre{Quantity::Length, 1e-3, "um"}, kInch{Quantity::Length, 25.4, "in"}, kSecond{Quantity::Time, 1, "s"},
    kMillisecond{Quantity::Time, 1e-3, "ms"}, kMicrosecond{Quantity::Time, 1e-6, "us"},
    kNanosecond{Quantity::Time, 1e-9, "ns"}, kMinute{Quantity::Time, 60, "min"};

/// As written first, then by lower case; mN and MN, mohm and Mohm, mS and ms differ by case alone.
constexpr std::array kSpellings{
    Spelling{"ohm", kOhm},           Spelling{"ohms", kOhm},        Spelling{"kohm", kKilohm},
    Spelling{"kohms", kKilohm},      Spelling{"Mohm", kMegohm},     Spelling{"MOhm", kMegohm},
    Spelling{"S", kSiemens},         Spelling{"mS", kMillisiemens}, Spelling{"uS", kMicrosiemens},
    Spelling{"N", kNewton},          Spelling{"newton", kNewton},   Spelling{"newtons", kNewton},
    Spelling{"mN", kMillinewton},    Spelling{"kN", kKilonewton},   Spelling{"gf", kGramforce},
    Spelling{"kgf", kKilogramforce}, Spelling{"lbf", kPoundforce},  Spelling{"mm", kMillimetre},
    Spelling{"cm", kCentimetre},     Spelling{"m", kMetre},         Spelling{"um", kMicrometre},
    Spelling{"in", kInch},           Spelling{"s", kSecond},        Spelling{"sec", kSecond},
    Spelling{"secs", kSecond},       Spelling{"seconds", kSecond},  Spelling{"ms", kMillisecond},
    Spelling{"msec", kMillisecond},  Spelling{"us", kMicrosecond},  Spelling{"usec", kMicrosecond},
    Spelling{"ns", kNanosecond},     Spelling{"min", kMinute},
};

std::string lower(std::string_view text) {
  std::string all(text);
  for (char& letter : all) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return all;
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// "[N]", "(N)", "/ N" without what is around the unit.
std::string_view bare(std::string_view text) {
  text = trimmedField(text);
  if (text.size() > 2 && ((text.front() == '[' && text.back() == ']') || (text.front() == '(' && text.back() == ')')))
    text = text.substr(1, text.size() - 2);
  return trimmedField(text);
}

} // namespace

std::optional<KnownUnit> knownUnit(std::string_view text) {
  std::string unit = replaced(std::string(bare(text)), "\u03A9", "ohm"); // Greek capital omega, and the sign of ohm
  unit = replaced(unit, "\u2126", "ohm");
  unit = replaced(replaced(unit, "\u00B5", "u"), "\u03BC", "u"); // micro
  for (const Spelling& spelling : kSpellings)
    if (unit == spelling.text) return spelling.unit;
  for (const Spelling& spelling : kSpellings)
    if (unit.size() > 2 && lower(unit) == spelling.text) return spelling.unit;
  return {};
}

std::optional<KnownUnit> unitInName(std::string_view name) {
  name = trimmedField(name);
  for (const char* brackets : {"[]", "()"})
    if (const std::size_t open = name.rfind(brackets[0]); open != std::string_view::npos && name.back() == brackets[1])
      return knownUnit(name.substr(open));
  for (const char separator : {'_', '/', ' '})
    if (const std::size_t at = name.rfind(separator); at != std::string_view::npos && at > 0)
      if (const auto unit = knownUnit(name.substr(at + 1))) return unit;
  return {};
}

std::string unitsOf(Quantity quantity) {
  std::string all;
  const char* last = "";
  for (const Spelling& spelling : kSpellings) {
    if (spelling.unit.quantity != quantity || std::string_view(spelling.unit.name) == last) continue;
    last = spelling.unit.name;
    all += (all.empty() ? "" : ", ") + std::string(last);
  }
  const std::size_t comma = all.rfind(", ");
  return comma == std::string::npos ? all : all.substr(0, comma) + " or " + all.substr(comma + 2);
}

} // namespace palp
