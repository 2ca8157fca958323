#pragma once

#include "io/board/RecordingWriter.h"
#include "io/board/VirtualBoard.h"
#include "model/FieldAtRest.h"

#include <filesystem>
#include <functional>

namespace palp {

/// Resistances of a design under the field at rest [ohm].
inline Eigen::MatrixXd fieldAtRest_ohm(const SensorDesign& design) {
  const FieldLaw& law = *design.field();
  return NetworkReading(networkAtRest(design, law), law.readout).resistances_ohm();
}

/// Records a virtual board with these resistances; of the paper's wires. `now` may change them with time.
inline void recordBoard(const std::filesystem::path& path, BoardSettings settings, Eigen::MatrixXd resistances_ohm,
                        int frames, const std::function<void(double time_s, Eigen::MatrixXd&)>& now = {}) {
  VirtualBoard board(settings, [&](double time_s) -> const Eigen::MatrixXd& {
    if (now) now(time_s, resistances_ohm);
    return resistances_ohm;
  });
  RecordingHead head;
  head.info = settings.info;
  head.configuration = settings.configuration;
  RecordingWriter writer(path, head, true);
  const auto end_us = static_cast<std::uint64_t>(20'000) * static_cast<std::uint64_t>(frames); // 20 reports at 1000/s
  for (std::uint64_t clock_us = 0; clock_us < end_us; clock_us += 1000)
    board.advance(clock_us, [&](std::span<const std::uint8_t> report) {
      writer.append(RecordingEntry::Kind::Raw, 1e-6 * static_cast<double>(clock_us), report);
    });
}

} // namespace palp
