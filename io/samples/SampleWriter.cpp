#include "io/samples/SampleWriter.h"

#include "io/SampleFile.h"
#include "io/SampleHead.h"
#include "io/samples/FillBeside.h"
#include "io/samples/SampleReader.h"
#include "model/base/Error.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace palp {

namespace {

constexpr Eigen::Index kTextLinesAtOnce = 256; ///< about 4 MB of text for the paper's design

[[noreturn]] void refuseWriting(const std::filesystem::path& path) {
  throw Error(path.string() + ": cannot be written: " + std::strerror(errno)); // NOLINT(concurrency-mt-unsafe)
}

int namelessFile(const std::filesystem::path& path, const std::filesystem::path& beside) {
  std::string name = beside.string() + ".XXXXXX";
  const int file = ::mkstemp(name.data());
  if (file < 0) refuseWriting(path);
  ::unlink(name.c_str());
  return file;
}

} // namespace

SampleWriter::SampleWriter(std::filesystem::path path, const SampleSet& head, bool force)
    : path_(std::move(path)), target_(path_, force) {
  if (formatToWrite(path_) == SampleFormat::Csv) {
    lines_.open(target_.beside(), std::ios::binary);
    lines_ << sampleFileHead(head);
    if (!lines_) refuseWriting(path_);
    return;
  }
  between_ = namelessFile(path_, target_.beside());
  rows_ = std::make_unique<RowFile>(between_, path_, 0, samplesBetween(head, 0, 0));
}

SampleWriter::~SampleWriter() {
  if (between_ >= 0) ::close(between_);
}

void SampleWriter::append(const SampleSet& block) {
  if (rows_) {
    rows_->append(block);
    return;
  }
  std::string lines;
  for (Eigen::Index first = 0; first < block.size(); first += kTextLinesAtOnce) {
    lines.clear();
    appendSampleLines(lines, block, first, std::min(kTextLinesAtOnce, block.size() - first));
    lines_ << lines;
    if (!lines_) refuseWriting(path_);
  }
}

void SampleWriter::finish(const std::stop_token& stop) {
  if (rows_) {
    fillBeside(target_, path_, [&](const std::filesystem::path& beside) {
      writeSampleArrays(beside, formatToWrite(path_), rows_->rows(), stop);
    });
  } else {
    lines_.close();
    if (!lines_) refuseWriting(path_);
  }
  target_.commit();
}

} // namespace palp
