// Fuzzing: any text as a sample file. It is refused with its line, or read to finite numbers.

#include "io/SampleHead.h"
#include "model/base/Error.h"

#include <cstdlib>
#include <sstream>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream stream(std::string(reinterpret_cast<const char*>(data), size));
  palp::SampleLines lines(stream, "fuzz");
  try {
    palp::SampleSet set = palp::readSampleHead(lines);
    if (palp::sampleFields(set) > 10'000) return 0;
    set.area.resize(1);
    for (const auto part : palp::kSampleParts) (set.*part).resize((set.*part).rows(), 1);
    for (std::string line; lines.next(line);) {
      palp::readSampleLine(lines, line, set, 0);
      if (!set.forces_N.allFinite() || !set.resistances_ohm.allFinite()) std::abort();
    }
  } catch (const palp::Error&) { // a refusal is an answer
  }
  return 0;
}
