// Fuzzing: any bytes as a recording. It is refused in a sentence, or read to its last whole entry.

#include "io/board/RecordingReader.h"
#include "model/base/Error.h"

#include <memory>
#include <sstream>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    palp::RecordingReader reader(
        std::make_unique<std::istringstream>(std::string(reinterpret_cast<const char*>(data), size)), "fuzz");
    while (reader.next()) {
    }
  } catch (const palp::Error&) { // a refusal is an answer
  }
  return 0;
}
