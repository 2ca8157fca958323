#pragma once

#include "model/SensorDesign.h"

#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>

namespace palp {

/// What was imported.
struct Imported {
  std::size_t samples = 0;
  std::size_t unusedColumns = 0; ///< of the table, which the map does not name
  std::string design;            ///< fingerprint that the samples carry
  std::string constant{};        ///< names readings that stay the same in all samples; empty where all vary
};

/// Turns a table that another rig measured (CSV, or NPZ of arrays) into a sample file, by a map that names its columns
/// and their units (resources/docs/formats.md, Import). Line by line: memory does not grow with the table. Of `design`,
/// where there is one, the samples take the fingerprint and areas, and must fit its wires. Throws Error, with file and
/// line, or Cancelled; then nothing is left. `progress` gets the share of the table that is read, 0 to 1.
Imported importSamples(const std::filesystem::path& table, const std::filesystem::path& map, const SensorDesign* design,
                       const std::filesystem::path& output, bool force, const std::function<void(double)>& progress,
                       const std::stop_token& stop);

} // namespace palp
