#pragma once

#include "model/SampleSet.h"

#include <filesystem>
#include <string>
#include <vector>

namespace palp {

/// Samples are CSV: comment lines `# key: value` with the origin and the counts, one line with the columns' names, one
/// line a sample; numbers read back as the same numbers. Columns of displacements or resistances that have no rows are
/// left out.

/// The comment lines and the line of names.
std::string sampleFileHead(const SampleSet& set);

/// Throws Error where the file exists and `force` is not given.
void saveSamples(const std::filesystem::path& path, const SampleSet& set, bool force);

/// Reads strictly: a wrong count of numbers, something that is no finite number or a line that is cut off throws Error
/// with the line's number.
SampleSet loadSamples(const std::filesystem::path& path);

/// Joins shards, in any order, to the bytes that one run would have written. Throws Error where they do not belong
/// together, overlap or leave a gap. Returns the number of samples.
std::size_t mergeSampleFiles(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& path,
                             bool force);

/// Long work on one sample file: appends to NAME.part, and renames it when all is there. The same work begun again
/// finds what was written; a line that was cut off is dropped.
class SamplePartWriter {
public:
  /// `head` is the set without samples. Throws Error where NAME exists and `force` is not given, where NAME.part is of
  /// other work (the text says what differs), or where another process writes it.
  SamplePartWriter(std::filesystem::path path, const SampleSet& head, bool force);
  ~SamplePartWriter();
  SamplePartWriter(const SamplePartWriter&) = delete;
  SamplePartWriter& operator=(const SamplePartWriter&) = delete;

  /// Samples that were in NAME.part already.
  [[nodiscard]] std::size_t samplesKept() const { return samplesKept_; }
  [[nodiscard]] const std::filesystem::path& partPath() const { return part_; }
  /// Appends and hands over to the system. Throws Error.
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
