// Fuzzing: any bytes as a NPZ file of samples or a table of arrays. It is refused with one sentence, or read
// to finite numbers.

#include "io/SampleFile.h"
#include "io/measured/MeasuredTable.h"
#include "model/base/Error.h"
#include "tests/fuzz/FuzzedFile.h"

#include <algorithm>
#include <cmath>

namespace {

void readSamples(const std::string& path) {
  try {
    const palp::SampleSet set = palp::loadSamples(path, {}, true);
    if (!set.forces_N.allFinite() || !set.resistances_ohm.allFinite()) std::abort();
  } catch (const palp::Error&) { // a refusal is an answer
  }
}

void readTable(const std::string& path) {
  try {
    const auto table = palp::openTable(path, {});
    std::vector<palp::ChosenColumn> all(table->columns().size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i].column = i;
    std::vector<double> values(all.size());
    std::vector<std::string> problems;
    table->choose(all);
    for (int row = 0; row < 1000 && table->next(values, problems); ++row)
      if (problems.empty() && !std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }))
        std::abort();
  } catch (const palp::Error&) { // a refusal is an answer
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2 || data[0] != 'P' || data[1] != 'K') return 0; // others have fuzzers of their own
  static const FuzzedFile file;
  file.hold({data, size});
  readSamples(file.path());
  readTable(file.path());
  return 0;
}
