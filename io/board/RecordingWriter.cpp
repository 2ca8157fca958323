#include "io/board/RecordingWriter.h"

#include "io/AtomicFile.h"
#include "io/board/ByteOrder.h"
#include "io/board/recording/RecordingEntries.h"
#include "io/board/recording/RecordingHead.h"
#include "io/files/SystemError.h"
#include "model/base/Error.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

namespace palp {

namespace {

constexpr std::size_t kLongestEntry = 65535;   // a tare of the largest board of the protocol takes 65,296
constexpr std::size_t kMostPending = 64 << 20; // a minute and more at 8000 reports/s
constexpr auto kFlushInterval = std::chrono::milliseconds(500);

} // namespace

std::size_t RecordingWriter::writtenOf(int file, std::string_view bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t written = ::write(file, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) break;
    done += static_cast<std::size_t>(written);
  }
  return done;
}

RecordingWriter::RecordingWriter(const std::filesystem::path& path, const RecordingHead& head, bool force,
                                 WriteBytes writeBytes)
    : path_(path), writeBytes_(std::move(writeBytes)) {
  AtomicFile target(path, force);
  const std::string text = recordingHeadText(head);
  std::array<std::uint8_t, 4> length{};
  putLittleEndian<4>(length, 0, static_cast<std::uint32_t>(text.size()));
  const std::string bytes = std::string(kRecordingMagic) + std::string(length.begin(), length.end()) + text;
  file_ = ::open(target.temporary().c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
  if (file_ < 0) cannotWrite(path);
  try {
    if (writeBytes_(file_, bytes) < bytes.size()) cannotWrite(path);
    target.commit(); // what follows goes into the same file, by its new name
  } catch (...) {    // the destructor does not run for what was never constructed
    ::close(file_);
    throw;
  }
  thread_ = std::thread([this] { run(); });
}

void RecordingWriter::finish() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  wake_.notify_one();
  if (!thread_.joinable()) return;
  thread_.join();
  ::close(file_);
}

void RecordingWriter::append(RecordingEntry::Kind kind, double hostTime_s, std::span<const std::uint8_t> bytes) {
  const auto count = static_cast<std::uint32_t>(std::min(bytes.size(), kLongestEntry));
  std::array<std::uint8_t, kEntryHead> head{static_cast<std::uint8_t>(kind), 0};
  putLittleEndian<2>(head, 2, count);
  std::memcpy(head.data() + 4, &hostTime_s, sizeof hostTime_s);
  const std::lock_guard lock(mutex_);
  if (!failure_.empty() || pending_.size() > kMostPending) {
    ++dropped_;
    return;
  }
  pending_.append(reinterpret_cast<const char*>(head.data()), head.size());
  pending_.append(reinterpret_cast<const char*>(bytes.data()), count);
  ++pendingEntries_;
}

std::string RecordingWriter::write(const std::string& block, std::uint64_t& entries, std::uint64_t& reports) {
  const std::size_t written = writeBytes_(file_, block);
  const int reason = errno;
  std::size_t whole = 0;
  for (entries = reports = 0; whole < block.size(); ++entries) {
    const std::span bytes(reinterpret_cast<const std::uint8_t*>(block.data()), block.size());
    const std::size_t next = whole + kEntryHead + littleEndian<2>(bytes, whole + 2);
    if (next > written) break;
    if (bytes[whole] == static_cast<std::uint8_t>(RecordingEntry::Kind::Raw)) ++reports;
    whole = next;
  }
  if (written == block.size()) return {};
  const off_t end = ::lseek(file_, 0, SEEK_CUR); // none in a pipe
  if (end >= 0) {
    [[maybe_unused]] const int cut = ::ftruncate(file_, end - static_cast<off_t>(written - whole));
  }
  return inWords(systemMessage(reason));
}

void RecordingWriter::run() {
  std::string block;
  bool more = true;
  while (more) {
    try {
      more = writeWaiting(block);
    } catch (const std::exception& failure) { // the last catch of this thread
      fail(failure.what());
    } catch (...) {
      fail("an error without a text");
    }
  }
}

bool RecordingWriter::writeWaiting(std::string& block) {
  bool ending = false;
  {
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, kFlushInterval, [this] { return ending_; });
    ending = ending_;
    block.swap(pending_);
    pending_.clear();
    writing_ = std::exchange(pendingEntries_, 0);
    if (!failure_.empty()) { // appended while the last block failed
      dropped_ += std::exchange(writing_, 0);
      return !ending;
    }
  }
  std::uint64_t entries = 0, reports = 0;
  const std::string failure = write(block, entries, reports);
  const std::lock_guard lock(mutex_);
  reports_ += reports;
  dropped_ += std::exchange(writing_, 0) - entries;
  failure_ = failure;
  return !ending;
}

void RecordingWriter::fail(const std::string& why) {
  const std::lock_guard lock(mutex_);
  dropped_ += std::exchange(writing_, 0);
  failure_ = inWords(why);
}

std::string RecordingWriter::inWords(const std::string& why) const {
  return path_.string() + ": can no longer be written: " + why;
}

std::uint64_t RecordingWriter::reports() const {
  const std::lock_guard lock(mutex_);
  return reports_;
}

std::uint64_t RecordingWriter::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

std::string RecordingWriter::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

} // namespace palp
