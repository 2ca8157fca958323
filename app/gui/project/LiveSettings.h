#pragma once

#include "app/study/live/ForceAlarm.h"
#include "model/base/NamedEnum.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace palp {

struct BoardFrames;
struct CalibratedNetwork;

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
  bool held = false; ///< the touch is the next two, instead of one that moves over the areas automatically
  int heldArea = 0;
  std::array<double, 3> heldForce_N{0, 0, -2};
  bool moving = false;                        ///< an indenter that presses anywhere, in place of the areas
  std::array<double, 2> heldPlace_mm{15, 15}; ///< its place, where it is held

  bool operator==(const SimulationSettings&) const = default;
};

/// The scale of the force curves.
enum class ForceScale {
  Network,   ///< the force range that the network was trained for
  Automatic, ///< what the curves need
  Fixed
};
inline constexpr NamedEnum kForceScales("force scale", std::array{std::pair{ForceScale::Network, "network"},
                                                                  std::pair{ForceScale::Automatic, "automatic"},
                                                                  std::pair{ForceScale::Fixed, "fixed"}});

/// Another program that gets the forces, as `palp listen --send` names it.
struct LiveReceiver {
  std::string to;
  bool on = true;
  /// Off, although on in the file: it sends beyond this computer and waits for the user's confirmation. A file that
  /// is written has it on again.
  bool heldBack = false;

  bool operator==(const LiveReceiver&) const = default;
};

/// Everything that the Live scene keeps in a project.
struct LiveSettings {
  LiveSourceKind source = LiveSourceKind::Automatic;
  std::string device;    ///< serial or path of the board
  std::string recording; ///< file to play
  double replaySpeed = 1;
  SimulationSettings simulation;
  int rate_Hz = 1000;  ///< reports per second
  int row = -1;        ///< scanned alone; -1: all rows
  std::string network; ///< file; empty: the one that ships with Palp
  int tareFrames = 25;
  double arrow_mm_per_N = 2;
  double change_percent = 0.3; ///< end of the scale of dR/R
  double window_s = 10;        ///< of the curves
  ForceScale forceScale = ForceScale::Network;
  double force_N = 5; ///< both ends of the fixed scale
  bool alarmOn = false;
  ForceAlarm alarm;
  std::vector<LiveReceiver> receivers;                 ///< no two of one address
  std::shared_ptr<const BoardFrames> frames;           ///< labelled; null: none
  std::shared_ptr<const CalibratedNetwork> calibrated; ///< in use in place of `network`; null: none

  static constexpr std::size_t kMostReceivers = 8;

  bool operator==(const LiveSettings&) const = default;
};

} // namespace palp
