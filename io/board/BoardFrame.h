#pragma once

#include "io/board/Protocol.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace palp {

/// State of a pair of wires by its reading.
enum class ReadingState : std::uint8_t { Missing, Good, Short, Open, NotMeasured };

/// One scan of the row-wires, raw.
struct BoardFrame {
  std::uint16_t number = 0;
  double time_s = 0;             ///< device clock at the first reading, unwrapped; 0 at the first report after a start
  double endTime_s = 0;          ///< the same of the frame's last report
  double hostTime_s = 0;         ///< arrival of the last report of the frame
  std::vector<bool> rowExpected; ///< by the board's mode and mask
  Eigen::MatrixXd resistances_ohm; ///< row-wires x column-wires; 0 where the state is not Good
  Eigen::Matrix<ReadingState, Eigen::Dynamic, Eigen::Dynamic> state;
  std::uint8_t flags = 0; ///< ReadingFlag of all reports together
  std::optional<double> temperature_degC;
  bool complete = false;  ///< every expected report has come
  bool restarted = false; ///< the board began anew before this frame

  /// All readings of the row-wire are good.
  [[nodiscard]] bool rowGood(int row) const;
};

/// State and resistance [ohm] of a divider code c = 2^24 R / (R + reference).
struct DecodedReading {
  ReadingState state = ReadingState::Missing;
  double resistance_ohm = 0;
};
DecodedReading decodeCode(std::uint32_t code, double reference_ohm);
/// The code of a resistance; of infinity open, of zero short.
std::uint32_t encodeResistance(double resistance_ohm, double reference_ohm);

/// Faults of the wires, as text: "column-wire 7: open", "row-wire 4, column-wire 2: short"; empty where all
/// is well.
std::vector<std::string> wireFaults(const BoardFrame& frame);

} // namespace palp
