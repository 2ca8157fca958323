#include "io/board/RecordingReader.h"

#include "io/board/ByteOrder.h"
#include "io/board/recording/RecordingEntries.h"
#include "io/board/recording/RecordingHead.h"
#include "io/files/SystemError.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

namespace palp {

namespace {

using Kind = RecordingEntry::Kind;

constexpr double kLongestStep_s = 60;       // from a report to one behind which there is no other
constexpr std::size_t kSeenAhead = 1 << 17; // holds the longest entry and the next one
constexpr std::size_t kBuffer = 2 * kSeenAhead;

/// A time that lies before or behind both of its neighbours is spoilt: reports are recorded in their order. A gap in
/// the recording lies between two reports that others follow.
double betweenNeighbours(double before_s, double time_s, const std::optional<double>& after_s) {
  const double latest_s = after_s.value_or(before_s + kLongestStep_s);
  const bool outside = before_s <= latest_s && (time_s < before_s || time_s > latest_s);
  return outside ? before_s : time_s;
}

} // namespace

RecordingReader::RecordingReader(const std::filesystem::path& path)
    : stream_(std::make_unique<std::ifstream>(path, std::ios::binary)), name_(path.string()) {
  std::error_code ignored;
  if (!*stream_ || std::filesystem::is_directory(path, ignored))
    cannotRead(path, systemMessage(std::filesystem::is_directory(path, ignored) ? EISDIR : errno));
  readHead();
}

RecordingReader::RecordingReader(std::unique_ptr<std::istream> stream, std::string name)
    : stream_(std::move(stream)), name_(std::move(name)) {
  readHead();
}

std::span<const std::uint8_t> RecordingReader::ahead(std::size_t count) {
  if (filled_ - begin_ < count && *stream_) {
    buffer_.resize(kBuffer);
    std::memmove(buffer_.data(), buffer_.data() + begin_, filled_ - begin_);
    filled_ -= std::exchange(begin_, 0);
    stream_->read(reinterpret_cast<char*>(buffer_.data() + filled_),
                  static_cast<std::streamsize>(buffer_.size() - filled_));
    filled_ += static_cast<std::size_t>(stream_->gcount());
  }
  return std::span(buffer_).subspan(begin_, filled_ - begin_);
}

void RecordingReader::pass(std::size_t bytes) {
  begin_ += bytes;
  place_ += bytes;
}

void RecordingReader::goTo(std::uint64_t place) {
  stream_->clear();
  stream_->seekg(static_cast<std::streamoff>(place));
  begin_ = filled_ = 0;
  place_ = place;
  reportTime_s_.reset();
  cutOff_ = false;
}

std::uint64_t RecordingReader::size() {
  stream_->clear();
  const std::streamoff end = stream_->seekg(0, std::ios::end).tellg();
  goTo(place_);
  return static_cast<std::uint64_t>(std::max<std::streamoff>(end, 0));
}

void RecordingReader::readHead() {
  constexpr std::size_t kStart = kRecordingMagic.size() + 4;
  std::span<const std::uint8_t> start = ahead(kStart);
  if (start.size() < kStart || std::memcmp(start.data(), kRecordingMagic.data(), kRecordingMagic.size()) != 0)
    throw Error(name_ + ": not a recording of a board: it must begin with " + std::string(kRecordingMagic));
  const std::size_t length = littleEndian<4>(start, kRecordingMagic.size());
  if (length > kLongestRecordingHead)
    throw Error(name_ + ": head: " +
                gotExpected(std::to_string(length) + " bytes", "up to " + std::to_string(kLongestRecordingHead)));
  start = ahead(kStart + length);
  if (start.size() < kStart + length) throw Error(name_ + ": is cut off in its head");
  head_ = parseRecordingHead({reinterpret_cast<const char*>(start.data()) + kStart, length}, name_);
  pass(kStart + length);
}

std::optional<RecordingEntry> RecordingReader::next() {
  RecordingEntry entry;
  return next(entry) ? std::optional(std::move(entry)) : std::nullopt;
}

bool RecordingReader::next(RecordingEntry& entry) {
  if (take(entry)) return true;
  if (!findNext()) {
    end();
    return false;
  }
  return take(entry);
}

/// The entry here, where it is one: by its own checksum, or because another one or the end follows it.
bool RecordingReader::take(RecordingEntry& entry) {
  const auto head = entryHead(ahead(kEntryHead));
  if (!head) return false;
  const std::size_t whole = kEntryHead + head->length;
  const std::span<const std::uint8_t> bytes = ahead(whole + kEntryHead);
  if (bytes.size() < whole) return false;
  const std::span<const std::uint8_t> body = bytes.subspan(kEntryHead, head->length), rest = bytes.subspan(whole);
  const auto following = entryHead(rest);
  const bool entryFollows = following || rest.size() < kEntryHead;
  if (!(head->kind == Kind::Raw && entryFollows) && !isGood(head->kind, body)) return false;
  entry.kind = head->kind;
  entry.hostTime_s = head->hostTime_s;
  entry.bytes.assign(body.begin(), body.end());
  if (head->kind == Kind::Raw) {
    std::optional<double> after_s;
    if (following && following->kind == Kind::Raw) after_s = following->hostTime_s;
    if (reportTime_s_) entry.hostTime_s = betweenNeighbours(*reportTime_s_, head->hostTime_s, after_s);
    reportTime_s_ = entry.hostTime_s;
  }
  pass(whole);
  return true;
}

/// On to the next entry that is one beyond doubt; false where there is none: then the place is where it was.
bool RecordingReader::findNext() {
  const std::uint64_t from = place_;
  if (!ahead(1).empty()) pass(1);
  for (auto bytes = ahead(kSeenAhead); bytes.size() >= kEntryHead; pass(1), bytes = ahead(kSeenAhead)) {
    if (!isSurelyEntry(bytes)) continue;
    spoilt_ += place_ - from;
    return true;
  }
  goTo(from);
  return false;
}

/// The remainder is the begin of an entry, or unknown bytes.
void RecordingReader::end() {
  const std::span<const std::uint8_t> rest = ahead(kEntryHead);
  if (rest.empty()) return;
  const auto head = entryHead(rest);
  const std::uint64_t all = size(), left = all - place_;
  const bool begun = left < kEntryHead || (head && left < kEntryHead + head->length);
  if (!begun) spoilt_ += all - place_;
  goTo(all);
  cutOff_ = begun;
}

} // namespace palp
