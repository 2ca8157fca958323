#pragma once

#include "io/board/HostClock.h"
#include "io/board/Protocol.h"
#include "model/base/Error.h"

#include <chrono>
#include <string>
#include <vector>

namespace palp {

/// A board that cannot be opened, or whose messages this program does not understand.
struct BoardError : Error {
  using Error::Error;
};

/// An existing board that may not be opened by this user.
struct BoardPermissionError : BoardError {
  using BoardError::BoardError;
};

/// One report as it came, of whatever length.
struct RawReport {
  double hostTime_s = 0;
  std::vector<std::uint8_t> bytes;
};

/// Where reports come from: a board on USB, a recording or the virtual board. One thread owns a source and alone calls
/// it.
class ReportSource {
public:
  enum class Outcome {
    Read,    ///< one was read
    Nothing, ///< none within the time
    Gone,    ///< the board was pulled out
    End      ///< of the recording
  };

  virtual ~ReportSource() = default;

  /// Which board, as text.
  [[nodiscard]] virtual std::string name() const = 0;
  /// Wires, references [ohm] and highest rate [reports/s]: resistances are in ohm, times in seconds.
  [[nodiscard]] virtual const BoardInfo& info() const = 0;
  /// As read last; readConfiguration asks the board again.
  [[nodiscard]] virtual const BoardConfiguration& configuration() const = 0;
  virtual void readConfiguration() {}
  /// Waits at most this long.
  virtual Outcome read(RawReport& report, std::chrono::milliseconds timeout) = 0;

  /// False where the board refuses; a recording refuses all.
  virtual bool configure(const BoardConfiguration&) { return false; }
  virtual bool send(const BoardCommand&) { return false; }
  /// Why reading ended, where it is Gone.
  [[nodiscard]] virtual std::string reason() const { return {}; }
};

} // namespace palp
