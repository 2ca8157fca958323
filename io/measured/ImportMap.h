#pragma once

// Private to io.

#include "io/StrictJson.h"
#include "io/measured/MeasuredTable.h"
#include "io/measured/Units.h"

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace palp {

/// A column by its name, or by its number from 1.
using ColumnName = std::variant<std::string, int>;
/// "column "Fx"" or "column 3", for messages.
std::string shownColumn(const ColumnName& column);

/// A number of a sample: a sum of columns with factors, plus an offset; before the unit's factor.
struct ImportedValue {
  struct Part {
    ColumnName column;
    double factor = 1;
  };
  std::vector<Part> parts; ///< empty: not measured
  double offset = 0;
};

/// Time of the rows of a table. A column with dates needs no unit.
struct ImportedClock {
  ColumnName column;
  std::optional<KnownUnit> unit;
  double offset_s = 0; ///< added
};

/// Values of one table. With a clock of their own they are interpolated to the times of the readings,
/// without one they belong to the readings' rows.
struct ImportedGroup {
  int table = 0; ///< from 0
  std::vector<ImportedValue> values;
  std::optional<KnownUnit> unit; ///< none: as the table states
  std::optional<ImportedClock> clock;
};

/// How a resistance follows from what was measured.
struct ReadingLaw {
  enum class Kind {
    Signal,      ///< no resistance: differences from rest count
    Resistance,  ///< in the unit
    Conductance, ///< in the unit
    Code,        ///< ohm_per_code code + zero_ohm
    DividerLow,  ///< share v of the full scale across the sensor: R = resistor v / (1 - v)
    DividerHigh, ///< across the resistor: R = resistor (1 - v) / v
  };
  Kind kind = Kind::Resistance;
  double ohmPerCode = 1, zero_ohm = 0; ///< Code
  double full = 1, resistor_ohm = 1;   ///< dividers
};

/// Which columns of one or several measured tables mean what.
struct ImportMap {
  TableForm form;
  int tables = 1; ///< that belong to one run
  ReadingLaw law;
  std::string signalUnit; ///< as the map states it
  int rowWires = 0, columnWires = 0;
  ImportedGroup readings;              ///< row-wire by row-wire
  ImportedGroup forces_N;              ///< Fx, Fy, Fz on the top face, Fz below 0 when pressed; or none
  bool signsAreGiven = false;          ///< of the forces
  std::vector<ImportedValue> rotation; ///< vector that turns the forces' frame to the tool's; 3 or none
  double radiansPerUnit = 1;           ///< of `rotation`
  std::optional<ImportedValue> area;   ///< number of the loaded area
  int areaCount = 1;
  ImportedGroup places_mm;            ///< x, y from the block's corner, or none
  double length_mm = 0, width_mm = 0; ///< of the block, where positions decide the area; else 0
  int areaColumns = 1, areaRows = 1;
  std::optional<ColumnName> run;     ///< equal texts are one run
  std::optional<ImportedClock> time; ///< of the readings
  double longestGap_s = 0;           ///< between two values that are interpolated; 0: ten times the usual spacing
  bool leaveOutBadRows = false;
  std::string fingerprint; ///< of wires, units and areas: equal for tables of one rig
};

/// Reads a map (resources/docs/formats.md, Import). `file` is for refusals. Throws Error: file, key, value, and what is
/// expected. An unfinished map may lack readings, forces and positions.
ImportMap importMapFrom(Json json, const std::string& file, bool unfinished = false);
ImportMap readImportMap(const std::filesystem::path& path);

} // namespace palp
