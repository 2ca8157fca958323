#pragma once

#include "model/SensorDesign.h"

#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// Arguments of importSamples.
struct ImportRequest {
  /// The tables of one run: one, or several that the map joins row by row or by clocks of their own. More tables are
  /// further runs, each with the same number of tables.
  std::vector<std::filesystem::path> tables;
  std::filesystem::path map{};          ///< empty: the map is guessed from the names of the columns (guessImportMap)
  const SensorDesign* design = nullptr; ///< of the measured sensor; nullptr if unknown
  std::filesystem::path output{};       ///< the sample file
  bool force = false;                   ///< replaces an existing output file
  bool leaveOutBadRows = false; ///< as `bad_rows` of the map: skips and counts rows with words or missing values
  std::string mapText{};        ///< JSON of a map, in place of the file `map`; empty: none
};

/// Result of importSamples.
struct Imported {
  std::size_t samples = 0;
  std::size_t unusedColumns = 0; ///< columns of the tables that the map does not name
  std::size_t leftOut = 0;       ///< bad rows, rows outside another table's clock, and rows in its gaps
  std::size_t runs = 1;
  std::string design;                  ///< fingerprint in the sample file
  std::string constant{};              ///< names the readings that are equal in all samples; empty if all vary
  std::vector<std::string> notes{};    ///< how the tables were read and what was assumed: sentences
  std::vector<std::string> warnings{}; ///< likely mistakes in signs, units or rows: sentences
};

/// Converts tables that another rig measured (text, NPZ, HDF5 or MAT) into a sample file, by a map that names their
/// columns and units (resources/docs/formats.md, Import). Reads row by row: only values with a clock of their own are
/// kept in memory. With a design the samples have its fingerprint and areas, and must match its wires. Throws Error
/// with file and line, or Cancelled; in both cases no output is written. `progress` receives the share of the tables
/// that has been read, 0 to 1.
Imported importSamples(const ImportRequest& request, const std::function<void(double)>& progress,
                       const std::stop_token& stop);

/// The same without writing: everything that importSamples would refuse, note or warn of, except about the output.
Imported checkImport(const ImportRequest& request, const std::function<void(double)>& progress,
                     const std::stop_token& stop);

/// An import map as JSON text, to be edited and passed as a file, and its assumptions, one sentence each.
struct GuessedMap {
  std::string json;
  std::vector<std::string> assumed;
  std::string
      missing{}; ///< readings or forces that the names do not identify: a sentence; empty if the map is complete
};
/// Guesses the map from the names of the columns. Throws Error if they do not identify readings and forces.
GuessedMap guessImportMap(const std::vector<std::filesystem::path>& tables);

} // namespace palp
