// Fuzzing: any bytes as a NPZ file of samples or a table of arrays. It is refused with one sentence, or read
// to finite numbers.

#include "io/SampleFile.h"
#include "io/measured/MeasuredTable.h"
#include "model/base/Error.h"
#include "tests/fuzz/FuzzedFile.h"

#include <numeric>

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
    const auto table = palp::openTable(path, ',');
    std::vector<std::size_t> all(table->columns().size());
    std::iota(all.begin(), all.end(), 0);
    std::vector<double> values;
    for (int row = 0; row < 1000 && table->next(all, values); ++row)
      if (values.size() != all.size()) std::abort();
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
