#include "app/cli/commands/ListenSimulation.h"

#include "app/cli/Options.h"
#include "app/study/live/LiveSource.h"
#include "app/study/live/SimulatedTouch.h"
#include "io/DesignFile.h"
#include "io/SampleFile.h"
#include "model/base/Text.h"

#include <algorithm>

namespace palp {

namespace {

/// A hand that holds the touch of --hold on the sensor of the samples, which the polynomials of the board hold for. Its
/// rubber may be another than the design's, as that of a real sensor is; its wires and areas are the design's.
std::shared_ptr<TouchHand> holdingHand(const std::string& held, const std::string& designName,
                                       const SampleSet& samples) {
  const SensorDesign design = designName.empty() ? paperDesign() : designOption(designName);
  const auto shape = [](int areas, int rows, int columns) {
    return std::to_string(areas) + " areas, " + std::to_string(rows) + " row-wires and " + std::to_string(columns) +
           " column-wires";
  };
  const std::string board = shape(samples.areaCount, samples.rowWires, samples.columnWires);
  const std::string given = shape(design.areas.count(), design.rowWires(), design.columnWires());
  if (board != given)
    throw UsageError("--hold needs the design of the simulated board: the samples have " + board + ", --design has " +
                     given);
  const AreaLoad load = areaLoadOption("--hold", held, design);
  const Eigen::Array3d low_N = samples.forces_N.rowwise().minCoeff(), high_N = samples.forces_N.rowwise().maxCoeff();
  for (Eigen::Index k = 0; k < 3; ++k)
    if (load.force_N(k) < std::min(low_N(k), 0.0) || load.force_N(k) > std::max(high_N(k), 0.0))
      throw UsageError("--hold " + held + ": F" + std::string(1, "xyz"[k]) +
                       " is outside of the samples that drive the board, " + text(low_N(k)) + " to " + text(high_N(k)) +
                       " N");
  auto hand = std::make_shared<TouchHand>();
  hand->hold(SimulatedTouch::Truth{load.area, load.force_N});
  return hand;
}

} // namespace

void SimulationArguments::declare(Command command) {
  command.group("Simulated board");
  const Option simulate =
      command.flag("--simulate", on, "read the simulated board, under a touch that moves over the areas");
  command.option("--samples", samples, "FILE", "solved samples that drive the simulated board (default: the paper's)")
      .needs(simulate);
  command.option("--hold", hold, "AREA:FX,FY,FZ", "constant force [N] on an area (needs the --design of the samples)")
      .needs(simulate);
  command.option("--noise", noise, "NUMBER", "noise of the readings, relative to R (default 5e-6)").needs(simulate);
  command.option("--warming", warming, "NUMBER", "warming of the board [degC] (default 0)").needs(simulate);
  command.option("--hysteresis", hysteresis, "NUMBER", "share of the signal with backlash, 0 to 1 (default 0)")
      .needs(simulate);
  command.option("--rate", rate, "NUMBER", "reports per second (default 1000)").needs(simulate);
  command.option("--seed", seed, "N", "seed of the noise (default 1)").needs(simulate);
  command.option("--open-row", openRow, "N", "number of a broken row-wire").needs(simulate);
  command.option("--open-column", openColumn, "N", "number of a broken column-wire").needs(simulate);
  command.option("--drop-every", dropEvery, "N", "drop every N-th report (default 0: none)").needs(simulate);
}

double numberUpTo(const std::string& option, const std::string& value, double most) {
  const double result = number(option, value);
  if (!(result >= 0 && result <= most)) throw badValue(option, value, "0 to " + std::to_string(static_cast<int>(most)));
  return result;
}

SimulatedSensor openSimulated(const SimulationArguments& arguments, const std::string& design) {
  SimulatedBoardOptions options;
  options.samples = arguments.samples;
  options.disturbance.noise = numberUpTo("--noise", arguments.noise, 1);
  options.disturbance.warming_degC = numberUpTo("--warming", arguments.warming, 100);
  options.disturbance.hysteresisShare = numberUpTo("--hysteresis", arguments.hysteresis, 1);
  if (!arguments.openRow.empty()) options.faults.openRows = {wholeNumber("--open-row", arguments.openRow, 0, 31)};
  if (!arguments.openColumn.empty())
    options.faults.openColumns = {wholeNumber("--open-column", arguments.openColumn, 0, 254)};
  options.faults.dropEvery = wholeNumber("--drop-every", arguments.dropEvery, 0, 1'000'000);
  options.rate_Hz = wholeNumber("--rate", arguments.rate, 1, 8000);
  options.seed = static_cast<std::uint64_t>(wholeNumber("--seed", arguments.seed, 0, 2'147'483'647));
  options.solved = std::make_shared<SampleSet>(loadSamples(simulatedSamples(options)));
  if (!arguments.hold.empty()) options.hand = holdingHand(arguments.hold, design, *options.solved);
  return {openSimulatedBoard(options), options.solved->origin.designFingerprint};
}

} // namespace palp
