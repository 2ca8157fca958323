#pragma once

#include "model/SampleSet.h"

#include <filesystem>
#include <memory>
#include <stop_token>
#include <string>

namespace palp {

class RowFile;

/// Long work on one sample file: appends to NAME.part (where NAME is a link, next to the file it leads to), which
/// becomes NAME when complete. The same work started again continues from it; a truncated last sample is dropped. For
/// CSV the part is the file's beginning; for files of arrays the same head and rows of numbers, which are written as
/// arrays at the end.
class SamplePartWriter {
public:
  /// `head` is the set without samples. Throws Error if NAME exists and `force` is not given, if NAME.part belongs to
  /// other work or another program (the text names the difference), or if another process is writing it.
  SamplePartWriter(std::filesystem::path path, const SampleSet& head, bool force);
  ~SamplePartWriter();
  SamplePartWriter(const SamplePartWriter&) = delete;
  SamplePartWriter& operator=(const SamplePartWriter&) = delete;

  /// Number of samples that NAME.part already held.
  [[nodiscard]] std::size_t samplesKept() const { return samplesKept_; }
  [[nodiscard]] const std::filesystem::path& partPath() const { return part_; }
  /// Appends and flushes to the system. Throws Error.
  void append(const SampleSet& block);
  /// Makes NAME of NAME.part. Throws Error; or Cancelled after a request to stop, and then NAME.part stays complete.
  void finish(const std::stop_token& stop = {});

private:
  void resume(const SampleSet& head);
  void keepWholeLines(std::istream& stream, const SampleSet& head, std::size_t headBytes);

  std::filesystem::path path_;
  std::filesystem::path part_;
  bool force_;
  int file_ = -1;
  std::unique_ptr<RowFile> rows_; ///< none for CSV
  std::size_t samplesKept_ = 0;
};

} // namespace palp
