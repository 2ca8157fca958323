#include "app/study/live/LiveSource.h"

#include "app/study/Resources.h"
#include "io/SampleFile.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"

namespace palp {

namespace {

void refuseOutside(const std::string& what, const std::vector<int>& broken, int wires) {
  for (const int wire : broken)
    if (wire < 0 || wire >= wires)
      throw Error("virtual board: broken " + what + ": " +
                  gotExpected(std::to_string(wire), "0 to " + std::to_string(wires - 1)));
}

} // namespace

std::unique_ptr<ReportSource> openBoard(const UsbId& id, const std::string& device) {
  for (const HidBoard& board : hidBoards(id))
    if (device.empty() || board.serial == device || board.path == device) return openHidBoard(board);
  return nullptr;
}

std::filesystem::path simulatedSamples(const SimulatedBoardOptions& options) {
  return options.samples.empty() ? resource("board/paper-samples.csv") : options.samples;
}

std::unique_ptr<ReportSource> openSimulatedBoard(const SimulatedBoardOptions& options,
                                                 std::shared_ptr<SimulationControl> control) {
  VirtualBoard board = simulatedBoard(options.solved ? *options.solved : loadSamples(simulatedSamples(options)),
                                      options.disturbance, options.rate_Hz, options.seed, options.hand);
  refuseOutside("row-wire", options.faults.openRows, board.info().rowWires);
  refuseOutside("column-wire", options.faults.openColumns, board.info().columnWires);
  board.faults() = options.faults;
  return std::make_unique<SimulatedSource>(std::move(board), std::move(control));
}

std::filesystem::path shippedNetwork() {
  return resource("board/paper-network.json");
}

} // namespace palp
