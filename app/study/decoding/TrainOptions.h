#pragma once

#include "io/DecoderKind.h"
#include "model/SampleSet.h"
#include "nn/RbfTrainer.h"
#include "nn/measured/InputStage.h"
#include "nn/measured/RowDependence.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace palp {

/// The clock of a decoder's memory.
enum class MemoryClock { Time, Rows };
inline constexpr NamedEnum kMemoryClocks("clock", std::array{std::pair{MemoryClock::Time, "time"},
                                                             std::pair{MemoryClock::Rows, "rows"}});

/// All options of `palp train`; those that are not set follow from the mode. TrainOptionTable.h has their names, limits
/// and words.
struct TrainOptions {
  InputKind input = InputKind::Displacement;
  std::string rows = "4"; ///< row-wires that are read: "4", "1,4,7", "all"
  DecoderMode mode = DecoderMode::Default;
  DecoderKind decoder = DecoderKind::Rbf;
  DecoderTarget target = DecoderTarget::Force;
  std::optional<double> spread; ///< none: auto
  std::optional<int> centers;   ///< none: default of the mode
  bool allCenters = false;      ///< one a sample, however many
  std::optional<CenterChoice> centerChoice;
  std::optional<LeastSquaresMethod> solver;
  std::optional<double> ridge;
  std::optional<Scaling> scaling;
  std::optional<Tail> tail;
  std::optional<SpreadConvention> convention;
  double noise = 0; ///< relative standard deviation of the inputs
  double forgetting = 1;
  // Of measured rows (palp import): what is not set is chosen by the validation.
  std::optional<RowOrder> order;
  std::optional<ReadingTransform> transform;
  std::string memory;               ///< empty: auto; "none", or time constants [s]: "0.1,0.4"
  std::optional<MemoryClock> clock; ///< Rows: they are equally spaced in time
  std::uint64_t seed = 1;
  int threads = 0; ///< 0: all cores; the result is the same

  bool operator==(const TrainOptions&) const = default;
};

/// The one place where a mode becomes options (resources/docs/physics.md, the two modes): for `samples` samples.
RbfOptions rbfOptions(const TrainOptions& options, Eigen::Index samples);

/// The options as on the command line, those alone that were set: " --input resistance --rows all".
std::string asCommand(const TrainOptions& options);

/// Time constants of the option `memory`; none: to be chosen. Throws Error where they are not times above 0.
std::optional<std::vector<double>> memoryTimes_s(const std::string& memory);

/// Whether a set of samples is trained as measured rows: imported, by a network whose system no option prescribes.
bool trainsAsMeasured(const SampleSet& samples, const TrainOptions& options);

/// Input and row-wires that were not given are what the set has: resistances and all row-wires of a set without
/// displacements.
void takeDefaultsOf(const SampleSet& samples, bool inputIsGiven, bool rowsAreGiven, TrainOptions& options);

/// Row-wires of "4", "1,4,7" or "all", ascending, without repeats. Throws Error where one is not among 0..rowWires-1.
std::vector<int> rowsNamed(const std::string& rows, int rowWires);

} // namespace palp
