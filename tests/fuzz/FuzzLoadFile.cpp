// Fuzzing: any text as a path of loads. It is refused with one sentence, or read to finite loads.

#include "io/LoadFile.h"
#include "model/base/Error.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    for (const palp::LoadCase& load :
         palp::parseLoadPath(std::string(reinterpret_cast<const char*>(data), size), "fuzz"))
      for (const palp::Indenter& indenter : load.indenters)
        if (!std::isfinite(indenter.radius_mm) || !std::isfinite(indenter.friction)) std::abort();
  } catch (const palp::Error&) { // a refusal is an answer
  }
  return 0;
}
