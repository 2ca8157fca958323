#pragma once

#include "io/board/Protocol.h"

#include <cstdint>
#include <string>
#include <vector>

namespace palp {

/// Head of a recording.
struct RecordingHead {
  BoardInfo info;
  BoardConfiguration configuration;
  std::string source;             ///< which board, as text
  std::string networkFingerprint; ///< empty: no network in use
  std::int64_t startedUnix_s = 0;
};

/// One entry of a recording.
struct RecordingEntry {
  enum class Kind : std::uint8_t {
    Raw = 0,           ///< report, as it came
    Mark = 1,          ///< text of the user
    Configuration = 2, ///< feature 0x11, when it changed
    Connected = 3,     ///< feature 0x10 of the board after an interruption
    Tare = 4,          ///< what counts as rest from here on (Tare.h); no bytes: no tare any more
  };
  Kind kind = Kind::Raw;
  double hostTime_s = 0;
  std::vector<std::uint8_t> bytes;
};

// The file: "PALPREC1", u32 length and bytes of the head (JSON), then entries: u8 kind, u8 0, u16 length, f64 host time
// [s], bytes. Little-endian. It may end anywhere; complete entries count.

} // namespace palp
