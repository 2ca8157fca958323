#pragma once

// Private to io.

#include "io/samples/SampleArrays.h"

#include <sys/types.h>

namespace palp {

/// Samples as rows of 8-byte numbers (area, then the arrays in their order) from `begin` of an open file on: what is
/// appended sample by sample until it becomes a file of arrays. A row that is cut off counts as not there.
class RowFile {
public:
  /// The file stays the caller's, and open. `name` is for refusals. Throws Error.
  RowFile(int file, std::filesystem::path name, off_t begin, SampleSet head);

  /// Throws Error, without a part of a row left where the disk is full.
  void append(const SampleSet& block);
  [[nodiscard]] Eigen::Index count() const { return count_; }
  /// Throws Error.
  [[nodiscard]] SampleSet block(Eigen::Index first, Eigen::Index count) const;
  /// Of this file, which must outlive them.
  [[nodiscard]] SampleRows rows() const;

private:
  int file_;
  std::filesystem::path name_;
  off_t begin_;
  SampleSet head_;
  std::size_t rowBytes_;
  Eigen::Index count_ = 0;
};

/// Writes all bytes at the end of the file. Throws Error with this name.
void writeAllBytes(int file, const std::filesystem::path& name, const char* bytes, std::size_t count);

} // namespace palp
