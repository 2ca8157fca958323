#pragma once

// Private to io.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace palp {

/// A number of the table in the units of Palp: factor x + offset.
struct ImportedColumn {
  std::string name;
  double factor = 1;
  double offset = 0;
};

/// Which columns of a measured table mean what.
struct ImportMap {
  char separator = ','; ///< of CSV
  int rowWires = 0, columnWires = 0;
  std::vector<ImportedColumn> resistances_ohm; ///< row-wire by row-wire
  std::vector<ImportedColumn> forces_N;        ///< Fx, Fy, Fz on the top face, Fz below 0 when pressed
  std::optional<ImportedColumn> area;          ///< number of the loaded area
  int areaCount = 1;
  std::vector<ImportedColumn> place_mm; ///< x, y from the block's corner; decides the area where no column does
  double length_mm = 0, width_mm = 0;   ///< of the block, with `place_mm`
  int areaColumns = 1, areaRows = 1;    ///< with `place_mm`
  std::optional<ImportedColumn> time_s; ///< must not go back
  std::string fingerprint;              ///< of wires, units and areas: equal for tables of one rig
};

/// Throws Error: file, key, value, and what is allowed.
ImportMap readImportMap(const std::filesystem::path& path);

} // namespace palp
