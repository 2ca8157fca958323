#include "io/samples/SampleWriter.h"

#include "io/SampleFile.h"
#include "io/SampleHead.h"
#include "io/files/SystemError.h"
#include "io/samples/SampleReader.h"

#include <unistd.h>

#include <cstdlib>
#include <utility>

namespace palp {

namespace {

int namelessFile(const std::filesystem::path& path, const std::filesystem::path& temporary) {
  std::string name = temporary.string() + ".XXXXXX";
  const int file = ::mkstemp(name.data());
  if (file < 0) cannotWrite(path);
  ::unlink(name.c_str());
  return file;
}

} // namespace

SampleWriter::SampleWriter(std::filesystem::path path, const SampleSet& head, bool force)
    : path_(std::move(path)), target_(path_, force) {
  if (formatToWrite(path_) == SampleFormat::Csv) {
    lines_.open(target_.temporary(), std::ios::binary);
    lines_ << sampleFileHead(head);
    if (!lines_) cannotWrite(path_);
    return;
  }
  between_ = namelessFile(path_, target_.temporary());
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
  writeSampleLines(block, [&](const std::string& lines) {
    lines_ << lines;
    if (!lines_) cannotWrite(path_);
  });
}

void SampleWriter::finish(const std::stop_token& stop) {
  if (rows_) {
    target_.fill([&](const std::filesystem::path& temporary) {
      writeSampleArrays(temporary, formatToWrite(path_), rows_->rows(), stop);
    });
  } else {
    lines_.close();
    if (!lines_) cannotWrite(path_);
  }
  target_.commit();
}

} // namespace palp
