#include "app/study/decoding/TrainOptions.h"

#include "app/study/decoding/TrainOptionTable.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "model/base/NumberText.h"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <optional>
#include <set>
#include <string_view>

namespace palp {
namespace {

void chooseCenters(RbfOptions& result, const TrainOptions& options, Eigen::Index samples) {
  const bool paper = options.mode == DecoderMode::Paper;
  const int wanted = options.centers.value_or(paper || samples <= kMostCenters ? 0 : kMostCenters);
  if (options.allCenters || (wanted == 0 && !options.centerChoice)) return;
  result.centers = options.centerChoice.value_or(paper ? CenterChoice::KMeans : CenterChoice::Random);
  result.centerCount = wanted;
}

std::optional<int> rowNamed(std::string_view text, int rowWires) {
  int row = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), row);
  if (error != std::errc{} || end != text.data() + text.size() || row < 0 || row >= rowWires) return {};
  return row;
}

/// "4", or "2-5".
void addRows(std::string_view text, const std::string& rows, int rowWires, std::set<int>& chosen) {
  const std::size_t dash = text.find('-');
  const std::optional<int> first = rowNamed(text.substr(0, dash), rowWires);
  const std::optional<int> last = dash == std::string_view::npos ? first : rowNamed(text.substr(dash + 1), rowWires);
  if (!first || !last || *first > *last)
    throw Error("row-wires: " +
                gotExpected(quotedText(std::string(text)) + (text == rows ? "" : " in " + quotedText(rows)),
                            rowWires == 1 ? "0 or all, because there is one row-wire"
                                          : "all, or numbers and ranges from 0 to " + std::to_string(rowWires - 1) +
                                                ", for example 0,2,4-6"));
  for (int row = *first; row <= *last; ++row) chosen.insert(row);
}

} // namespace

RbfOptions rbfOptions(const TrainOptions& options, Eigen::Index samples) {
  const bool paper = options.mode == DecoderMode::Paper;
  const bool noisy = options.noise > 0;
  RbfOptions result;
  const bool minMax = paper && options.input == InputKind::Displacement;
  result.scaling = options.scaling.value_or(minMax            ? Scaling::MinMax
                                            : noisy && !paper ? Scaling::Whiten
                                                              : Scaling::Global);
  chooseCenters(result, options, samples);
  result.spread = options.spread;
  result.convention = options.convention.value_or(SpreadConvention::Radbas);
  result.tail = options.tail.value_or(paper ? Tail::Bias : noisy ? Tail::LinearPenalised : Tail::Linear);
  result.method =
      options.solver.value_or(!paper && noisy ? LeastSquaresMethod::Cholesky : LeastSquaresMethod::PivotedQr);
  result.ridge = options.ridge;
  if (!options.ridge && !noisy) result.ridge = 0.0;
  result.forgetting = options.forgetting;
  result.relativeInputNoise = options.noise;
  result.seed = options.seed;
  result.threads = options.threads;
  return result;
}

std::string asCommand(const TrainOptions& options) {
  std::string text;
  for (const TrainOption& option : trainOptionTable())
    if (option.alwaysInCommands || option.isSet(options)) text += " --" + option.name + " " + option.text(options);
  return text;
}

std::optional<std::vector<double>> memoryTimes_s(const std::string& memory) {
  if (memory.empty()) return {};
  std::vector<double> times_s;
  if (memory == "none") return times_s;
  for (std::size_t begin = 0; begin <= memory.size();) {
    const std::size_t comma = std::min(memory.find(',', begin), memory.size());
    const auto time_s = numberIn(memory.substr(begin, comma - begin));
    if (!time_s || !(*time_s > 0))
      throw Error("memory: " +
                  gotExpected(quotedText(memory), "none, or time constants above 0 in s, for example 0.1,0.4"));
    times_s.push_back(*time_s);
    begin = comma + 1;
  }
  std::sort(times_s.begin(), times_s.end());
  return times_s;
}

bool trainsAsMeasured(const SampleSet& samples, const TrainOptions& options) {
  return samples.origin.imported() && !samples.together() && options.decoder == DecoderKind::Rbf &&
         options.mode == DecoderMode::Default && options.noise == 0 && !options.scaling && !options.solver &&
         !options.tail && !options.convention && !options.centerChoice && !options.allCenters &&
         options.forgetting == 1;
}

void takeDefaultsOf(const SampleSet& samples, bool inputIsGiven, bool rowsAreGiven, TrainOptions& options) {
  if (samples.displacements_mm.rows() > 0) return;
  if (!inputIsGiven) options.input = InputKind::Resistance;
  if (!rowsAreGiven) options.rows = "all";
}

std::vector<int> rowsNamed(const std::string& rows, int rowWires) {
  if (rows == "all") {
    std::vector<int> all(static_cast<std::size_t>(rowWires));
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  std::set<int> chosen;
  for (std::size_t begin = 0;;) {
    const std::size_t comma = std::min(rows.find(',', begin), rows.size());
    addRows(std::string_view(rows).substr(begin, comma - begin), rows, rowWires, chosen);
    if (comma == rows.size()) break;
    begin = comma + 1;
  }
  return {chosen.begin(), chosen.end()};
}

} // namespace palp
