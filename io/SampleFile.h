#pragma once

#include "model/SampleSet.h"

#include <filesystem>
#include <string>
#include <vector>

namespace palp {

/// Samples are CSV: comment lines `# key: value` with the origin and the counts, one line of column names, one line per
/// sample; numbers read back to the same bits. Displacements or resistances that have no rows have no columns
/// (resources/docs/formats.md).

/// The comment lines and the line of column names.
std::string sampleFileHead(const SampleSet& set);

/// Throws Error if the file exists and `force` is not given.
void saveSamples(const std::filesystem::path& path, const SampleSet& set, bool force);

/// Reads strictly: a wrong count of numbers, anything that is not a finite number, or a truncated line throws Error
/// with the line number.
SampleSet loadSamples(const std::filesystem::path& path);

/// Joins shards, in any order, to the bytes that one run would have written. Throws Error if they do not belong
/// together, overlap or leave a gap. Returns the number of samples.
std::size_t mergeSampleFiles(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& path,
                             bool force);

/// Long work on one sample file: appends to NAME.part and renames it when complete. The same work started again
/// continues from it; a truncated last line is dropped.
class SamplePartWriter {
public:
  /// `head` is the set without samples. Throws Error if NAME exists and `force` is not given, if NAME.part belongs to
  /// other work (the text says what differs), or if another process is writing it.
  SamplePartWriter(std::filesystem::path path, const SampleSet& head, bool force);
  ~SamplePartWriter();
  SamplePartWriter(const SamplePartWriter&) = delete;
  SamplePartWriter& operator=(const SamplePartWriter&) = delete;

  /// Number of samples that NAME.part already held.
  [[nodiscard]] std::size_t samplesKept() const { return samplesKept_; }
  [[nodiscard]] const std::filesystem::path& partPath() const { return part_; }
  /// Appends and flushes to the system. Throws Error.
  void append(const SampleSet& block);
  /// Renames NAME.part to NAME. Throws Error.
  void finish();

private:
  void resume(const SampleSet& head);
  void write(const std::string& lines);

  std::filesystem::path path_;
  std::filesystem::path part_;
  bool force_;
  int file_ = -1;
  std::size_t samplesKept_ = 0;
};

} // namespace palp
