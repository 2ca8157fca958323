#pragma once

// Private to io.

#include "io/AtomicFile.h"
#include "io/samples/RowFile.h"

#include <fstream>
#include <memory>

namespace palp {

/// A sample file of any format that is written block by block, completely or not at all; until then it has no name.
class SampleWriter {
public:
  /// By the ending of the name. Throws Error if the file exists and `force` is not given.
  SampleWriter(std::filesystem::path path, const SampleSet& head, bool force);
  ~SampleWriter();
  SampleWriter(const SampleWriter&) = delete;
  SampleWriter& operator=(const SampleWriter&) = delete;

  /// Throws Error.
  void append(const SampleSet& block);
  /// Throws Error, or Cancelled.
  void finish(const std::stop_token& stop);

private:
  std::filesystem::path path_;
  AtomicFile target_;
  std::ofstream lines_;           ///< CSV
  int between_ = -1;              ///< a file without a name, of the rows
  std::unique_ptr<RowFile> rows_; ///< of arrays
};

} // namespace palp
