#pragma once

#include "model/base/NamedEnum.h"

#include <cstdint>
#include <string>

namespace palp {

/// Where the Live scene's reports come from.
enum class LiveSourceKind {
  Automatic, ///< the first board; while none is plugged in, the simulated one
  Board,     ///< the board of this serial or path
  Simulated,
  Recording
};
inline constexpr NamedEnum kLiveSourceKinds("source", std::array{std::pair{LiveSourceKind::Automatic, "automatic"},
                                                                 std::pair{LiveSourceKind::Board, "board"},
                                                                 std::pair{LiveSourceKind::Simulated, "simulated"},
                                                                 std::pair{LiveSourceKind::Recording, "recording"}});

/// What the virtual board adds to its resistances, and what is wrong with it.
struct SimulationSettings {
  double noise = 5e-6; ///< relative to R, rms
  double warming_degC = 0;
  double hysteresisShare = 0; ///< of the change of R, 0..1
  std::uint64_t seed = 1;
  int openRow = -1, openColumn = -1; ///< a broken wire; -1: none
  int dropEvery = 0;                 ///< every n-th report is lost; 0: none

  bool operator==(const SimulationSettings&) const = default;
};

/// Everything that the Live scene keeps in a project.
struct LiveSettings {
  LiveSourceKind source = LiveSourceKind::Automatic;
  std::string device;    ///< serial or path of the board
  std::string recording; ///< file to play
  double replaySpeed = 1;
  SimulationSettings simulation;
  int rate_Hz = 1000;  ///< reports a second
  int row = -1;        ///< scanned alone; -1: all rows
  std::string network; ///< file; empty: the one that ships with Palp
  int tareFrames = 25;
  double arrow_mm_per_N = 2;
  double change_percent = 0.3; ///< end of the scale of dR/R
  double window_s = 10;        ///< of the curves

  bool operator==(const LiveSettings&) const = default;
};

} // namespace palp
