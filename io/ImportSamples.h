#pragma once

#include "model/SensorDesign.h"

#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// What is imported.
struct ImportRequest {
  /// One table; several that hold the same rows or have clocks of their own, as the map states; or several runs, one
  /// after the other, each of as many tables.
  std::vector<std::filesystem::path> tables;
  std::filesystem::path map{};          ///< empty: the names of the columns decide
  const SensorDesign* design = nullptr; ///< of the measured sensor, where it is known
  std::filesystem::path output{};       ///< the sample file
  bool force = false;                   ///< replaces an existing one
  bool leaveOutBadRows = false; ///< as the map's key: rows with words or missing values are counted, not refused
};

/// What was imported.
struct Imported {
  std::size_t samples = 0;
  std::size_t unusedColumns = 0; ///< of the tables, which the map does not name
  std::size_t leftOut = 0;       ///< bad rows, rows outside another table's clock, and rows in its gaps
  std::size_t runs = 1;
  std::string design;                  ///< fingerprint that the samples carry
  std::string constant{};              ///< names readings that stay the same in all samples; empty where all vary
  std::vector<std::string> notes{};    ///< how the tables were read and what was assumed: sentences
  std::vector<std::string> warnings{}; ///< what is likely to be wrong with signs, units or rows
};

/// Turns tables that another rig measured (text, or NPZ of arrays) into a sample file, by a map that names their
/// columns and units (resources/docs/formats.md, Import). Row by row: memory does not grow with the table. Of a design
/// the samples take the fingerprint and areas, and must fit its wires. Throws Error, with file and line, or Cancelled;
/// then nothing is left. `progress` gets the share of the tables that is read, 0 to 1.
Imported importSamples(const ImportRequest& request, const std::function<void(double)>& progress,
                       const std::stop_token& stop);

/// The map that the columns' names state, as JSON text to be edited and given as a file, and what was assumed, a
/// sentence each. Throws Error if the names do not tell readings and forces.
struct GuessedMap {
  std::string json;
  std::vector<std::string> assumed;
};
GuessedMap guessImportMap(const std::vector<std::filesystem::path>& tables);

} // namespace palp
