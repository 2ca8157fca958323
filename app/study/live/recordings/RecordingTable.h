#pragma once

#include "io/Decoder.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>

namespace palp {

/// A recording, what decodes it, and where its table goes.
struct RecordingTableRequest {
  std::filesystem::path recording, table;
  std::optional<Decoder> decoder;     ///< none: resistances alone
  std::optional<SensorDesign> design; ///< at rest, for the recording's tare
  std::string head;                   ///< complete lines before the columns
  bool force = false;                 ///< replaces the table
};

struct RecordingTableReport {
  std::uint64_t frames = 0;
  std::string note; ///< why there are no forces, or where the recording ends before its time; empty else
};

/// Writes every frame of a recording as CSV, as fast as it can be read: the columns of `palp listen --send csv:`, then
/// time in the recording, losses, temperature, misfit, mark, why there are no forces or why they are doubted, and all
/// resistances [ohm] as in samples; empty cells where something is not known. `progress`: share 0..1, a few times a
/// second. Throws Error where it cannot be read or written, Cancelled; then no table is left.
RecordingTableReport writeRecordingTable(const RecordingTableRequest& request,
                                         const std::function<void(double share)>& progress,
                                         const std::stop_token& stop);

} // namespace palp
