// Fuzzing: any text as a study. It is refused with one sentence, or read; what was read writes and reads the same, and
// its first and last design are built or refused.

#include "io/StudyFile.h"
#include "model/base/Error.h"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const palp::StudyPlan plan = palp::parseStudy(std::string(reinterpret_cast<const char*>(data), size), "fuzz");
    const std::string text = palp::toJson(plan);
    std::string again;
    try {
      again = palp::toJson(palp::parseStudy(text, "fuzz"));
    } catch (const palp::Error&) { // what was written must not be refused
      std::abort();
    }
    if (again != text) std::abort();
    static_cast<void>(plan.at(0));
    static_cast<void>(plan.at(plan.designs() - 1));
  } catch (const palp::Error&) { // a refusal is an answer
  }
  return 0;
}
