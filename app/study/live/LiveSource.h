#pragma once

#include "app/study/live/SimulatedTouch.h"
#include "io/board/HidBoards.h"
#include "io/board/ReplaySource.h"
#include "io/board/SimulatedSource.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace palp {

/// The board with this serial or path (empty: the first one); null where it is not there.
std::unique_ptr<ReportSource> openBoard(const UsbId& id, const std::string& device);

/// How boards are listed and opened; tests put their own in place of USB.
struct BoardAccess {
  std::function<std::vector<HidBoard>()> list = [] { return hidBoards(); };
  /// By serial or path (empty: the first one); null where it is not there.
  std::function<std::unique_ptr<ReportSource>(const std::string& device)> open = [](const std::string& device) {
    return openBoard({}, device);
  };
  /// What there is of devices: where it stays the same, so does `list`.
  std::function<std::vector<std::string>()> nodes = [] { return hidNodes(); };
  /// Nobody else in this program reads the board.
  std::function<bool(const HidBoard&)> free = [](const HidBoard&) { return true; };
};

/// What the simulated board is.
struct SimulatedBoardOptions {
  std::filesystem::path samples;           ///< solved samples that drive it; empty: those that ship with Palp
  std::shared_ptr<const SampleSet> solved; ///< in place of a file
  std::shared_ptr<TouchHand> hand;         ///< null: the touch moves over the areas automatically
  BoardDisturbance disturbance;
  BoardFaults faults;
  int rate_Hz = 1000;
  std::uint64_t seed = 1;
};
/// The file of samples that drives it.
std::filesystem::path simulatedSamples(const SimulatedBoardOptions& options);
std::unique_ptr<ReportSource> openSimulatedBoard(const SimulatedBoardOptions& options,
                                                 std::shared_ptr<SimulationControl> control = {});

/// The network that ships with Palp: all rows of the paper's design, for the noise of a good board.
std::filesystem::path shippedNetwork();

} // namespace palp
