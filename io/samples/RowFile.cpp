#include "io/samples/RowFile.h"

#include "io/SampleHead.h"
#include "io/files/SystemError.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace palp {

void writeAllBytes(int file, const std::filesystem::path& name, const char* bytes, std::size_t count) {
  for (std::size_t done = 0; done < count;) {
    const ssize_t written = ::write(file, bytes + done, count - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) cannotWrite(name);
    done += static_cast<std::size_t>(written);
  }
}

RowFile::RowFile(int file, std::filesystem::path name, off_t begin, SampleSet head)
    : file_(file), name_(std::move(name)), begin_(begin), head_(std::move(head)),
      rowBytes_(sampleFields(head_) * sizeof(double)) {
  const off_t end = ::lseek(file_, 0, SEEK_END);
  if (end > begin_) count_ = (end - begin_) / static_cast<off_t>(rowBytes_);
  const off_t whole = begin_ + count_ * static_cast<off_t>(rowBytes_);
  if (end < 0 || (end > whole && ::ftruncate(file_, whole) != 0) || ::lseek(file_, whole, SEEK_SET) < 0)
    cannotWrite(name_);
}

void RowFile::append(const SampleSet& block) {
  const Eigen::Index atOnce = samplesAtOnce(head_);
  Eigen::MatrixXd rows;
  for (Eigen::Index first = 0; first < block.size(); first += atOnce) {
    const Eigen::Index part = std::min(atOnce, block.size() - first);
    rows.resize(static_cast<Eigen::Index>(rowBytes_ / sizeof(double)), part);
    rows.row(0) = block.area.segment(first, part).transpose().cast<double>();
    Eigen::Index row = 1;
    for (const SampleArray& array : sampleArrays(head_)) {
      const Eigen::MatrixXd& values = block.*array.values;
      rows.middleRows(row, values.rows()) = values.middleCols(first, part);
      row += values.rows();
    }
    writeAllBytes(file_, name_, reinterpret_cast<const char*>(rows.data()),
                  static_cast<std::size_t>(rows.size()) * sizeof(double));
    count_ += part;
  }
}

SampleSet RowFile::block(Eigen::Index first, Eigen::Index count) const {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(rowBytes_ / sizeof(double)), count);
  auto* const bytes = reinterpret_cast<char*>(rows.data());
  const std::size_t wanted = rowBytes_ * static_cast<std::size_t>(count);
  const off_t from = begin_ + first * static_cast<off_t>(rowBytes_);
  for (std::size_t done = 0; done < wanted;) {
    const ssize_t got = ::pread(file_, bytes + done, wanted - done, from + static_cast<off_t>(done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) cannotRead(name_, got == 0 ? "it ends too early" : systemMessage());
    done += static_cast<std::size_t>(got);
  }
  SampleSet set = head_;
  resizeSamples(set, count);
  set.area = rows.row(0).transpose().cast<int>();
  Eigen::Index row = 1;
  for (const SampleArray& array : sampleArrays(set)) {
    Eigen::MatrixXd& values = set.*array.values;
    values = rows.middleRows(row, values.rows());
    row += values.rows();
  }
  return set;
}

SampleRows RowFile::rows() const {
  return {head_, count_, [this](Eigen::Index first, Eigen::Index part) { return block(first, part); }};
}

} // namespace palp
