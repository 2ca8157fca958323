#include "io/samples/SampleReader.h"

#include "io/SampleHead.h"
#include "io/files/SystemError.h"
#include "io/samples/Hdf5Samples.h"
#include "io/samples/NpzSamples.h"
#include "io/samples/SampleArrays.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <fstream>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kStreamBuffer = 1 << 20;

class CsvSamples : public SampleReader {
public:
  explicit CsvSamples(const fs::path& path) : buffer_(kStreamBuffer, '\0'), lines_(stream_, path.string()) {
    stream_.rdbuf()->pubsetbuf(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    stream_.open(path, std::ios::binary);
    if (!stream_) cannotRead(path);
    head_ = readSampleHead(lines_);
  }

  [[nodiscard]] const SampleSet& head() const override { return head_; }
  [[nodiscard]] std::optional<Eigen::Index> size() const override { return {}; }

  Eigen::Index read(SampleSet& set, Eigen::Index first, Eigen::Index count, const std::stop_token& stop) override {
    Eigen::Index done = 0;
    for (; done < count && lines_.next(line_); ++done) {
      throwIfStopped(stop);
      readSampleLine(lines_, line_, set, first + done);
    }
    return done;
  }

private:
  std::string buffer_;
  std::ifstream stream_;
  SampleLines lines_;
  SampleSet head_;
  std::string line_;
};

} // namespace

SampleFormat formatToWrite(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == ".h5" || ending == ".hdf5") return SampleFormat::Hdf5;
  return ending == ".npz" ? SampleFormat::Npz : SampleFormat::Csv;
}

void writeSampleArrays(const fs::path& path, SampleFormat format, const SampleRows& rows, const std::stop_token& stop) {
  if (format == SampleFormat::Hdf5)
    writeHdf5Samples(path, rows, stop);
  else
    writeNpzSamples(path, rows, stop);
}

std::unique_ptr<SampleReader> openSamples(const fs::path& path, const std::stop_token& stop) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) throw Error(path.string() + ": is a folder; a file is needed");
  if (fs::is_regular_file(path, ignored)) { // a pipe could not be read again
    std::ifstream stream(path, std::ios::binary);
    std::string begin(8, '\0');
    stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
    if (begin.starts_with("\x89HDF\r\n")) return openHdf5Samples(path, stop);
    if (begin.starts_with("PK")) return openNpzSamples(path);
  }
  return std::make_unique<CsvSamples>(path);
}

} // namespace palp
