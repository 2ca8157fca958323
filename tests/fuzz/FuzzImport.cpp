// Fuzzing: any bytes as an import map, a zero byte, and the table that it is for. Either is refused with one sentence,
// or the samples that come of them can be read.

#include "io/ImportSamples.h"
#include "io/SampleFile.h"
#include "model/base/Error.h"
#include "tests/fuzz/FuzzedFile.h"

#include <algorithm>
#include <filesystem>

namespace {

/// Where the samples are written; removed with the process.
class Output {
public:
  Output() : folder_(std::filesystem::temp_directory_path() / ("palp-fuzz-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Output() { std::filesystem::remove_all(folder_); }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  [[nodiscard]] std::filesystem::path file() const { return folder_ / "samples.csv"; }
  [[nodiscard]] bool isEmpty() const { return std::filesystem::is_empty(folder_); }

private:
  std::filesystem::path folder_;
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::uint8_t* const between = std::find(data, data + size, 0);
  if (between == data + size) return 0;
  static const FuzzedFile map, table;
  static const Output output;
  map.hold({data, between});
  table.hold({between + 1, data + size});
  bool written = false;
  try {
    palp::importSamples({{table.path()}, map.path(), nullptr, output.file(), true}, {}, {});
    written = true;
  } catch (const palp::Error&) { // a refusal is an answer, which leaves nothing
    if (!output.isEmpty()) std::abort();
  }
  if (!written) return 0;
  palp::loadSamples(output.file(), {}, true);
  std::filesystem::remove(output.file());
  return 0;
}
