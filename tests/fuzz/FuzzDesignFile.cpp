// Fuzzing: any text as a design file. It is refused in a sentence, or read, and what was read writes and reads the
// same.

#include "io/DesignFile.h"
#include "model/base/Error.h"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const palp::SensorDesign design =
        palp::parseDesign(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz");
    if (palp::check(design).empty() && !(palp::parseDesign(palp::toJson(design), "fuzz") == design)) std::abort();
  } catch (const palp::Error&) { // a refusal is an answer
  }
  return 0;
}
