#include "app/study/LiveSource.h"

#include "app/study/Resources.h"
#include "app/study/SimulatedTouch.h"
#include "io/SampleFile.h"

namespace palp {

std::unique_ptr<ReportSource> openBoard(const UsbId& id, const std::string& device) {
  for (const HidBoard& board : hidBoards(id))
    if (device.empty() || board.serial == device || board.path == device) return openHidBoard(board);
  return nullptr;
}

std::unique_ptr<ReportSource> openSimulatedBoard(const SimulatedBoardOptions& options,
                                                 std::shared_ptr<SimulationControl> control) {
  const std::filesystem::path file = options.samples.empty() ? resource("board/paper-samples.csv") : options.samples;
  Board board = simulatedBoard(loadSamples(file), options.disturbance, options.rate_Hz, options.seed);
  board.faults() = options.faults;
  return std::make_unique<SimulatedSource>(std::move(board), std::move(control));
}

std::filesystem::path shippedNetwork() {
  return resource("board/paper-network.json");
}

} // namespace palp
