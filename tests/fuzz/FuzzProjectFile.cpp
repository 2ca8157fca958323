// Fuzzing: any text as a project file of the window. It is refused in a sentence, or read, and what was read writes
// and reads the same.

#include "app/gui/project/ProjectFile.h"
#include "model/base/Error.h"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const QByteArray text(reinterpret_cast<const char*>(data), static_cast<qsizetype>(size));
    const palp::Project project = palp::parseProject(text, "fuzz", palp::exampleProject());
    if (!(palp::parseProject(palp::projectText(project), "fuzz", {}) == project)) std::abort();
  } catch (const palp::Error&) { // a refusal is an answer
  }
  return 0;
}
