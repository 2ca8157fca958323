// Fuzzing: any bytes as an HDF5 file of samples. Whatever the HDF5 library makes of them in the process that reads them
// (crash, no end), here they are refused with one sentence, or read to finite numbers.

#include "io/SampleFile.h"
#include "model/base/Error.h"
#include "tests/fuzz/FuzzedFile.h"

#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::string_view kMagic = "\x89HDF\r\n\x1a\n";
  if (std::string_view(reinterpret_cast<const char*>(data), size).substr(0, kMagic.size()) != kMagic) return 0;
  static const FuzzedFile file;
  file.hold({data, size});
  try {
    const palp::SampleSet set = palp::loadSamples(file.path(), {}, true);
    if (!set.forces_N.allFinite() || !set.resistances_ohm.allFinite()) std::abort();
  } catch (const palp::Error&) { // a refusal is an answer
  }
  return 0;
}
